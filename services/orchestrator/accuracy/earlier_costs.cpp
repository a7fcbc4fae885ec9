#include "services/orchestrator/accuracy/earlier_costs.hpp"

#include <map>
#include <mutex>
#include <optional>

#include "core/scene/reading.hpp"

namespace breach::orchestrator {

namespace {

using estimate::Earlier;
using Found = std::optional<Earlier>;  // none: the task says nothing

constexpr std::size_t newest_runs = 8, first_tasks = 24, tasks_of_a_phase = 2;

double bytes_of(const Store& store, const std::string& task) {
    double sum = 0.0;
    for (const Artifact& each : store.artifacts_of(task)) sum += static_cast<double>(each.bytes);
    return sum;
}

Found earlier_of(const Store& store, const Task& task, const std::string& run_scene) {
    if (!task.result || !task.result->is_object()) return std::nullopt;
    const auto cpu = task.result->find("cpu_seconds");
    if (cpu == task.result->end() || !cpu->is_number()) return std::nullopt;
    const scene::Reading reading = scene::read_text(run_scene, "scene", "/", task.overrides);
    if (!reading.faults.empty()) return std::nullopt;
    for (const estimate::PhaseCost& each : estimate::cost_of(reading.scene))
        if (each.phase == task.phase)
            return Earlier{task.phase, reading.scene.name,
                           cpu->get<double>() / each.cpu_seconds.middle(),
                           bytes_of(store, task.id) / each.bytes.middle()};
    return std::nullopt;
}

/// Tasks that were read, by id; what has succeeded does not change.
class Memory {
  public:
    Found of(const Store& store, const Task& task, const std::string& run_scene) {
        {
            const std::lock_guard lock(mutex_);
            if (const auto known = found_.find(task.id); known != found_.end())
                return known->second;
        }
        Found found;
        try {
            found = earlier_of(store, task, run_scene);
        } catch (const fault::BadInput&) {  // a scene of an earlier version
        }
        const std::lock_guard lock(mutex_);
        return found_[task.id] = std::move(found);
    }

  private:
    std::mutex mutex_;
    std::map<std::string, Found> found_;
};

Memory memory;

}  // namespace

std::vector<Earlier> earlier_costs(const Store& store) {
    std::vector<Earlier> earlier;
    for (const Run& run : store.runs(newest_runs)) {
        if (run.tasks_done == 0) continue;
        const auto run_scene = store.scene_of(run.id);
        if (!run_scene) continue;
        std::map<std::string, std::size_t> taken;
        for (const Task& task : store.tasks_of(run.id, "", first_tasks)) {
            if (task.state != TaskState::succeeded || taken[task.phase] >= tasks_of_a_phase)
                continue;
            if (const Found found = memory.of(store, task, *run_scene)) {
                earlier.push_back(*found);
                ++taken[task.phase];
            }
        }
    }
    return earlier;
}

}  // namespace breach::orchestrator
