// Ratios of measured to estimated cost, by phase. Requests for a cost ask for them, on their
// threads. A run is read again only when more of its tasks are done.
#include "services/orchestrator/accuracy/earlier_costs.hpp"

#include <algorithm>
#include <iterator>
#include <optional>

#include "core/scene/reading.hpp"

namespace breach::orchestrator {

namespace {

using estimate::Earlier;
using Found = std::optional<Earlier>;  // nothing: the task has no usable cost

/// Enough to find the last runs of a scene behind those of others; each costs an estimate of its
/// scene.
constexpr std::size_t newest_runs = 30, tasks_of_a_phase = 4;

double bytes_of(const Store& store, const std::string& task) {
    double sum = 0.0;
    for (const Artifact& each : store.artifacts_of(task)) sum += static_cast<double>(each.bytes);
    return sum;
}

Found earlier_of(const Store& store, const Task& task, const std::string& run_scene) {
    if (!task.result || !task.result->is_object()) return std::nullopt;
    const auto cpu = task.result->find("cpu_seconds");
    if (cpu == task.result->end() || !cpu->is_number()) return std::nullopt;
    // With the task's overrides: a variant may have another size than the study's scene.
    const scene::Reading reading = scene::read_text(run_scene, "scene", "/", task.overrides);
    if (!reading.faults.empty()) return std::nullopt;
    for (const estimate::PhaseCost& each : estimate::cost_of(reading.scene))
        if (each.phase == task.phase)
            return Earlier{task.phase, reading.scene.name, cpu->get<double>() / each.cpu_seconds,
                           bytes_of(store, task.id) / each.bytes};
    return std::nullopt;
}

std::vector<Earlier> read(const Store& store, const std::string& run) {
    std::vector<Earlier> earlier;
    const auto run_scene = store.scene_of(run);
    if (!run_scene) return earlier;
    for (const Task& task : store.computed_tasks_of(run, tasks_of_a_phase)) {
        try {
            if (const Found found = earlier_of(store, task, *run_scene)) earlier.push_back(*found);
        } catch (const fault::BadInput&) {  // a scene that this version refuses
        }
    }
    return earlier;
}

}  // namespace

std::vector<Earlier> EarlierCosts::of_run(const Store& store, const Run& run) {
    {
        const std::lock_guard lock(mutex_);
        const auto known = runs_.find(run.id);
        if (known != runs_.end() && known->second.tasks_done == run.tasks_done)
            return known->second.earlier;
    }
    // Without the lock: reading takes long, and two threads that read the same run get the same.
    std::vector<Earlier> earlier = read(store, run.id);
    const std::lock_guard lock(mutex_);
    runs_[run.id] = {run.tasks_done, earlier};
    return earlier;
}

std::vector<Earlier> EarlierCosts::of(const Store& store) {
    std::vector<Earlier> earlier;
    for (const Run& run : store.runs(newest_runs))
        if (run.tasks_done > 0) std::ranges::copy(of_run(store, run), std::back_inserter(earlier));
    return earlier;
}

}  // namespace breach::orchestrator
