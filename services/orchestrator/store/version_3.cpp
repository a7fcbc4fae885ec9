#include "services/orchestrator/store/versions.hpp"

namespace breach::orchestrator {

const char* const version_3 = R"sql(
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

-- One row per transfer that a trigger made; a bisect makes several, every other kind at most one.
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

-- The tasks that one more transfer needs, with the time left open (firing_plan.hpp).
CREATE TABLE firing_plans (
    run TEXT PRIMARY KEY REFERENCES runs(id),
    tasks TEXT NOT NULL CHECK (json_valid(tasks))
) STRICT;

-- Latencies in ms: from the line that met the trigger to the snapshot on the disk, and to the start
-- of the transfer's process; lag in simulated seconds.
CREATE VIEW trigger_firings AS
SELECT triggers.run AS run, triggers.id AS trigger, triggers.name AS name, triggers.kind AS kind,
    firings.transfer_time AS transfer_time, firings.wanted_time AS wanted_time,
    firings.transfer_time - firings.wanted_time AS lag_s,
    firings.snapshot AS snapshot, firings.sha256 AS sha256, firings.crossed AS crossed,
    firings.fem_step AS fem_step, firings.noticed_at AS noticed_at,
    firings.written_at - firings.noticed_at AS snapshot_ms,
    firings.fired_at - firings.noticed_at AS fired_ms,
    (SELECT cast(round((julianday(min(attempts.started)) - 2440587.5) * 86400000.0) AS INTEGER)
        - firings.noticed_at
     FROM tasks JOIN attempts ON attempts.task = tasks.id
     WHERE tasks.parent = triggers.fem_task AND tasks.input = firings.snapshot) AS start_ms
FROM firings JOIN triggers ON triggers.id = firings.trigger;

-- A run with an open trigger is not over: it may still get tasks.
DROP VIEW run_summaries;
CREATE VIEW run_summaries AS
SELECT id, name, title, created, started, paused, sweep, total AS tasks_total, reached AS tasks_done,
    ended AS tasks_ended, failed AS tasks_failed,
    CASE WHEN is_open THEN CASE WHEN started IS NULL THEN 'queued' ELSE 'running' END
         WHEN cancelled > 0 THEN 'cancelled'
         WHEN failed = 0 THEN 'succeeded'
         WHEN runouts > 0 THEN 'partial'
         ELSE 'failed' END AS state,
    CASE WHEN NOT is_open THEN last_finished END AS finished
FROM (SELECT *, ended < total OR EXISTS (SELECT 1 FROM triggers
        WHERE triggers.run = runs.id AND triggers.state IN ('armed', 'holding')) AS is_open
      FROM runs JOIN run_counts ON run_counts.run = runs.id);

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
    mpm.id AS mpm_task,
    coalesce((SELECT group_concat(triggers.name, ' ') FROM triggers
        JOIN firings ON firings.trigger = triggers.id
        WHERE triggers.fem_task = transfer.parent AND firings.snapshot = transfer.input),
        'at_time') AS trigger
FROM tasks AS mpm JOIN tasks AS transfer ON transfer.id = mpm.parent
WHERE mpm.phase = 'mpm_solver' AND transfer.phase = 'transfer_tool';
)sql";

}  // namespace breach::orchestrator
