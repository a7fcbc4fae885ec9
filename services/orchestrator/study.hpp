// A study at the door: checked whole, its scene completed and made immutable, its transfer times a
// plain list.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "services/orchestrator/records.hpp"

namespace breach::orchestrator {

struct Study {
    std::string name;
    std::string title;
    nlohmann::json document;             ///< completed, without the scene
    nlohmann::json scene;                ///< completed, overrides applied
    bool stability = false;              ///< run lem_tool
    std::vector<double> transfer_times;  ///< ascending, distinct, in whole microseconds [s]
};

/// Throws BadInput with every fault; pointers are those of the study ("/scene/materials/...").
Study read_study(std::string_view text);

/// A scene on its own, as /v1/scenes/plan takes it: completed. Throws BadInput.
nlohmann::json read_whole_scene(std::string_view text);

/// "0.500000": how a time is spelt in snapshot and task names.
std::string spelt(double time);

}  // namespace breach::orchestrator
