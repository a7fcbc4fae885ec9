#include "services/orchestrator/graph.hpp"

#include <algorithm>

namespace breach::orchestrator {

using nlohmann::json;

namespace {

/// The FEM writes the scene's own snapshots and those that the transfers need.
std::string snapshot_override(const Study& study) {
    auto times = study.scene.at("fem").at("snapshot_times").get<std::vector<double>>();
    times.insert(times.end(), study.transfer_times.begin(), study.transfer_times.end());
    std::ranges::sort(times);
    const auto repeated = std::ranges::unique(times);
    times.erase(repeated.begin(), repeated.end());
    return "/fem/snapshot_times=" + json(times).dump();
}

}  // namespace

std::string snapshot_name(double time) { return "snapshot_" + spelt(time) + ".vtkhdf"; }

std::vector<TaskPlan> plan_tasks(const Study& study) {
    std::vector<TaskPlan> tasks;
    const std::size_t fem = tasks.size();
    tasks.push_back({.phase = "fem_solver",
                     .label = "fem",
                     .transfer_time = {},
                     .parent = {},
                     .release = Release::at_once,
                     .input = {},
                     .overrides = {snapshot_override(study)}});
    if (study.stability) {
        tasks.push_back({.phase = "lem_tool",
                         .label = "lem",
                         .transfer_time = {},
                         .parent = {},
                         .release = Release::at_once,
                         .input = {},
                         .overrides = {}});
    }
    for (const double time : study.transfer_times) {
        const std::size_t transfer = tasks.size();
        tasks.push_back({.phase = "transfer_tool",
                         .label = "transfer_" + spelt(time),
                         .transfer_time = time,
                         .parent = fem,
                         .release = Release::file_exists,
                         .input = snapshot_name(time),
                         .overrides = {}});
        tasks.push_back({.phase = "mpm_solver",
                         .label = "mpm_" + spelt(time),
                         .transfer_time = time,
                         .parent = transfer,
                         .release = Release::parent_succeeded,
                         .input = "particles.vtkhdf",
                         .overrides = {}});
    }
    return tasks;
}

}  // namespace breach::orchestrator
