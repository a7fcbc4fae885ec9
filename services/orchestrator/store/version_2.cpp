#include "services/orchestrator/store/versions.hpp"

namespace breach::orchestrator {

// run_counts is filled by SQL triggers only, so that a run's state stays derived from its tasks and
// a list of runs costs as much for a sweep of 10,000 tasks as for one of three.
const char* const version_2 = R"sql(
ALTER TABLE runs ADD COLUMN paused INTEGER NOT NULL DEFAULT 0 CHECK (paused IN (0, 1));
ALTER TABLE runs ADD COLUMN sweep INTEGER NOT NULL DEFAULT 0 CHECK (sweep IN (0, 1));
ALTER TABLE runs ADD COLUMN last_task INTEGER NOT NULL DEFAULT 0;

ALTER TABLE tasks ADD COLUMN variant TEXT NOT NULL DEFAULT '';
ALTER TABLE tasks ADD COLUMN priority INTEGER NOT NULL DEFAULT 0;
ALTER TABLE tasks ADD COLUMN cores INTEGER NOT NULL DEFAULT 1 CHECK (cores >= 1);
ALTER TABLE tasks ADD COLUMN memory_mb INTEGER NOT NULL DEFAULT 0 CHECK (memory_mb >= 0);
-- The question that the task answers, without its input: phase, cache version, scene part.
ALTER TABLE tasks ADD COLUMN recipe TEXT REFERENCES recipes(hash);
ALTER TABLE tasks ADD COLUMN input_sha256 TEXT;
ALTER TABLE tasks ADD COLUMN same_as TEXT REFERENCES tasks(id);
-- Why an entry of the cache that fits was not served.
ALTER TABLE tasks ADD COLUMN cache_refusal TEXT;
ALTER TABLE tasks ADD COLUMN ready_at INTEGER;
UPDATE runs SET last_task = (SELECT count(*) FROM tasks WHERE tasks.run = runs.id);

CREATE TABLE recipes (
    hash TEXT PRIMARY KEY CHECK (length(hash) = 64),
    phase TEXT NOT NULL,
    cache_version INTEGER NOT NULL,
    part TEXT NOT NULL CHECK (json_valid(part))
) STRICT;
CREATE INDEX tasks_by_recipe ON tasks(recipe, input_sha256, id) WHERE state = 'succeeded';
CREATE INDEX tasks_by_phase ON tasks(phase, id) WHERE recipe IS NOT NULL;
CREATE INDEX tasks_to_start ON tasks(priority DESC, id) WHERE state = 'ready';
CREATE INDEX tasks_with_faults ON tasks(run, id) WHERE fault_summary IS NOT NULL;
CREATE INDEX tasks_unfinished ON tasks(run) WHERE finished IS NULL;
CREATE INDEX runs_paused ON runs(id) WHERE paused = 1;
CREATE INDEX runs_by_time ON runs(created, id);
CREATE INDEX runs_by_name ON runs(name, created, id);

CREATE TABLE idempotency_keys (
    key TEXT PRIMARY KEY,
    body_sha256 TEXT NOT NULL CHECK (length(body_sha256) = 64),
    run TEXT NOT NULL REFERENCES runs(id),
    created TEXT NOT NULL
) STRICT;

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

INSERT INTO run_counts SELECT run, min(started), max(finished), count(*), count(finished),
    sum(state IN ('succeeded', 'cached')), sum(state IN ('failed', 'skipped')), sum(state = 'cancelled'),
    sum(phase = 'mpm_solver' AND state IN ('succeeded', 'cached'))
FROM tasks GROUP BY run;

CREATE TRIGGER count_new_task AFTER INSERT ON tasks BEGIN
    INSERT INTO run_counts VALUES (NEW.run, NEW.started, NEW.finished, 1, NEW.finished IS NOT NULL,
        NEW.state IN ('succeeded', 'cached'), NEW.state IN ('failed', 'skipped'), NEW.state = 'cancelled',
        NEW.phase = 'mpm_solver' AND NEW.state IN ('succeeded', 'cached'))
    ON CONFLICT (run) DO UPDATE SET total = total + 1, ended = ended + excluded.ended,
        reached = reached + excluded.reached, failed = failed + excluded.failed,
        cancelled = cancelled + excluded.cancelled, runouts = runouts + excluded.runouts;
END;

CREATE TRIGGER count_moved_task AFTER UPDATE OF state ON tasks WHEN OLD.state <> NEW.state BEGIN
    UPDATE run_counts SET
        started = coalesce(started, NEW.started),
        last_finished = max(coalesce(last_finished, ''), coalesce(NEW.finished, last_finished, '')),
        ended = ended + (NEW.finished IS NOT NULL) - (OLD.finished IS NOT NULL),
        reached = reached + (NEW.state IN ('succeeded', 'cached')) - (OLD.state IN ('succeeded', 'cached')),
        failed = failed + (NEW.state IN ('failed', 'skipped')) - (OLD.state IN ('failed', 'skipped')),
        cancelled = cancelled + (NEW.state = 'cancelled') - (OLD.state = 'cancelled'),
        runouts = runouts + (NEW.phase = 'mpm_solver') *
            ((NEW.state IN ('succeeded', 'cached')) - (OLD.state IN ('succeeded', 'cached')))
    WHERE run = NEW.run;
END;

DROP VIEW run_summaries;
CREATE VIEW run_summaries AS
SELECT id, name, title, created, started, paused, sweep, total AS tasks_total, reached AS tasks_done,
    ended AS tasks_ended, failed AS tasks_failed,
    CASE WHEN ended < total THEN CASE WHEN started IS NULL THEN 'queued' ELSE 'running' END
         WHEN cancelled > 0 THEN 'cancelled'
         WHEN failed = 0 THEN 'succeeded'
         WHEN runouts > 0 THEN 'partial'
         ELSE 'failed' END AS state,
    CASE WHEN ended = total THEN last_finished END AS finished
FROM runs JOIN run_counts ON run_counts.run = runs.id;

-- One row per variant and transfer time: the runout, or why there is none. The two indicators of
-- error are the MPM's own: energy made or lost by the numerics, and soil that lies in other soil.
DROP VIEW sweep_results;
CREATE VIEW sweep_results AS
SELECT mpm.run AS run,
    mpm.variant AS variant,
    mpm.transfer_time AS transfer_time,
    CASE WHEN transfer.state IN ('failed', 'skipped') THEN transfer.state
         WHEN mpm.state = 'cached' THEN 'succeeded' ELSE mpm.state END AS state,
    mpm.state = 'cached' AS reused,
    json_extract(mpm.result, '$.runout') AS runout,
    json_extract(mpm.result, '$.runout_beyond_toe') AS runout_beyond_toe,
    json_extract(mpm.result, '$.runout_largest') AS runout_largest,
    json_extract(mpm.result, '$.volume_ratio') AS volume_ratio,
    json_extract(mpm.result, '$.energy.numerical.share') AS numerical_share,
    json_extract(mpm.result, '$.overlap') AS overlap,
    json_extract(mpm.result, '$.cpu_seconds') AS cpu_seconds,
    coalesce(transfer.fault_summary, mpm.fault_summary, '') AS reason,
    transfer.id AS transfer_task,
    mpm.id AS mpm_task
FROM tasks AS mpm JOIN tasks AS transfer ON transfer.id = mpm.parent
WHERE mpm.phase = 'mpm_solver' AND transfer.phase = 'transfer_tool';
)sql";

}  // namespace breach::orchestrator
