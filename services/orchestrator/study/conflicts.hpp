// Entries of a study that exclude one another: one table of what is refused, and why. StudyReader
// asks it once per study, when the schema has accepted the entries and the transfers are read.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "core/fault/fault.hpp"
#include "services/orchestrator/study/draws.hpp"

namespace breach::orchestrator {

/// The question of a study, by its entries.
enum class Kind { sweep, accuracy, uncertainty };
Kind kind_of(const nlohmann::json& document);

/// What the table looks at.
struct Asked {
    const nlohmann::json& document;
    Kind kind;
    Reach reach;        ///< phases of the quantity
    std::size_t times;  ///< transfer times, those of triggers "at_time" included
    std::size_t live;   ///< other triggers
    bool bisects;       ///< one of them is a bisection
    Draws draws;
};

void refuse_conflicts(const Asked& asked, std::vector<fault::Fault>& faults);

}  // namespace breach::orchestrator
