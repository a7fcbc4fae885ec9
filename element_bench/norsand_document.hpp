// The entry `norsand_calibration` of an element-test document: adds the columns of its files,
// checks it and converts it to a problem.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "core/fault/fault.hpp"
#include "element_bench/norsand_calibration.hpp"

namespace breach::element_bench {

/// Adds the columns of every test's file to its entry, as `measured`.
void take_in_triaxial_files(nlohmann::json& entry, const std::filesystem::path& folder,
                            std::vector<fault::Fault>& faults);

NorSandProblem norsand_problem_of(const nlohmann::json& entry);

/// The calibrated law as a document's entry.
nlohmann::json law_entry_of(const nlohmann::json& entry, const NorSandFit& fit);

}  // namespace breach::element_bench
