// Tables, indexes and SQL triggers of a new database. There is no migration: another version is
// refused with the command that exports its runs. Views are made anew whenever their text changes
// (store/views.cpp), without a new version.
#include "services/orchestrator/store/schema.hpp"

#include "services/orchestrator/store/views.hpp"

namespace breach::orchestrator {

namespace {

/// Raise it with every change of a table, index or SQL trigger below.
constexpr std::int64_t this_version = 15;

/// run_counts and flags are kept by SQL triggers rather than by the service: they change with
/// every move of a task in the same transaction, and a list of runs reads one row per run instead
/// of thousands of tasks. Partial indexes stay small: they hold only rows that wait, are open or
/// have a fault, and SQLite uses one only if the query repeats its condition. one_live_attempt
/// makes a second process for a task an error. The states' meaning: records/lifecycle.hpp and
/// records/trigger.hpp.
const char* const tables = R"sql(
-- What a phase computes: equal recipes and inputs have equal results.
CREATE TABLE recipes (
    hash TEXT PRIMARY KEY CHECK (length(hash) = 64),
    phase TEXT NOT NULL,
    cache_version INTEGER NOT NULL,
    part TEXT NOT NULL CHECK (json_valid(part))
) STRICT;

-- warnings: flags of the submission. last_task: the largest task number that was given.
CREATE TABLE runs (
    id TEXT PRIMARY KEY,
    name TEXT NOT NULL,
    title TEXT NOT NULL,
    created TEXT NOT NULL,
    study TEXT NOT NULL CHECK (json_valid(study)),
    scene TEXT NOT NULL CHECK (json_valid(scene)),
    warnings TEXT NOT NULL DEFAULT '[]' CHECK (json_valid(warnings)),
    paused INTEGER NOT NULL DEFAULT 0 CHECK (paused IN (0, 1)),
    sweep INTEGER NOT NULL DEFAULT 0 CHECK (sweep IN (0, 1)),
    last_task INTEGER NOT NULL DEFAULT 0
) STRICT;
CREATE INDEX runs_paused ON runs(id) WHERE paused = 1;
CREATE INDEX runs_by_time ON runs(created, id);
CREATE INDEX runs_by_name ON runs(name, created, id);
CREATE INDEX runs_with_accuracy ON runs(id) WHERE json_type(study, '$.accuracy')='object';

-- The CHECKs repeat what lifecycle.cpp promises, so that a slip shows as an error.
CREATE TABLE tasks (
    id TEXT PRIMARY KEY,
    run TEXT NOT NULL REFERENCES runs(id),
    phase TEXT NOT NULL,
    label TEXT NOT NULL,
    transfer_time REAL,
    parent TEXT REFERENCES tasks(id),
    release TEXT NOT NULL CHECK (release IN ('at_once', 'file_exists', 'parent_succeeded')),
    input TEXT NOT NULL,
    overrides TEXT NOT NULL CHECK (json_valid(overrides)),
    state TEXT NOT NULL CHECK (state IN ('blocked', 'ready', 'cached', 'starting', 'running', 'finalizing',
        'succeeded', 'failed', 'lost', 'retry_wait', 'cancelling', 'cancelled', 'skipped')),
    tries INTEGER NOT NULL DEFAULT 0,
    retry_at INTEGER,
    started TEXT,
    finished TEXT,
    result TEXT CHECK (result IS NULL OR json_valid(result)),
    fault_exit INTEGER,
    fault_summary TEXT,
    variant TEXT NOT NULL DEFAULT '',
    priority INTEGER NOT NULL DEFAULT 0,
    cores INTEGER NOT NULL DEFAULT 1 CHECK (cores >= 1),
    memory_mb INTEGER NOT NULL DEFAULT 0 CHECK (memory_mb >= 0),
    recipe TEXT REFERENCES recipes(hash),
    input_sha256 TEXT,
    same_as TEXT REFERENCES tasks(id),
    cache_refusal TEXT,
    ready_at INTEGER,
    not_reached INTEGER NOT NULL DEFAULT 0
    CHECK (not_reached IN (0, 1) AND (not_reached = 0 OR state IN ('blocked', 'skipped'))),
    UNIQUE (run, label),
    CHECK ((state = 'retry_wait') = (retry_at IS NOT NULL)),
    CHECK ((state IN ('cached', 'succeeded', 'failed', 'cancelled', 'skipped')) = (finished IS NOT NULL)),
    CHECK (state <> 'succeeded' OR result IS NOT NULL)
) STRICT;
CREATE INDEX tasks_by_state ON tasks(state, id);
CREATE INDEX tasks_by_run ON tasks(run, state, started, finished);
CREATE INDEX tasks_by_phase ON tasks(phase, id) WHERE recipe IS NOT NULL;
CREATE INDEX tasks_to_start ON tasks(priority DESC, id) WHERE state = 'ready';
CREATE INDEX tasks_with_faults ON tasks(run, id) WHERE fault_summary IS NOT NULL;
CREATE INDEX tasks_unstable ON tasks(run) WHERE phase = 'lem_tool' AND json_extract(result, '$.factor_of_safety') < 1;
CREATE INDEX tasks_unfinished ON tasks(run) WHERE finished IS NULL;
CREATE INDEX tasks_by_parent ON tasks(parent, state, id);
CREATE INDEX tasks_of_sweep ON tasks(run, phase, variant, transfer_time, id);
CREATE INDEX tasks_by_recipe ON tasks(recipe, input_sha256, id)
    WHERE state IN ('succeeded', 'cached') OR (state = 'failed' AND fault_exit = 70);
CREATE INDEX tasks_of_recipe ON tasks(recipe) WHERE recipe IS NOT NULL;
CREATE INDEX tasks_same_as ON tasks(same_as) WHERE same_as IS NOT NULL;

CREATE TABLE attempts (
    task TEXT NOT NULL REFERENCES tasks(id),
    number INTEGER NOT NULL,
    state TEXT NOT NULL CHECK (state IN ('submitting', 'submitted', 'running', 'exited', 'lost')),
    created TEXT NOT NULL,
    started TEXT,
    finished TEXT,
    exit_code INTEGER,
    signal INTEGER,
    wall_seconds REAL,
    cpu_seconds REAL,
    PRIMARY KEY (task, number)
) STRICT;
CREATE UNIQUE INDEX one_live_attempt ON attempts(task) WHERE state IN ('submitting', 'submitted', 'running');

CREATE TABLE artifacts (
    task TEXT NOT NULL REFERENCES tasks(id),
    name TEXT NOT NULL,
    sha256 TEXT NOT NULL CHECK (length(sha256) = 64),
    bytes INTEGER NOT NULL,
    PRIMARY KEY (task, name)
) STRICT;
CREATE INDEX artifacts_by_hash ON artifacts(sha256);

-- No reference to runs: the event of a removal outlives its run.
CREATE TABLE events (
    seq INTEGER PRIMARY KEY AUTOINCREMENT,
    time TEXT NOT NULL,
    run TEXT NOT NULL,
    task TEXT,
    kind TEXT NOT NULL CHECK (kind IN ('run', 'task', 'attempt')),
    detail TEXT NOT NULL CHECK (json_valid(detail))
) STRICT;
CREATE INDEX events_of_run ON events(run, seq);

-- place: order in the study. draw_of: the variant that a draw repeats.
CREATE TABLE variants (
    run TEXT NOT NULL REFERENCES runs(id),
    name TEXT NOT NULL,
    place INTEGER NOT NULL,
    draw_of TEXT,
    PRIMARY KEY (run, name)
) STRICT;

CREATE TABLE idempotency_keys (
    key TEXT PRIMARY KEY,
    body_sha256 TEXT NOT NULL CHECK (length(body_sha256) = 64),
    run TEXT NOT NULL REFERENCES runs(id),
    created TEXT NOT NULL
) STRICT;
CREATE INDEX keys_of_run ON idempotency_keys(run);

-- A run's state follows from its tasks; counted by the triggers below.
CREATE TABLE run_counts (
    run TEXT PRIMARY KEY REFERENCES runs(id),
    started TEXT,
    last_finished TEXT,
    total INTEGER NOT NULL,
    ended INTEGER NOT NULL,
    reached INTEGER NOT NULL,
    failed INTEGER NOT NULL,
    cancelled INTEGER NOT NULL,
    runouts INTEGER NOT NULL
) STRICT;

-- Filled from tasks.result by the trigger gather_flags.
CREATE TABLE flags (
    task TEXT NOT NULL REFERENCES tasks(id),
    run TEXT NOT NULL REFERENCES runs(id),
    phase TEXT NOT NULL,
    code TEXT NOT NULL,
    severity TEXT NOT NULL,
    message TEXT NOT NULL,
    pointer TEXT NOT NULL
) STRICT;
CREATE INDEX flags_of_task ON flags(task, severity);
CREATE INDEX flags_of_run ON flags(run, severity, code, phase, task);

CREATE TABLE triggers (
    id TEXT PRIMARY KEY,
    run TEXT NOT NULL REFERENCES runs(id),
    fem_task TEXT NOT NULL REFERENCES tasks(id),
    name TEXT NOT NULL,
    kind TEXT NOT NULL CHECK (kind IN ('manual', 'criterion', 'window', 'bisect')),
    spec TEXT NOT NULL CHECK (json_valid(spec)),
    state TEXT NOT NULL CHECK (state IN ('armed', 'holding', 'fired', 'expired', 'disarmed')),
    reason TEXT NOT NULL DEFAULT '',
    result TEXT CHECK (result IS NULL OR json_valid(result)),
    created TEXT NOT NULL,
    changed TEXT NOT NULL,
    UNIQUE (fem_task, name)
) STRICT;
CREATE INDEX triggers_of_run ON triggers(run, id);
CREATE INDEX triggers_open ON triggers(run, fem_task) WHERE state IN ('armed', 'holding');

-- See Batches in records/records.hpp.
CREATE TABLE batches (
    run TEXT PRIMARY KEY REFERENCES runs(id),
    spec TEXT NOT NULL CHECK (json_valid(spec)),
    state TEXT NOT NULL DEFAULT 'open' CHECK (state IN ('open', 'met', 'given_up', 'stopped')),
    reason TEXT NOT NULL DEFAULT ''
) STRICT;
CREATE INDEX batches_open ON batches(run) WHERE state = 'open';

CREATE TABLE firings (
    trigger TEXT NOT NULL REFERENCES triggers(id),
    transfer_time REAL NOT NULL,
    wanted_time REAL NOT NULL,
    snapshot TEXT NOT NULL,
    sha256 TEXT NOT NULL CHECK (length(sha256) = 64),
    crossed TEXT NOT NULL CHECK (json_valid(crossed)),
    fem_step INTEGER NOT NULL,
    noticed_at INTEGER NOT NULL,
    written_at INTEGER NOT NULL,
    fired_at INTEGER NOT NULL,
    PRIMARY KEY (trigger, transfer_time)
) STRICT;

CREATE TABLE firing_plans (
    run TEXT PRIMARY KEY REFERENCES runs(id),
    tasks TEXT NOT NULL CHECK (json_valid(tasks))
) STRICT;

-- Runs that are gone from the tables and perhaps not yet from the disk.
CREATE TABLE removals (
    run TEXT PRIMARY KEY,
    asked TEXT NOT NULL
) STRICT;

-- Files that were sent, by content, and the runs whose scenes name them.
CREATE TABLE files (
    sha256 TEXT PRIMARY KEY CHECK (length(sha256) = 64),
    file TEXT NOT NULL,
    name TEXT NOT NULL,
    kind TEXT NOT NULL,
    about TEXT NOT NULL,
    bytes INTEGER NOT NULL,
    created TEXT NOT NULL,
    used TEXT NOT NULL
) STRICT;

CREATE TABLE files_of_runs (
    run TEXT NOT NULL REFERENCES runs(id),
    sha256 TEXT NOT NULL REFERENCES files(sha256),
    PRIMARY KEY (run, sha256)
) STRICT;
CREATE INDEX runs_of_file ON files_of_runs(sha256);

CREATE TRIGGER count_new_task AFTER INSERT ON tasks BEGIN
    INSERT INTO run_counts VALUES (NEW.run, NEW.started, NEW.finished, 1, NEW.finished IS NOT NULL,
        NEW.state IN ('succeeded', 'cached'), NEW.state IN ('failed', 'skipped'), NEW.state = 'cancelled',
        NEW.phase = 'mpm_solver' AND NEW.state IN ('succeeded', 'cached'))
    ON CONFLICT (run) DO UPDATE SET total = total + 1, ended = ended + excluded.ended,
        reached = reached + excluded.reached, failed = failed + excluded.failed,
        cancelled = cancelled + excluded.cancelled, runouts = runouts + excluded.runouts;
END;
CREATE TRIGGER gather_flags AFTER UPDATE OF result ON tasks BEGIN
    DELETE FROM flags WHERE task = NEW.id;
    INSERT INTO flags SELECT NEW.id, NEW.run, NEW.phase, coalesce(json_extract(value, '$.code'), ''),
        coalesce(json_extract(value, '$.severity'), ''), coalesce(json_extract(value, '$.message'), ''),
        coalesce(json_extract(value, '$.pointer'), '')
        FROM json_each(NEW.result, '$.flags') WHERE type = 'object';
END;
CREATE TRIGGER count_moved_task AFTER UPDATE OF state ON tasks WHEN OLD.state <> NEW.state BEGIN
    UPDATE run_counts SET
        started = coalesce(started, NEW.started),
        last_finished = max(coalesce(last_finished, ''), coalesce(NEW.finished, last_finished, '')),
        ended = ended + (NEW.finished IS NOT NULL) - (OLD.finished IS NOT NULL),
        reached = reached + (NEW.state IN ('succeeded', 'cached')) - (OLD.state IN ('succeeded', 'cached')),
        failed = failed + (NEW.state IN ('failed', 'skipped') AND NOT NEW.not_reached)
            - (OLD.state IN ('failed', 'skipped') AND NOT OLD.not_reached),
        cancelled = cancelled + (NEW.state = 'cancelled') - (OLD.state = 'cancelled'),
        runouts = runouts + (NEW.phase = 'mpm_solver') *
            ((NEW.state IN ('succeeded', 'cached')) - (OLD.state IN ('succeeded', 'cached')))
    WHERE run = NEW.run;
END;
CREATE TRIGGER order_variants AFTER INSERT ON runs BEGIN
    INSERT OR IGNORE INTO variants SELECT NEW.id, json_extract(value, '$.name'), key,
        CASE WHEN coalesce(json_extract(NEW.study, '$.draws'), 1) < 2 THEN NULL
             WHEN coalesce(json_extract(value, '$.made_by'), '') <> 'draws' THEN json_extract(value, '$.name')
             ELSE substr(json_extract(value, '$.name'), 1,
                 max(0, length(rtrim(json_extract(value, '$.name'), '0123456789')) - 2)) END
        FROM json_each(NEW.study, '$.variants') WHERE json_extract(value, '$.name') IS NOT NULL;
END;)sql";

}  // namespace

std::int64_t version_of(Connection& database) {
    return database.integer("PRAGMA user_version").value();
}

std::optional<std::string> refusal_of(std::int64_t version) {
    if (version == 0 || version == this_version) return std::nullopt;
    return "is of version " + std::to_string(version) + ", this program reads version " +
           std::to_string(this_version) +
           ": export its runs with the program that made it (breach export RUN FOLDER), then begin "
           "with another folder (--data)";
}

/// Called once per start. BEGIN IMMEDIATE: two services that start on one folder make the tables
/// once; killed in between, SQLite rolls back and the next start finds version 0.
void make_schema(Connection& database, const std::filesystem::path& file) {
    const std::int64_t version = version_of(database);
    if (const auto refusal = refusal_of(version)) throw StoreError(file.string() + " " + *refusal);
    if (version == this_version && views_are_current(database)) return;
    database.script("BEGIN IMMEDIATE");
    try {
        if (version == 0) database.script(tables);
        make_views(database);
        database.script("PRAGMA user_version=" + std::to_string(this_version));
        database.script("COMMIT");
    } catch (const StoreError&) {
        database.script("ROLLBACK");
        throw;
    }
}

}  // namespace breach::orchestrator
