// Removal of runs and files from the store. Rows go in one transaction; the folder goes later, on
// Retention's thread, which finds it in `removals` also after a kill.
#include <array>

#include "core/fault/fault.hpp"
#include "services/orchestrator/records/identity.hpp"
#include "services/orchestrator/store/store.hpp"

namespace breach::orchestrator {

namespace {

/// Children before parents. Tasks of other runs that reused a result keep it: their files are links
/// to the same bytes, or copies.
constexpr std::array rows_of_run{
    "DELETE FROM firings WHERE trigger IN (SELECT id FROM triggers WHERE run=?)",
    "DELETE FROM triggers WHERE run=?",
    "DELETE FROM firing_plans WHERE run=?",
    "DELETE FROM batches WHERE run=?",
    "DELETE FROM flags WHERE run=?",
    "DELETE FROM variants WHERE run=?",
    "DELETE FROM idempotency_keys WHERE run=?",
    "DELETE FROM events WHERE run=?",
    "DELETE FROM artifacts WHERE task IN (SELECT id FROM tasks WHERE run=?)",
    "DELETE FROM attempts WHERE task IN (SELECT id FROM tasks WHERE run=?)",
    "UPDATE tasks SET same_as=NULL WHERE same_as IN (SELECT id FROM tasks WHERE run=?)",
    "DELETE FROM tasks WHERE run=?",
    "DELETE FROM run_counts WHERE run=?",
    "DELETE FROM files_of_runs WHERE run=?",
    "DELETE FROM runs WHERE id=?",
};

}  // namespace

Removal Transaction::remove_run(const std::string& run, const std::string& why) {
    if (!database_.finds("SELECT 1 FROM runs WHERE id=?", {run})) return Removal::unknown;
    // Open triggers and batches may still add tasks.
    const bool goes_on =
        database_.finds("SELECT 1 FROM tasks WHERE run=? AND finished IS NULL LIMIT 1", {run}) ||
        database_.finds(
            "SELECT 1 FROM triggers WHERE run=? AND state IN ('armed', 'holding') LIMIT 1",
            {run}) ||
        batches_are_open(run);
    if (goes_on) return Removal::going_on;
    for (const char* each : rows_of_run) database_.change(each, {run});
    // Tasks of future firings are in the firing plan of their run.
    database_.change(
        "DELETE FROM recipes WHERE NOT EXISTS (SELECT 1 FROM tasks WHERE recipe=hash) AND "
        "NOT EXISTS (SELECT 1 FROM firing_plans WHERE instr(tasks, hash) > 0)",
        {});
    // The memory of recent events still has the run's: the store drops all of it.
    removes_events_ = true;
    // Deleted again by Retention when the folder is gone.
    database_.change("INSERT INTO removals (run, asked) VALUES (?,?)", {run, utc_now()});
    add_run_event(run, {{"event", "remove"}, {"why", why}});
    return Removal::done;
}

void Transaction::forget_removal(const std::string& run) {
    database_.change("DELETE FROM removals WHERE run=?", {run});
}

/// A few pages at a time: all other writes wait for a vacuum.
void Transaction::shrink(std::int64_t pages) {
    database_.script("PRAGMA incremental_vacuum(" + std::to_string(pages) + ")");
}

namespace {

const std::string selected_files =
    "SELECT sha256, file, name, kind, about, bytes, created, used FROM files ";

StoredFile file_from(const Row& row) {
    return {.sha256 = row.text("sha256"),
            .file = row.text("file"),
            .name = row.text("name"),
            .kind = row.text("kind"),
            .about = row.text("about"),
            .bytes = row.integer("bytes"),
            .created = row.text("created"),
            .used = row.text("used")};
}

const std::string unneeded =
    "NOT EXISTS (SELECT 1 FROM files_of_runs WHERE files_of_runs.sha256=files.sha256)";

}  // namespace

/// In the transaction that adds the run: retention may have removed a file since the study was
/// checked.
void Transaction::add_files(const NewRun& run) {
    const std::string now = utc_now();
    for (const std::string& each : run.files) {
        if (database_.change("UPDATE files SET used=? WHERE sha256=?", {now, each}) == 0)
            throw fault::BadInput("study",
                                  {{"/scene", "the file " + each + " is not here any more",
                                    "send it again (POST /v1/files; breach submit does it)"}});
        database_.change("INSERT INTO files_of_runs (run, sha256) VALUES (?,?)", {run.id, each});
    }
}

/// publish moves the file to its place, before the commit: killed in between, a file without a
/// row is left, which the next upload of the same content replaces.
void Transaction::keep_file(const StoredFile& file, const std::function<void()>& publish) {
    const std::string now = utc_now();
    database_.change(
        R"(INSERT INTO files (sha256, file, name, kind, about, bytes, created, used)
VALUES (?1,?2,?3,?4,?5,?6,?7,?7) ON CONFLICT (sha256) DO UPDATE SET used=?7)",
        {file.sha256, file.file, file.name, file.kind, file.about, file.bytes, now});
    publish();
}

void Transaction::touch_file(const std::string& sha256) {
    database_.change("UPDATE files SET used=? WHERE sha256=?", {utc_now(), sha256});
}

/// Row and file go together: `erase` runs before the commit, and a kill in between leaves a row
/// whose file is missing; is_whole() in http_files.cpp then counts it as not there.
Removal Transaction::forget_file(const std::string& sha256, const std::function<void()>& erase) {
    if (!database_.finds("SELECT 1 FROM files WHERE sha256=?", {sha256})) return Removal::unknown;
    if (database_.finds("SELECT 1 FROM files_of_runs WHERE sha256=? LIMIT 1", {sha256}))
        return Removal::needed;
    database_.change("DELETE FROM files WHERE sha256=?", {sha256});
    erase();
    return Removal::done;
}

/// The condition is asked again here, because a study may have named the file since it was
/// listed.
bool Transaction::forget_unused_file(const std::string& sha256, const std::string& before,
                                     const std::function<void()>& erase) {
    const bool forgotten =
        database_.change("DELETE FROM files WHERE sha256=? AND used<? AND " + unneeded,
                         {sha256, before}) > 0;
    if (forgotten) erase();
    return forgotten;
}

std::vector<StoredFile> Store::files() const {
    const Reader database = reader();
    std::vector<StoredFile> found =
        database->select(selected_files + "ORDER BY created DESC, sha256", {}, file_from);
    for (StoredFile& each : found)
        each.runs = database->texts(
            "SELECT run FROM files_of_runs WHERE sha256=? ORDER BY run DESC", {each.sha256});
    return found;
}

std::optional<StoredFile> Store::file(const std::string& sha256) const {
    return reader()->first(selected_files + "WHERE sha256=?", {sha256}, file_from);
}

std::vector<StoredFile> Store::files_of(const std::string& run) const {
    return reader()->select(
        selected_files +
            "WHERE sha256 IN (SELECT sha256 FROM files_of_runs WHERE run=?) ORDER BY sha256",
        {run}, file_from);
}

std::vector<StoredFile> Store::unused_files(const std::string& before) const {
    return reader()->select(selected_files + "WHERE used<? AND " + unneeded, {before}, file_from);
}

std::vector<std::string> Store::removals() const {
    return reader()->texts("SELECT run FROM removals ORDER BY run");
}

std::int64_t Store::free_pages() const {
    return reader()->integer("PRAGMA freelist_count").value();
}

}  // namespace breach::orchestrator
