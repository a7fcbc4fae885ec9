// From variants to tasks. Two variants share a task if recipe, parent and input are equal, which
// merges most FEMs of a sweep before anything is computed; the cache catches what is equal across
// runs. Called when a study is submitted, previewed or extended, and must give the same tasks
// each time.
#include "services/orchestrator/study/graph.hpp"

#include <algorithm>
#include <map>
#include <tuple>

#include "core/phases/files.hpp"
#include "core/phases/phases.hpp"
#include "services/orchestrator/records/firing_plan.hpp"
#include "services/orchestrator/study/recipe.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

/// The FEM writes the scene's own snapshots and those for the transfers.
json snapshot_times(const json& scene, const std::vector<double>& transfer_times) {
    auto times = scene.at("fem").at("snapshot_times").get<std::vector<double>>();
    times.insert(times.end(), transfer_times.begin(), transfer_times.end());
    std::ranges::sort(times);
    const auto repeated = std::ranges::unique(times);
    // A time that scene and study both name is one snapshot.
    times.erase(repeated.begin(), repeated.end());
    return times;
}

enum class Sharing { wanted, never };

/// Tasks of several variants, with equal ones merged.
class TaskList {
  public:
    explicit TaskList(const Study& study) : study_(study) {}

    /// `beside`: what else must be equal for sharing.
    std::size_t add(TaskPlan task, const Variant& variant, Sharing sharing,
                    const std::string& beside = {}) {
        const Identity identity{task.recipe, task.parent, task.input, beside};
        if (sharing == Sharing::wanted) {
            if (const auto same = known_.find(identity); same != known_.end()) {
                ++users_[same->second];
                return same->second;
            }
            known_.emplace(identity, tasks_.size());
        }
        task.variant = variant.name;
        // The variant's first: those of the plan (snapshot times) must win.
        task.overrides.insert(task.overrides.begin(), variant.overrides.begin(),
                              variant.overrides.end());
        if (const auto ask = study_.resources.find(task.phase); ask != study_.resources.end())
            task.resources = ask->second;
        tasks_.push_back(std::move(task));
        // 0: a task that is never shared belongs to its variant, also in a study with a single one.
        users_.push_back(sharing == Sharing::wanted ? 1 : 0);
        return tasks_.size() - 1;
    }

    std::vector<TaskPlan> named() && {
        for (std::size_t i = 0; i < tasks_.size(); ++i) {
            // In a study that may get more samples, a task that all share now may not serve all
            // later: its label then names the first variant that uses it.
            const bool for_all = users_[i] == study_.variants.size();
            const bool may_grow = study_.uncertainty.has_value();
            if (for_all && !may_grow) tasks_[i].variant.clear();
            tasks_[i].label = label_of(tasks_[i]);
            const bool is_stability = std::ranges::any_of(
                stability_fields,
                [&](const StabilityField& each) { return tasks_[i].phase == each.phase; });
            if (for_all && is_stability) tasks_[i].variant.clear();
            // Without a recipe the cache neither answers a task nor keeps its result.
            if (!study_.reuse) tasks_[i].recipe.clear();
        }
        return std::move(tasks_);
    }

  private:
    using Identity = std::tuple<std::string, std::optional<std::size_t>, std::string, std::string>;

    const Study& study_;
    std::map<Identity, std::size_t> known_;
    std::vector<TaskPlan> tasks_;
    std::vector<std::size_t> users_;  ///< how many variants each task serves
};

class Planner {
  public:
    Planner(const Study& study, const Numerics& numerics)
        : study_(study), numerics_(numerics), tasks_(study), open_(study) {}

    void plan(const Variant& variant) {
        if (study_.reach == Reach::chain) return plan_chain(variant);
        plan_one_phase(variant, phases_of(study_.reach).front().program);
        // Both at once: neither waits for the other.
        if (study_.reach == Reach::filled_mpm && study_.stability)
            plan_one_phase(variant, phases::lem.program);
    }

    /// This phase alone. Variants never share the task: each has its row in the table of results.
    void plan_one_phase(const Variant& variant, const std::string& phase) {
        variant_ = &variant;
        recipes_of_variant_[phase] = recipe(phase, variant.scene);
        add_first(tasks_, phase, {}, Sharing::never);
    }

    /// One FEM with the snapshots of all transfer times; the same variant once more in the plan of
    /// one further transfer, whose time is unknown until a trigger fires.
    void plan_chain(const Variant& variant) {
        json scene = variant.scene;
        scene["fem"]["snapshot_times"] = snapshot_times(scene, study_.transfer_times);
        std::vector<std::string> changes{"/fem/snapshot_times=" +
                                         scene["fem"]["snapshot_times"].dump()};
        if (study_.snapshot_interval > 0.0) {
            scene["fem"]["snapshot_interval"] = study_.snapshot_interval;
            changes.push_back("/fem/snapshot_interval=" + json(study_.snapshot_interval).dump());
        }
        variant_ = &variant;
        // Recipes from the scene with its snapshots: other times are another FEM for the cache.
        for (const phases::Phase& each : phases::all)
            if (runs(each)) recipes_of_variant_[each.program] = recipe(each.program, scene);
        const std::size_t fem = add_fem(tasks_, std::move(changes));
        if (study_.stability)
            add_first(tasks_, phases::lem.program, {}, sharing_of(phases::lem.program));
        if (study_.post_seismic) add_post_seismic(fem);
        for (const double time : study_.transfer_times) plan_transfer(tasks_, fem, time);
        plan_transfer(open_, add_fem(open_, {}), std::nullopt);
    }

