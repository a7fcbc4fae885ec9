// Finds the outputs of phases that were run by hand, for runs that no service knows.
// report_questions.cpp alone uses it.
#pragma once

#include <filesystem>
#include <vector>

#include "services/orchestrator/records/records.hpp"

namespace breach::orchestrator {

/// One phase's outputs.
struct PhaseFolder {
    TaskPlan plan;  ///< its parent by the input that the result names
    std::filesystem::path files;
    nlohmann::json scene;   ///< completed
    nlohmann::json result;  ///< null: it left none
    std::string fault;      ///< why there is none
};

/// A folder is a phase when it holds a completed scene and its name begins with lem, fem, transfer
/// or mpm, or its result names the phase. Looks in the folder and three levels below; parents
/// first. Throws IoError if the folder cannot be read, BadInput if it has no phase or two of one
/// name.
std::vector<PhaseFolder> phases_in(const std::filesystem::path& folder);

/// Null: there is no such file. Throws BadInput for a file that is not JSON.
nlohmann::json read_if_there(const std::filesystem::path& file);

}  // namespace breach::orchestrator
