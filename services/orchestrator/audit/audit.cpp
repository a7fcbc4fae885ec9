// `breachline check` reads everything that database and files say twice and compares them. It opens
// the database read-only and takes one transaction, so it may run beside a service; only `mend`
// changes anything, and needs the lock of the folder.
#include "services/orchestrator/audit/audit.hpp"

#include <algorithm>
#include <chrono>
#include <functional>
#include <set>

#include "core/fault/fault.hpp"
#include "services/orchestrator/store/schema.hpp"

namespace breach::orchestrator {

namespace fs = std::filesystem;

namespace {

// The rows are those of the moment at which the audit began: a younger file may have got its row
// since, or be about to get it.
constexpr auto young = std::chrono::minutes(1);

// The columns of run_counts that follow from the run's tasks.
const std::string counts = "(total, ended, reached, failed, cancelled, runouts)";
const std::string counted = R"((SELECT count(*), count(finished),
    count(*) FILTER (WHERE state IN ('succeeded', 'cached')),
    count(*) FILTER (WHERE state IN ('failed', 'skipped') AND NOT not_reached),
    count(*) FILTER (WHERE state='cancelled'),
    count(*) FILTER (WHERE phase='mpm_solver' AND state IN ('succeeded', 'cached'))
FROM tasks WHERE tasks.run=run_counts.run))";

const std::string from_backup =
    "restore it from a backup of the data folder; until then no equal question is answered with it";

/// Each look_at compares one kind of statement. All findings are collected: a person who repairs a
/// store wants the whole list.
class Auditor {
  public:
    Auditor(const DataPaths& data, Look look, bool in_service)
        : data_(data), look_(look), database_(data.database(), Access::read_only) {
        database_.script("BEGIN");  // one consistent state while a service writes
        audit_.in_service = in_service;
        audit_.version = version_of(database_);
    }

    Audit audit() && {
        // First: tables of another version may have other columns, and the rest would not find its
        // own.
        look_at_database();
        if (refusal_of(audit_.version)) return std::move(audit_);
        look_at_counts();
        look_at_outputs();
        look_at_files();
        look_for_strays();
        return std::move(audit_);
    }

  private:
    void find(Inconsistency finding) { audit_.inconsistencies.push_back(std::move(finding)); }

    void look_at_database() {
        const std::string file = data_.database().string();
        if (const auto refusal = refusal_of(audit_.version))
            find({"database", file, *refusal, "check it with the program that made it"});
        for (const std::string& each : database_.texts("PRAGMA integrity_check(20)"))
            if (each != "ok")
                find(
                    {"database", file, each,
                     "restore a backup (breachline-restore); SQLite's .recover saves what it can"});
        database_.query("PRAGMA foreign_key_check", {}, [&](const Row& row) {
            find({"database", row.text("table") + " row " + std::to_string(row.integer("rowid")),
                  "names a row of " + row.text("parent") + " that is not there",
                  "restore a backup (breachline-restore)"});
        });
        for (const auto& [table, counted] : {std::pair{"runs", &audit_.runs},
                                             {"tasks", &audit_.tasks},
                                             {"events", &audit_.events}})
            if (audit_.version > 0)
                *counted = database_.integer(std::string("SELECT count(*) FROM ") + table).value();
    }

    /// run_counts is kept by triggers of the schema so that lists of runs need no sums over tasks.
    void look_at_counts() {
        for (const std::string& run :
             database_.texts("SELECT run FROM run_counts WHERE " + counts + " <> " + counted))
            find({"counts", "run " + run, "its counts are not those of its tasks",
                  "--repair counts them anew", true});
    }

