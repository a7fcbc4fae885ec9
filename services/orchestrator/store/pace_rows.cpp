// What of an open run has not ended, and how long its like took.
#include "services/orchestrator/store/store.hpp"

namespace breach::orchestrator {

namespace {

/// Of the last eight: a sweep goes from what stays to what flows, and its first say little of its last.
std::optional<double> pace_of(Connection& database, const std::string& run,
                              const std::string& phase) {
    std::optional<double> pace;
    database.query(
        "SELECT avg(seconds) FROM (SELECT (SELECT sum(wall_seconds) FROM attempts WHERE "
        "attempts.task=tasks.id) AS seconds FROM tasks WHERE run=?1 AND state='succeeded' AND "
        "phase=?2 ORDER BY started DESC LIMIT 8)",
        {run, phase}, [&](const Row& row) { pace = row.optional_real(0); });
    return pace;
}

}  // namespace

/// What waits in a cluster's queue does not run yet; what runs has run as long as its attempts did.
std::vector<PhaseLeft> Store::left_of(const std::string& run) const {
    std::vector<PhaseLeft> left;
    read([&](Connection& database) {
        std::vector<std::string> phases;
        database.query(
            "SELECT phase, sum(NOT runs), sum(runs), total(iif(runs, ran_for, 0.0)) FROM (SELECT "
            "phase, state IN ('running', 'finalizing', 'cancelling') AS runs, (SELECT "
            "total(coalesce(wall_seconds, iif(finished IS NULL, (julianday('now') - "
            "julianday(started)) * 86400.0, NULL))) FROM attempts WHERE attempts.task=tasks.id) AS "
            "ran_for FROM tasks WHERE run=? AND finished IS NULL) GROUP BY phase",
            {run}, [&](const Row& row) {
                phases.push_back(row.text(0));
                left.push_back({.waiting = row.integer(1),
                                .running = row.integer(2),
                                .running_for = row.real(3),
                                .pace = {}});
            });
        for (std::size_t p = 0; p < phases.size(); ++p)
            left[p].pace = pace_of(database, run, phases[p]);
    });
    return left;
}

}  // namespace breach::orchestrator