    TaskGraph finished() && {
        TaskGraph graph;
        graph.tasks = std::move(tasks_).named();
        graph.one_more_transfer = std::move(open_).named();
        for (auto& [hash, each] : recipes_) graph.recipes.push_back(std::move(each));
        // Requested snapshots do not follow from the scene: never reuse such a FEM.
        if (!study_.triggers.empty() && study_.snapshot_interval <= 0.0)
            for (TaskPlan& each : graph.tasks)
                if (each.phase == phases::fem.program || each.phase == phases::post_seismic.program)
                    each.recipe.clear();
        return graph;
    }

  private:
    bool runs(const phases::Phase& phase) const {
        if (phase.program == std::string_view(phases::lem.program)) return study_.stability;
        if (phase.program == std::string_view(phases::post_seismic.program))
            return study_.post_seismic;
        return true;
    }

    void add_post_seismic(std::size_t fem) {
        tasks_.add({.phase = phases::post_seismic.program,
                    .label = {},
                    .transfer_time = {},
                    .parent = fem,
                    .release = Release::parent_succeeded,
                    .input = phases::files::series,
                    .overrides = {},
                    .recipe = recipes_of_variant_.at(phases::post_seismic.program)},
                   *variant_, sharing_of(phases::post_seismic.program));
    }

    /// A task that waits for nothing.
    std::size_t add_first(TaskList& list, const std::string& phase,
                          std::vector<std::string> changes, Sharing sharing = Sharing::wanted,
                          const std::string& beside = {}) {
        return list.add({.phase = phase,
                         .label = {},
                         .transfer_time = {},
                         .parent = {},
                         .release = Release::at_once,
                         .input = {},
                         .overrides = std::move(changes),
                         .recipe = recipes_of_variant_.at(phase)},
                        *variant_, sharing, beside);
    }

    /// Where a trigger uses a stability analysis, only variants with the same one share the FEM.
    std::size_t add_fem(TaskList& list, std::vector<std::string> changes) {
        std::string beside;
        for (const StabilityField& field : stability_fields) {
            const bool asked = std::ranges::any_of(study_.triggers, [&](const TriggerPlan& each) {
                return asks_for(work_of(each), field);
            });
            const auto recipe = recipes_of_variant_.find(field.phase);
            if (asked && recipe != recipes_of_variant_.end()) beside += recipe->second;
        }
        return add_first(list, phases::fem.program, std::move(changes), Sharing::wanted, beside);
    }

    void plan_transfer(TaskList& list, std::size_t fem, std::optional<double> time) {
        TaskPlan transfer{.phase = phases::transfer.program,
                          .label = {},
                          .transfer_time = {},
                          .parent = fem,
                          // The transfer need not wait for the FEM's end: its snapshot is enough.
                          .release = Release::file_exists,
                          .input = {},
                          .overrides = {},
                          .recipe = recipes_of_variant_.at(phases::transfer.program)};
        if (time) transfer = at_time(std::move(transfer), *time);
        const std::size_t parent = list.add(std::move(transfer), *variant_, Sharing::wanted);
        // Variants never share this task: each has its row in the table of results.
        list.add({.phase = phases::mpm.program,
                  .label = {},
                  .transfer_time = time,
                  .parent = parent,
                  .release = Release::parent_succeeded,
                  .input = phases::files::particles,
                  .overrides = {},
                  .recipe = recipes_of_variant_.at(phases::mpm.program)},
                 *variant_, Sharing::never);
    }

    /// One analysis for all variants, or one per variant: with one for some, the other variants
    /// would have none in their rows. The cache avoids computing equal ones twice.
    Sharing sharing_of(const char* stability) {
        const auto [known, is_new] = serves_all_.try_emplace(stability, true);
        if (is_new) {
            const auto of = [&](const Variant& each) { return recipe(stability, each.scene); };
            const std::string first = of(study_.variants.front());
            known->second = std::ranges::all_of(
                study_.variants, [&](const Variant& each) { return of(each) == first; });
        }
        return known->second ? Sharing::wanted : Sharing::never;
    }

    std::string recipe(const std::string& phase, const json& scene) {
        Recipe made = recipe_of(phase, scene, numerics_.at(phase));
        std::string hash = made.hash;
        recipes_.emplace(hash, std::move(made));
        return hash;
    }

    const Study& study_;
    const Numerics& numerics_;
    const Variant* variant_ = nullptr;
    std::map<std::string, bool> serves_all_;  ///< by the stability analysis' phase
    std::map<std::string, std::string> recipes_of_variant_;
    std::map<std::string, Recipe> recipes_;
    TaskList tasks_;
    TaskList open_;  ///< of one more transfer
};

}  // namespace

bool asks_for(const Work& work, const StabilityField& field) {
    const auto asks = [&](const criteria::Expression& condition) {
        return std::ranges::find(condition.fields, field.name) != condition.fields.end();
    };
    if (const auto* when = std::get_if<When>(&work)) return asks(when->criterion.expression());
    const auto* between = std::get_if<Between>(&work);
    return between && (asks(between->window.lower().expression()) || asks(between->window.upper()));
}

TaskGraph plan_tasks(const Study& study, const Numerics& numerics) {
    Planner planner(study, numerics);
    for (const Variant& each : study.variants) planner.plan(each);
    return std::move(planner).finished();
}

}  // namespace breach::orchestrator
