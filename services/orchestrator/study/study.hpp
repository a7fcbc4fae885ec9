// A submitted study: completely checked, its scene completed and immutable, its transfer times a
// plain list. Short-lived: new_run() makes rows of it, an extension reads the stored document
// again.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "services/orchestrator/records/records.hpp"
#include "services/orchestrator/study/accuracy.hpp"
#include "services/orchestrator/study/checked_scene.hpp"
#include "services/orchestrator/study/target.hpp"
#include "services/orchestrator/study/uncertainty.hpp"

namespace breach::orchestrator {

/// The scene with these changes; each variant is run at every transfer time.
struct Variant {
    std::string name;  ///< empty: the study has no variants, this is the scene itself
    std::vector<std::string> overrides;
    nlohmann::json scene;  ///< completed
};

struct Study {
    std::string name;
    std::string title;
    nlohmann::json document;                     ///< completed, without the scene
    nlohmann::json scene;                        ///< completed, overrides applied
    bool stability = false;                      ///< run lem_tool
    bool post_seismic = false;                   ///< and on the FEM's snapshots
    std::vector<double> transfer_times;          ///< ascending, distinct, in whole microseconds [s]
    std::vector<Variant> variants;               ///< at least one
    std::map<std::string, Resources> resources;  ///< by phase
    std::int64_t priority = 0;
    bool reuse = true;                  ///< equal earlier results may be used
    std::vector<TriggerPlan> triggers;  ///< triggers that watch the FEM
    double snapshot_interval = 0.0;     ///< of snapshots for the triggers; 0: the scene's [s]
    Reach reach = Reach::chain;         ///< phases of each variant
    /// Its variants are samples, and more may be added.
    std::optional<UncertaintyPlan> uncertainty;
    std::optional<Target> target;  ///< its variants are values of one parameter instead
    std::vector<fault::Flag>
        warnings;  ///< of its scenes, each once; pointers are those of the study
};

}  // namespace breach::orchestrator
