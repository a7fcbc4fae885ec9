// Stored scenes, their names, and the runs made from them.
#include "core/fault/fault.hpp"
#include "services/orchestrator/records/identity.hpp"
#include "services/orchestrator/store/store.hpp"

namespace breach::orchestrator {

namespace {

const std::string selected_names = "SELECT name, version, created, sha256 FROM scene_names ";

SceneName name_from(const Row& row) {
    return {row.text("name"), row.integer("version"), row.text("created"), row.text("sha256")};
}

StoredScene scene_from(const Row& row) {
    return {.sha256 = row.text("sha256"),
            .document = row.text("document"),
            .bytes = row.integer("bytes"),
            .created = row.text("created")};
}

/// Names and runs of these scenes.
void add_users(Connection& database, std::vector<StoredScene>& scenes) {
    for (StoredScene& each : scenes) {
        each.names = database.select(selected_names + "WHERE sha256=? ORDER BY name, version DESC",
                                     {each.sha256}, name_from);
        each.runs = database.texts(
            "SELECT run FROM scenes_of_runs WHERE sha256=? ORDER BY run DESC", {each.sha256});
    }
}

}  // namespace

void Transaction::add_scene_source(const NewRun& run) {
    if (!run.made_of) return;
    const SceneSource& source = *run.made_of;
    if (!database_.finds("SELECT 1 FROM scenes WHERE sha256=?", {source.sha256}))
        throw fault::BadInput("study", {{"/scene", "this stored scene was removed meanwhile",
                                         "store it again (POST /v1/scenes; breach scenes add)"}});
    database_.change(
        "INSERT INTO scenes_of_runs (run, sha256, name, version) VALUES (?,?,?,?)",
        {run.id, source.sha256, value_or_null(source.name), value_or_null(source.version)});
}

bool Transaction::keep_scene(const NewScene& scene, const std::optional<std::string>& name) {
    const std::string now = utc_now();
    bool is_new =
        database_.change("INSERT OR IGNORE INTO scenes (sha256, document, created) VALUES (?,?,?)",
                         {scene.sha256, scene.document, now}) > 0;
    for (const std::string& each : scene.files) {
        if (database_.change("UPDATE files SET used=? WHERE sha256=?", {now, each}) == 0)
            throw fault::BadInput("scene",
                                  {{"", "the file " + each + " is not here any more",
                                    "send it again (POST /v1/files; breach scenes add does it)"}});
        database_.change("INSERT OR IGNORE INTO files_of_scenes (scene, sha256) VALUES (?,?)",
                         {scene.sha256, each});
    }
    if (!name) return is_new;
    const auto newest = database_.first(
        selected_names + "WHERE name=? ORDER BY version DESC LIMIT 1", {*name}, name_from);
    if (newest && newest->sha256 == scene.sha256) return is_new;
    database_.change("INSERT INTO scene_names (name, version, sha256, created) VALUES (?,?,?,?)",
                     {*name, newest ? newest->version + 1 : 1, scene.sha256, now});
    return true;
}

Removal Transaction::forget_scene(const std::string& sha256) {
    if (!database_.finds("SELECT 1 FROM scenes WHERE sha256=?", {sha256})) return Removal::unknown;
    if (database_.finds(R"(SELECT 1 FROM scene_names WHERE sha256=?1
UNION ALL SELECT 1 FROM scenes_of_runs WHERE sha256=?1)",
                        {sha256}))
        return Removal::needed;
    database_.change("DELETE FROM files_of_scenes WHERE scene=?", {sha256});
    database_.change("DELETE FROM scenes WHERE sha256=?", {sha256});
    return Removal::done;
}

Removal Transaction::forget_scene_name(const std::string& name) {
    const std::vector<std::string> scenes =
        database_.texts("SELECT DISTINCT sha256 FROM scene_names WHERE name=?", {name});
    if (scenes.empty()) return Removal::unknown;
    if (database_.finds("SELECT 1 FROM scenes_of_runs WHERE name=?", {name}))
        return Removal::needed;
    database_.change("DELETE FROM scene_names WHERE name=?", {name});
    for (const std::string& each : scenes) forget_scene(each);  // unless something else needs it
    return Removal::done;
}

std::optional<StoredScene> Store::scene(const std::string& sha256) const {
    const Reader database = reader();
    std::vector<StoredScene> found = database->select(
        R"(SELECT sha256, document, length(CAST(document AS BLOB)) AS bytes, created FROM scenes
WHERE sha256=?)",
        {sha256}, scene_from);
    add_users(*database, found);
    if (found.empty()) return std::nullopt;
    return std::move(found.front());
}

std::vector<StoredScene> Store::scenes(const SceneFilter& filter, std::size_t most) const {
    const bool before = filter.before.has_value();
    const Reader database = reader();
    std::vector<StoredScene> found = database->select(
        R"(SELECT sha256, '' AS document, length(CAST(document AS BLOB)) AS bytes, created FROM scenes
WHERE (?1 IS NULL OR sha256 IN (SELECT sha256 FROM scene_names WHERE name=?1))
    AND (?2 IS NULL OR instr(sha256 || char(10) || coalesce((SELECT group_concat(name, char(10))
        FROM scene_names WHERE scene_names.sha256=scenes.sha256), ''), lower(?2)) > 0)
    AND (?3 IS NULL OR (created, sha256) < (?3, ?4))
ORDER BY created DESC, sha256 DESC LIMIT ?5)",
        {value_or_null(filter.name), value_or_null(filter.search),
         before ? Value(filter.before->first) : Value(nullptr),
         before ? Value(filter.before->second) : Value(nullptr), static_cast<std::int64_t>(most)},
        scene_from);
    add_users(*database, found);
    return found;
}

std::vector<SceneName> Store::versions_of_scene(const std::string& name) const {
    return reader()->select(selected_names + "WHERE name=? ORDER BY version DESC", {name},
                            name_from);
}

std::optional<SceneSource> Store::scene_source_of(const std::string& run) const {
    return reader()->first("SELECT sha256, name, version FROM scenes_of_runs WHERE run=?", {run},
                           [](const Row& row) {
                               return SceneSource{row.text("sha256"), row.optional_text("name"),
                                                  row.optional_integer("version")};
                           });
}

}  // namespace breach::orchestrator
