// For the page of one task (http_runs.cpp), on the request's thread. The reason is worked out
// afterwards from recipes and rows; nothing about it is stored but a refusal of the cache.
#include "services/orchestrator/dispatch/why.hpp"

#include "core/fault/fault.hpp"
#include "services/orchestrator/study/recipe.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

constexpr std::size_t most_compared = 50;

json because(const std::string& reason, const json& differs = json::array(),
             const json& compared_with = nullptr) {
    return {{"reason", reason}, {"differs", differs}, {"compared_with", compared_with}};
}

/// The recipe is equal, so only input, time or outcome can have kept the cache from answering.
json beside_equal_recipe(const Task& task, const Task& earlier) {
    // The cache answers with breakdowns, too.
    const bool broke_down =
        earlier.fault && earlier.fault->exit_code == static_cast<int>(fault::ExitCode::breakdown);
    if (is_final(earlier.state) && !has_output(earlier.state) && !broke_down)
        return because("earlier task did not succeed", json::array(), earlier.id);
    const bool later = !earlier.finished || (task.started && *earlier.finished > *task.started);
    if (later) return because("earlier task had not ended", json::array(), earlier.id);
    return because("input changed", {"input"}, earlier.id);
}

}  // namespace

json why_it_ran(const Store& store, const Task& task) {
    if (task.same_as) return because("taken from an earlier task", json::array(), *task.same_as);
    if (task.state == TaskState::cached)
        return because("taken from an earlier task, which was removed");
    if (!task.started) {
        const auto equal = task.state == TaskState::ready ? store.equal_in_flight(task)
                                                          : std::optional<std::string>();
        return equal ? because("waits for an equal task", json::array(), *equal)
                     : because("has not run");
    }
    if (!task.recipe) return because("reuse is switched off");
    if (task.cache_refusal) {
        json answer = because("stored outputs are damaged");
        answer["detail"] = *task.cache_refusal;
        return answer;
    }
    if (const auto equal = store.earlier_equal_recipe(task))
        return beside_equal_recipe(task, *equal);
    const auto mine = store.recipe(*task.recipe);
    const json part = json::parse(mine->part);
    json best;
    for (const auto& [id, earlier] : store.earlier_recipes(task, most_compared)) {
        const auto differs = differences(json::parse(earlier.part), part);
        // The nearest earlier recipe; of equally near ones the newest.
        if (!best.is_null() && best.at("differs").size() <= differs.size()) continue;
        const bool newer = earlier.cache_version != mine->cache_version;
        best = because(newer ? "cache version changed" : "scene part changed", differs, id);
    }
    return best.is_null() ? because("first of its kind") : best;
}

}  // namespace breach::orchestrator
