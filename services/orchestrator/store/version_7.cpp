#include "services/orchestrator/store/versions.hpp"

namespace breach::orchestrator {

// A transfer beyond the regular end of its FEM (an entangled mesh) is skipped, but nothing failed.
const char* const version_7 = R"sql(
ALTER TABLE tasks ADD COLUMN not_reached INTEGER NOT NULL DEFAULT 0
    CHECK (not_reached IN (0, 1) AND (not_reached = 0 OR state IN ('blocked', 'skipped')));

DROP TRIGGER count_moved_task;
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
)sql";

}  // namespace breach::orchestrator
