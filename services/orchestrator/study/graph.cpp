#include "services/orchestrator/study/graph.hpp"

#include <algorithm>
#include <map>

#include "services/orchestrator/study/recipe.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

/// The FEM writes the scene's own snapshots and those that the transfers need.
json snapshot_times(const json& scene, const std::vector<double>& transfer_times) {
    auto times = scene.at("fem").at("snapshot_times").get<std::vector<double>>();
    times.insert(times.end(), transfer_times.begin(), transfer_times.end());
    std::ranges::sort(times);
    const auto repeated = std::ranges::unique(times);
    times.erase(repeated.begin(), repeated.end());
    return times;
}

class Planner {
  public:
    explicit Planner(const Study& study) : study_(study) {}

    void plan(const Variant& variant) {
        json scene = variant.scene;
        scene["fem"]["snapshot_times"] = snapshot_times(scene, study_.transfer_times);
        std::vector<std::string> wishes{"/fem/snapshot_times=" +
                                        scene["fem"]["snapshot_times"].dump()};
        if (study_.snapshot_interval > 0.0) {
            scene["fem"]["snapshot_interval"] = study_.snapshot_interval;
            wishes.push_back("/fem/snapshot_interval=" + json(study_.snapshot_interval).dump());
        }
        variant_ = &variant;
        for (const char* phase : {"fem_solver", "lem_tool", "transfer_tool", "mpm_solver"})
            if (phase != std::string("lem_tool") || study_.stability)
                recipes_of_variant_[phase] = recipe(phase, scene);
        const std::size_t fem = add({.phase = "fem_solver",
                                     .label = "fem",
                                     .transfer_time = {},
                                     .parent = {},
                                     .release = Release::at_once,
                                     .input = {},
                                     .overrides = std::move(wishes)},
                                    Sharing::wanted);
        if (study_.stability) {
            add({.phase = "lem_tool",
                 .label = "lem",
                 .transfer_time = {},
                 .parent = {},
                 .release = Release::at_once,
                 .input = {},
                 .overrides = {}},
                Sharing::wanted);
        }
        for (const double time : study_.transfer_times) plan_transfer(fem, time);
    }

    TaskGraph finished() {
        TaskGraph graph;
        for (std::size_t i = 0; i < tasks_.size(); ++i) {
            TaskPlan& task = tasks_[i];
            if (users_[i] == study_.variants.size()) task.variant.clear();
            if (!task.variant.empty()) task.label += "_" + task.variant;
            if (!study_.reuse) task.recipe.clear();
            graph.tasks.push_back(std::move(task));
        }
        for (auto& [hash, each] : recipes_) graph.recipes.push_back(std::move(each));
        return graph;
    }

  private:
    enum class Sharing { wanted, never };

    void plan_transfer(std::size_t fem, double time) {
        const std::size_t transfer = add({.phase = "transfer_tool",
                                          .label = "transfer_" + spelt(time),
                                          .transfer_time = time,
                                          .parent = fem,
                                          .release = Release::file_exists,
                                          .input = snapshot_name(time),
                                          .overrides = {}},
                                         Sharing::wanted);
        // Never one task for two variants: each has its row in the table of results.
        add({.phase = "mpm_solver",
             .label = "mpm_" + spelt(time),
             .transfer_time = time,
             .parent = transfer,
             .release = Release::parent_succeeded,
             .input = "particles.vtkhdf",
             .overrides = {}},
            Sharing::never);
    }

    std::string recipe(const std::string& phase, const json& scene) {
        Recipe made = recipe_of(phase, scene);
        std::string hash = made.hash;
        recipes_.emplace(hash, std::move(made));
        return hash;
    }

    std::size_t add(TaskPlan task, Sharing sharing) {
        task.recipe = recipes_of_variant_.at(task.phase);
        const Identity identity{task.recipe, task.parent, task.input};
        if (sharing == Sharing::wanted) {
            if (const auto same = known_.find(identity); same != known_.end()) {
                ++users_[same->second];
                return same->second;
            }
            known_.emplace(identity, tasks_.size());
        }
        task.variant = variant_->name;
        task.overrides.insert(task.overrides.begin(), variant_->overrides.begin(),
                              variant_->overrides.end());
        if (const auto ask = study_.resources.find(task.phase); ask != study_.resources.end())
            task.resources = ask->second;
        tasks_.push_back(std::move(task));
        users_.push_back(sharing == Sharing::wanted ? 1 : 0);
        return tasks_.size() - 1;
    }

    using Identity = std::tuple<std::string, std::optional<std::size_t>, std::string>;

    const Study& study_;
    const Variant* variant_ = nullptr;
    std::map<std::string, std::string> recipes_of_variant_;
    std::map<std::string, Recipe> recipes_;
    std::map<Identity, std::size_t> known_;
    std::vector<TaskPlan> tasks_;
    std::vector<std::size_t> users_;  ///< how many variants each task serves
};

}  // namespace

std::string snapshot_name(double time) { return "snapshot_" + spelt(time) + ".vtkhdf"; }

TaskGraph plan_tasks(const Study& study) {
    Planner planner(study);
    for (const Variant& each : study.variants) planner.plan(each);
    return planner.finished();
}

std::string firing_plan(const Study& study) {
    Study one_more = study;
    one_more.transfer_times = {open_time};
    const TaskGraph graph = plan_tasks(one_more);
    json plan = json::array();
    for (const TaskPlan& task : graph.tasks) {
        if (!task.transfer_time) continue;
        plan.push_back(
            {{"phase", task.phase},
             {"label", task.label},
             {"parent", graph.tasks[*task.parent].label},
             {"release", task.release == Release::file_exists ? "file_exists" : "parent_succeeded"},
             {"input", task.input},
             {"overrides", task.overrides},
             {"variant", task.variant},
             {"cores", task.resources.cores},
             {"memory_MB", task.resources.memory_mb},
             {"recipe", task.recipe}});
    }
    return plan.dump();
}

}  // namespace breach::orchestrator
