#include "services/orchestrator/store/versions.hpp"

namespace breach::orchestrator {

// The CHECKs repeat what lifecycle.cpp promises, so that a slip shows as an error and not as a lie.
const char* const version_1 = R"sql(
CREATE TABLE runs (
    id TEXT PRIMARY KEY,
    name TEXT NOT NULL,
    title TEXT NOT NULL,
    created TEXT NOT NULL,
    study TEXT NOT NULL CHECK (json_valid(study)),
    scene TEXT NOT NULL CHECK (json_valid(scene))
) STRICT;

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
    UNIQUE (run, label),
    CHECK ((state = 'retry_wait') = (retry_at IS NOT NULL)),
    CHECK ((state IN ('cached', 'succeeded', 'failed', 'cancelled', 'skipped')) = (finished IS NOT NULL)),
    CHECK (state <> 'succeeded' OR result IS NOT NULL)
) STRICT;
CREATE INDEX tasks_by_state ON tasks(state, id);
CREATE INDEX tasks_by_parent ON tasks(parent, state);
CREATE INDEX tasks_by_run ON tasks(run, state, started, finished);

CREATE TABLE attempts (
    task TEXT NOT NULL REFERENCES tasks(id),
    number INTEGER NOT NULL,
    state TEXT NOT NULL CHECK (state IN ('submitting', 'submitted', 'running', 'exited', 'lost', 'fenced')),
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

CREATE TABLE events (
    seq INTEGER PRIMARY KEY AUTOINCREMENT,
    time TEXT NOT NULL,
    run TEXT NOT NULL REFERENCES runs(id),
    task TEXT REFERENCES tasks(id),
    kind TEXT NOT NULL CHECK (kind IN ('run', 'task', 'attempt')),
    detail TEXT NOT NULL CHECK (json_valid(detail))
) STRICT;

CREATE TABLE artifacts (
    task TEXT NOT NULL REFERENCES tasks(id),
    name TEXT NOT NULL,
    sha256 TEXT NOT NULL CHECK (length(sha256) = 64),
    bytes INTEGER NOT NULL,
    PRIMARY KEY (task, name)
) STRICT;
CREATE INDEX artifacts_by_hash ON artifacts(sha256);

-- A run's state is what its tasks say.
CREATE VIEW run_summaries AS
SELECT id, name, title, created, started, tasks_total, tasks_done, tasks_failed,
    CASE WHEN tasks_done < tasks_total THEN CASE WHEN started IS NULL THEN 'queued' ELSE 'running' END
         WHEN tasks_cancelled > 0 THEN 'cancelled'
         WHEN tasks_failed = 0 THEN 'succeeded'
         WHEN runouts > 0 THEN 'partial'
         ELSE 'failed' END AS state,
    CASE WHEN tasks_done = tasks_total THEN last_finished END AS finished
FROM (
    SELECT runs.id, runs.name, runs.title, runs.created,
        min(tasks.started) AS started,
        max(tasks.finished) AS last_finished,
        count(*) AS tasks_total,
        count(tasks.finished) AS tasks_done,
        sum(tasks.state IN ('failed', 'skipped')) AS tasks_failed,
        sum(tasks.state = 'cancelled') AS tasks_cancelled,
        sum(tasks.phase = 'mpm_solver' AND tasks.state IN ('succeeded', 'cached')) AS runouts
    FROM runs JOIN tasks ON tasks.run = runs.id GROUP BY runs.id);

-- One row per transfer time: the runout, or why there is none.
CREATE VIEW sweep_results AS
SELECT mpm.run AS run,
    mpm.transfer_time AS transfer_time,
    CASE WHEN transfer.state IN ('failed', 'skipped') THEN transfer.state ELSE mpm.state END AS state,
    json_extract(mpm.result, '$.runout') AS runout,
    json_extract(mpm.result, '$.runout_beyond_toe') AS runout_beyond_toe,
    json_extract(mpm.result, '$.runout_largest') AS runout_largest,
    json_extract(mpm.result, '$.volume_ratio') AS volume_ratio,
    json_extract(mpm.result, '$.energy.numerical.share') AS numerical_share,
    json_extract(mpm.result, '$.cpu_seconds') AS cpu_seconds,
    coalesce(transfer.fault_summary, mpm.fault_summary, '') AS reason,
    transfer.id AS transfer_task,
    mpm.id AS mpm_task
FROM tasks AS mpm JOIN tasks AS transfer ON transfer.id = mpm.parent
WHERE mpm.phase = 'mpm_solver' AND transfer.phase = 'transfer_tool';
)sql";

}  // namespace breach::orchestrator
