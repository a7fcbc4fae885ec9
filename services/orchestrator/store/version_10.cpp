#include "services/orchestrator/store/versions.hpp"

namespace breach::orchestrator {

// Runs are removed: what names a run from outside keeps no reference to it that would hold it, and
// what is looked for by a reference has its index. The event that says so outlives its run. A task
// that was answered from the cache answers others when the first is gone.
const char* const version_10 = R"sql(
ALTER TABLE runs ADD COLUMN pinned INTEGER NOT NULL DEFAULT 0 CHECK (pinned IN (0, 1));

CREATE TABLE events_10 (
    seq INTEGER PRIMARY KEY AUTOINCREMENT,
    time TEXT NOT NULL,
    run TEXT NOT NULL,
    task TEXT,
    kind TEXT NOT NULL CHECK (kind IN ('run', 'task', 'attempt')),
    detail TEXT NOT NULL CHECK (json_valid(detail))
) STRICT;
INSERT INTO events_10 SELECT seq, time, run, task, kind, detail FROM events ORDER BY seq;
DROP TABLE events;
ALTER TABLE events_10 RENAME TO events;
CREATE INDEX events_of_run ON events(run, seq);

DROP INDEX tasks_by_recipe;
CREATE INDEX tasks_by_recipe ON tasks(recipe, input_sha256, id)
    WHERE state IN ('succeeded', 'cached') OR (state = 'failed' AND fault_exit = 70);
CREATE INDEX tasks_of_recipe ON tasks(recipe) WHERE recipe IS NOT NULL;
CREATE INDEX tasks_same_as ON tasks(same_as) WHERE same_as IS NOT NULL;
CREATE INDEX keys_of_run ON idempotency_keys(run);

-- Runs that are gone from the tables and perhaps not yet from the disk.
CREATE TABLE removals (
    run TEXT PRIMARY KEY,
    asked TEXT NOT NULL
) STRICT;

-- Files that were sent, by their content, and the runs whose scenes name them.
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
)sql";

}  // namespace breach::orchestrator
