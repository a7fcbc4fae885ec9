// A study of the column scene, and its faults.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "core/fault/fault.hpp"
#include "services/orchestrator/study/graph.hpp"
#include "services/orchestrator/study/read_study.hpp"

namespace breach::orchestrator {

inline const Numerics numerics{{"fem_solver", 1},
                               {"transfer_tool", 1},
                               {"mpm_solver", 1},
                               {"lem_tool", 1},
                               {"post_seismic", 1}};

inline nlohmann::json column_scene() {
    return nlohmann::json::parse(R"({
      "format": "breachline-scene/1", "name": "column",
      "materials": {"sand": {"density": 1800, "law": {"type": "mohr_coulomb", "E_MPa": 20, "nu": 0.3,
        "c_kPa": 1, "phi_deg": 30}}},
      "section": {"regions": [{"name": "column", "material": "sand",
        "polygon": [[0, 0], [10, 0], [10, 20], [0, 20], [0, 0]],
        "mesh": {"type": "block", "divisions": [10, 20]}}]},
      "fem": {"supports": [{"name": "base", "from": [0, 0], "to": [10, 0], "fixes": "xy"}],
        "stages": [{"type": "static", "name": "geostatic"},
          {"type": "dynamic", "name": "failure", "duration": 0.75, "time_step": 0.005}],
        "crest": [10, 20]},
      "transfer": {},
      "mpm": {"cell_size": 1.0, "domain_x": [0, 60], "domain_y": [0, 24],
        "floor": {"level": 0, "friction": [{"from": 0, "to": 60, "coefficient": 0.5}]},
        "duration": "until_rest", "runout": {"toe": [10, 0]}}})");
}

inline std::size_t count(const TaskGraph& graph, const std::string& phase) {
    return static_cast<std::size_t>(std::ranges::count(graph.tasks, phase, &TaskPlan::phase));
}

/// The fault with this pointer; fails if there is none.
inline fault::Fault refusal(const nlohmann::json& study, const std::string& pointer) {
    std::string found;
    try {
        read_study(study.dump());
    } catch (const fault::BadInput& error) {
        for (const fault::Fault& each : error.faults()) {
            if (each.pointer == pointer) return each;
            found += each.pointer + ": " + each.cause + "\n";
        }
    }
    ADD_FAILURE() << "no fault at " << pointer << "; there are:\n" << found;
    return {};
}

}  // namespace breach::orchestrator
