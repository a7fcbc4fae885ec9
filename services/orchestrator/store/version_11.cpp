#include "services/orchestrator/store/versions.hpp"

namespace breach::orchestrator {

// What a run may spend and what it has spent: of every attempt that has ended, however it ended. What
// was taken from the cache had no attempt. Scenes that were stored, and the runs that were made of one.
const char* const version_11 = R"sql(
ALTER TABLE runs ADD COLUMN budget_cpu_seconds REAL CHECK (budget_cpu_seconds > 0);
CREATE INDEX runs_with_budget ON runs(id, budget_cpu_seconds) WHERE budget_cpu_seconds IS NOT NULL;

CREATE TABLE spendings (
    run TEXT PRIMARY KEY REFERENCES runs(id),
    cpu_seconds REAL NOT NULL
) STRICT;
INSERT INTO spendings SELECT tasks.run, sum(attempts.cpu_seconds) FROM attempts
    JOIN tasks ON tasks.id = attempts.task WHERE attempts.cpu_seconds IS NOT NULL GROUP BY tasks.run;
CREATE TRIGGER count_cpu_seconds AFTER UPDATE OF cpu_seconds ON attempts
    WHEN NEW.cpu_seconds IS NOT OLD.cpu_seconds BEGIN
    INSERT INTO spendings SELECT run, coalesce(NEW.cpu_seconds, 0) - coalesce(OLD.cpu_seconds, 0)
        FROM tasks WHERE id = NEW.task
    ON CONFLICT (run) DO UPDATE SET cpu_seconds = cpu_seconds + excluded.cpu_seconds;
END;

-- Completed scenes by their content, and the names that they were given: a name's newest version is
-- what it stands for.
CREATE TABLE scenes (
    sha256 TEXT PRIMARY KEY CHECK (length(sha256) = 64),
    document TEXT NOT NULL,
    created TEXT NOT NULL
) STRICT;
CREATE INDEX scenes_by_age ON scenes(created, sha256);
CREATE TABLE scene_names (
    name TEXT NOT NULL,
    version INTEGER NOT NULL,
    sha256 TEXT NOT NULL REFERENCES scenes(sha256),
    created TEXT NOT NULL,
    PRIMARY KEY (name, version)
) STRICT;
CREATE INDEX names_of_scene ON scene_names(sha256);
CREATE TABLE scenes_of_runs (
    run TEXT PRIMARY KEY REFERENCES runs(id),
    sha256 TEXT NOT NULL REFERENCES scenes(sha256),
    name TEXT,
    version INTEGER
) STRICT;
CREATE INDEX runs_of_scene ON scenes_of_runs(sha256, name);
CREATE TABLE files_of_scenes (
    scene TEXT NOT NULL REFERENCES scenes(sha256),
    sha256 TEXT NOT NULL REFERENCES files(sha256),
    PRIMARY KEY (scene, sha256)
) STRICT;
CREATE INDEX scenes_of_file ON files_of_scenes(sha256);
)sql";

}  // namespace breach::orchestrator
