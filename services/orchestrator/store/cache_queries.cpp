// What the cache asks the store.
#include "services/orchestrator/store/store.hpp"

namespace breach::orchestrator {

namespace {

/// As the index tasks_by_recipe has it: written otherwise, the index would not serve.
const std::string is_an_answer =
    "(state IN ('succeeded', 'cached') OR (state='failed' AND fault_exit=70))";

Recipe recipe_from(const Row& row, int first) {
    return {.hash = row.text(first),
            .phase = row.text(first + 1),
            .cache_version = row.integer(first + 2),
            .part = row.text(first + 3)};
}

}  // namespace

bool Store::has_candidate(const Task& task) const {
    bool found = false;
    read([&](Connection& database) {
        // Another snapshot of the same FEM is not worth hashing this one for. By the index of
        // answers: that of all tasks of the recipe would be read through when thousands wait.
        database.query("SELECT 1 FROM tasks INDEXED BY tasks_by_recipe WHERE recipe=?1 AND " +
                           is_an_answer + " AND (parent IS NULL OR parent<>?2 OR input=?3) LIMIT 1",
                       {*task.recipe, task.parent.value_or(""), task.input},
                       [&](const Row&) { found = true; });
    });
    return found;
}

std::vector<Task> Store::answers_to(const std::string& recipe, const std::string& input_sha256,
                                    std::size_t most) const {
    std::vector<std::string> ids;
    read([&](Connection& database) {
        database.query("SELECT id FROM tasks WHERE recipe=? AND input_sha256=? AND " +
                           is_an_answer + " ORDER BY id DESC LIMIT ?",
                       {recipe, input_sha256, static_cast<std::int64_t>(most)},
                       [&](const Row& row) { ids.push_back(row.text(0)); });
    });
    std::vector<Task> found;
    for (const std::string& id : ids) found.push_back(*task(id));
    return found;
}

std::optional<std::string> Store::equal_in_flight(const Task& task) const {
    std::optional<std::string> found;
    if (!task.recipe) return found;
    read([&](Connection& database) {
        // Inputs are equal if they are one file of one task, computed or taken over; nothing is hashed.
        database.query(
            "SELECT other.id FROM tasks AS other INDEXED BY tasks_by_state LEFT JOIN tasks AS "
            "theirs ON theirs.id=other.parent LEFT JOIN tasks AS mine ON mine.id=?1 WHERE "
            "other.state IN ('starting', 'running', 'finalizing') AND other.recipe=?2 AND "
            "other.input=?3 AND other.id<>?4 AND coalesce(theirs.same_as, theirs.id, '')="
            "coalesce(mine.same_as, mine.id, '') LIMIT 1",
            {task.parent.value_or(""), *task.recipe, task.input, task.id},
            [&](const Row& row) { found = row.text(0); });
    });
    return found;
}

std::optional<Recipe> Store::recipe(const std::string& hash) const {
    std::optional<Recipe> found;
    read([&](Connection& database) {
        database.query("SELECT hash, phase, cache_version, part FROM recipes WHERE hash=?", {hash},
                       [&](const Row& row) { found = recipe_from(row, 0); });
    });
    return found;
}

std::optional<Task> Store::earlier_equal_recipe(const Task& wanted) const {
    std::optional<std::string> id;
    read([&](Connection& database) {
        database.query(
            "SELECT id FROM tasks WHERE phase=?1 AND recipe=?2 AND id<?3 AND (parent IS NULL OR "
            "parent<>?4) ORDER BY (input=?5) DESC, (state='succeeded') DESC, id DESC LIMIT 1",
            {wanted.phase, *wanted.recipe, wanted.id, wanted.parent.value_or(""), wanted.input},
            [&](const Row& row) { id = row.text(0); });
    });
    return id ? task(*id) : std::nullopt;
}

std::vector<std::pair<std::string, Recipe>> Store::earlier_recipes(const Task& task,
                                                                   std::size_t most) const {
    std::vector<std::pair<std::string, Recipe>> found;
    read([&](Connection& database) {
        database.query(
            "SELECT last, hash, phase, cache_version, part FROM (SELECT recipe, max(id) AS last "
            "FROM tasks WHERE phase=? AND recipe<>? AND id<? GROUP BY recipe ORDER BY last "
            "DESC LIMIT ?) JOIN recipes ON hash=recipe ORDER BY last DESC",
            {task.phase, *task.recipe, task.id, static_cast<std::int64_t>(most)},
            [&](const Row& row) { found.emplace_back(row.text(0), recipe_from(row, 1)); });
    });
    return found;
}

namespace {

std::map<std::string, std::int64_t> counted(Connection& database, const std::string& sql) {
    std::map<std::string, std::int64_t> counts;
    database.query(sql, {}, [&](const Row& row) { counts[row.text(0)] = row.integer(1); });
    return counts;
}

}  // namespace

std::map<std::string, std::int64_t> Store::tasks_by_state() const {
    std::map<std::string, std::int64_t> counts;
    read([&](Connection& database) {
        counts = counted(database, "SELECT state, count(*) FROM tasks GROUP BY state");
    });
    return counts;
}

std::map<std::string, std::int64_t> Store::attempts_by_state() const {
    std::map<std::string, std::int64_t> counts;
    read([&](Connection& database) {
        counts = counted(database, "SELECT state, count(*) FROM attempts GROUP BY state");
    });
    return counts;
}

}  // namespace breach::orchestrator
