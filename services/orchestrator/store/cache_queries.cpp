// Queries of the cache.
// The dispatcher calls has_candidate and equal_in_flight for each ready task in every round, so
// both must cost one step in an index however many tasks wait; INDEXED BY makes a changed index
// an error instead of a slow service. answers_to runs on the cache's thread. The earlier_*
// queries serve the page that explains why a task was computed again (dispatch/why.cpp).
#include "services/orchestrator/store/store.hpp"

namespace breach::orchestrator {

namespace {

/// Must equal the condition of the index tasks_by_recipe, or SQLite does not use the index.
const std::string is_an_answer =
    "(state IN ('succeeded', 'cached') OR (state='failed' AND fault_exit=70))";

Recipe recipe_from(const Row& row) {
    return {.hash = row.text("hash"),
            .phase = row.text("phase"),
            .cache_version = row.integer("cache_version"),
            .part = row.text("part")};
}

}  // namespace

/// Without the input's hash, which is not known yet. parent NULL: the phase has no input file.
bool Store::has_candidate(const Task& task) const {
    // Another snapshot of the same FEM is no reason to hash this one. The index contains answers
    // only: an index of all tasks of the recipe would be slow when thousands wait.
    return reader()->finds("SELECT 1 FROM tasks INDEXED BY tasks_by_recipe WHERE recipe=?1 AND " +
                               is_an_answer +
                               " AND (parent IS NULL OR parent<>?2 OR input=?3) LIMIT 1",
                           {*task.recipe, task.parent.value_or(""), task.input});
}

std::vector<Task> Store::answers_to(const std::string& recipe, const std::string& input_sha256,
                                    std::size_t most) const {
    std::vector<Task> found;
    for (const std::string& id :
         reader()->texts("SELECT id FROM tasks WHERE recipe=? AND input_sha256=? AND " +
                             is_an_answer + " ORDER BY id DESC LIMIT ?",
                         {recipe, input_sha256, static_cast<std::int64_t>(most)}))
        if (auto answer = task(id))
            found.push_back(std::move(*answer));  // else its run was removed
    return found;
}

/// same_as leads to the task that computed an input first. coalesce(..., ''): tasks without a
/// parent have equal (no) inputs.
std::optional<std::string> Store::equal_in_flight(const Task& task) const {
    if (!task.recipe) return std::nullopt;
    // Inputs are equal if they are one file of one task, computed or reused; no hashing.
    return reader()->text(
        R"(SELECT other.id FROM tasks AS other INDEXED BY tasks_by_state
LEFT JOIN tasks AS theirs ON theirs.id=other.parent LEFT JOIN tasks AS mine ON mine.id=?1
WHERE other.state IN ('starting', 'running', 'finalizing') AND other.recipe=?2 AND other.input=?3
    AND other.id<>?4 AND coalesce(theirs.same_as, theirs.id, '')=coalesce(mine.same_as, mine.id, '') LIMIT 1)",
        {task.parent.value_or(""), *task.recipe, task.input, task.id});
}

std::optional<Recipe> Store::recipe(const std::string& hash) const {
    return reader()->first("SELECT hash, phase, cache_version, part FROM recipes WHERE hash=?",
                           {hash}, recipe_from);
}

/// Ids grow with time, so that id<?3 means earlier. Equal input names first: a reader would have
/// expected them as a hit.
std::optional<Task> Store::earlier_equal_recipe(const Task& wanted) const {
    const auto id = reader()->text(
        R"(SELECT id FROM tasks WHERE phase=?1 AND recipe=?2 AND id<?3 AND (parent IS NULL OR parent<>?4)
ORDER BY (input=?5) DESC, (state='succeeded') DESC, id DESC LIMIT 1)",
        {wanted.phase, *wanted.recipe, wanted.id, wanted.parent.value_or(""), wanted.input});
    return id ? task(*id) : std::nullopt;
}

std::vector<std::pair<std::string, Recipe>> Store::earlier_recipes(const Task& task,
                                                                   std::size_t most) const {
    return reader()->select(
        R"(SELECT last, hash, phase, cache_version, part
FROM (SELECT recipe, max(id) AS last FROM tasks WHERE phase=? AND recipe<>? AND id<?
      GROUP BY recipe ORDER BY last DESC LIMIT ?) JOIN recipes ON hash=recipe ORDER BY last DESC)",
        {task.phase, *task.recipe, task.id, static_cast<std::int64_t>(most)}, [](const Row& row) {
            return std::pair{row.text("last"), recipe_from(row)};
        });
}

namespace {

std::map<std::string, std::int64_t> by_state(Connection& database, const std::string& table) {
    std::map<std::string, std::int64_t> counts;
    database.query("SELECT state, count(*) AS n FROM " + table + " GROUP BY state", {},
                   [&](const Row& row) { counts[row.text("state")] = row.integer("n"); });
    return counts;
}

}  // namespace

std::map<std::string, std::int64_t> Store::tasks_by_state() const {
    return by_state(*reader(), "tasks");
}

std::map<std::string, std::int64_t> Store::attempts_by_state() const {
    return by_state(*reader(), "attempts");
}

}  // namespace breach::orchestrator