    /// Only of ended tasks: a running phase still writes. What the phase left beside its registered
    /// outputs (checkpoints, logs) has no row and is not compared.
    void look_at_outputs() {
        database_.query(
            R"(SELECT run, label, name, bytes, sha256 FROM artifacts JOIN tasks ON tasks.id=task
WHERE finished IS NOT NULL)",
            {}, [&](const Row& row) {
                ++audit_.outputs;
                const fs::path file =
                    data_.output(row.text("run"), row.text("label")) / row.text("name");
                if (const auto damage =
                        damage_of(file, row.integer("bytes"), row.text("sha256"), look_))
                    find({"output", file.string(), *damage, from_backup});
            });
        database_.query(
            R"(SELECT id, state FROM tasks WHERE state IN ('succeeded', 'cached')
    AND NOT EXISTS (SELECT 1 FROM artifacts WHERE task=tasks.id))",
            {}, [&](const Row& row) {
                find({"output", "task " + row.text("id"),
                      "is " + row.text("state") + " without any output",
                      "report it with the database: a program wrote what it must not"});
            });
    }

    /// Before look_for_strays(), which needs the names that are collected here.
    void look_at_files() {
        database_.query("SELECT file, bytes, sha256, name FROM files", {}, [&](const Row& row) {
            ++audit_.files;
            known_files_.insert(row.text("file"));
            const fs::path file = data_.files() / row.text("file");
            if (const auto damage =
                    damage_of(file, row.integer("bytes"), row.text("sha256"), look_))
                find({"file", file.string(), *damage,
                      "send " + row.text("name") + " again (breach files FILE)"});
        });
    }

    bool is_young(const fs::path& path) const {
        std::error_code error;
        const auto changed = fs::last_write_time(path, error);
        return error || fs::file_time_type::clock::now() - changed < young;
    }

    void stray(const fs::path& path, const std::string& cause) {
        if (audit_.in_service && is_young(path)) return;
        find({"stray", path.string(), cause,
              "--repair moves it to " + (data_.root() / "strays").string(), true});
    }

    static void each_in(const fs::path& folder, const std::function<void(const fs::path&)>& visit) {
        std::error_code error;
        for (const auto& entry : fs::directory_iterator(folder, error)) visit(entry.path());
    }

    void look_for_strays() {
        std::map<std::string, std::set<std::string>> labels;
        // A removal deletes the rows first and the folder later; what it has not reached yet is no
        // stray.
        const std::vector<std::string> leaving = database_.texts("SELECT run FROM removals");
        for (const std::string& run : database_.texts("SELECT id FROM runs")) labels[run];
        database_.query("SELECT run, label FROM tasks", {},
                        [&](const Row& row) { labels[row.text("run")].insert(row.text("label")); });
        each_in(data_.runs(), [&](const fs::path& folder) {
            const std::string run = folder.filename();
            if (std::ranges::find(leaving, run) != leaving.end()) return;
            if (!labels.contains(run)) return stray(folder, "belongs to no run");
            each_in(folder, [&](const fs::path& inside) {
                // "files" holds links to uploads that the run's scene names.
                if (fs::is_directory(inside) && inside.filename() != "files" &&
                    !labels.at(run).contains(inside.filename()))
                    stray(inside, "belongs to no task of its run");
            });
        });
        each_in(data_.files(), [&](const fs::path& file) {
            if (!known_files_.contains(file.filename())) stray(file, "belongs to no known upload");
        });
    }

    const DataPaths& data_;
    Look look_;
    Connection database_;
    std::set<std::string> known_files_;
    Audit audit_;
};

}  // namespace

Audit audited(const DataPaths& data, Look look) {
    if (!fs::exists(data.database()))
        throw fault::BadInput("command line",
                              {{"--data", data.root().string() + " holds no breachline.sqlite",
                                "give the folder that the service was started with"}});
    return Auditor(data, look, is_held(data.instance_lock())).audit();
}

Audit audited(const DataFolder& data, Look look) { return Auditor(data, look, false).audit(); }

/// Strays are moved, never deleted: a file that the store does not know may be someone's only copy.
/// Counts are derived, so counting again loses nothing. Everything else needs a person.
void mend(const DataFolder& data, const std::vector<Inconsistency>& found) {
    const fs::path strays = data.root() / "strays";
    for (const Inconsistency& each : found) {
        if (each.part != "stray") continue;
        const fs::path to = strays / fs::relative(each.where, data.root());
        fs::create_directories(to.parent_path());
        fs::rename(each.where, to);
    }
    Connection database(data.database(), Access::read_write);
    database.change("UPDATE run_counts SET " + counts + " = " + counted);
}

}  // namespace breach::orchestrator
