// What of an open run has not ended, and how long its like took.
#include "services/orchestrator/store/store.hpp"

namespace breach::orchestrator {

/// What waits in a cluster's queue does not run yet; what runs has run as long as its attempts did.
/// The pace is of the last eight: a sweep goes from what stays to what flows, and its first say
/// little of its last.
std::vector<PhaseLeft> Store::left_of(const std::string& run) const {
    return reader()->select(
        R"(SELECT sum(NOT runs) AS waiting, sum(runs) AS running,
    total(iif(runs, ran_for, 0.0)) AS running_for,
    (SELECT avg(seconds) FROM (SELECT (SELECT sum(wall_seconds) FROM attempts
         WHERE attempts.task=tasks.id) AS seconds FROM tasks
     WHERE run=?1 AND state='succeeded' AND phase=open.phase ORDER BY started DESC LIMIT 8)) AS pace
FROM (SELECT phase, state IN ('running', 'finalizing', 'cancelling') AS runs,
    (SELECT total(coalesce(wall_seconds, iif(finished IS NULL,
         (julianday('now') - julianday(started)) * 86400.0, NULL)))
     FROM attempts WHERE attempts.task=tasks.id) AS ran_for
    FROM tasks WHERE run=?1 AND finished IS NULL) AS open GROUP BY phase)",
        {run}, [](const Row& row) {
            return PhaseLeft{.waiting = row.integer("waiting"),
                             .running = row.integer("running"),
                             .running_for = row.real("running_for"),
                             .pace = row.optional_real("pace")};
        });
}

}  // namespace breach::orchestrator
