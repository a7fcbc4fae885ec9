// Rows of the batches of samples (Batches in records/records.hpp). BatchWatch reads the open ones
// and ends them; Transaction::cancel_run stops and Transaction::retry_run opens them.
#include "services/orchestrator/store/store.hpp"

namespace breach::orchestrator {

namespace {

const std::string selected_batches = "SELECT run, spec, state, reason FROM batches ";

Batches batches_from(const Row& row) {
    return {row.text("run"), row.document("spec"), row.text("state"), row.text("reason")};
}

}  // namespace

bool Transaction::batches_are_open(const std::string& run) const {
    return database_.finds("SELECT 1 FROM batches WHERE run=? AND state='open'", {run});
}

void Transaction::end_batches(const std::string& run, const std::string& state,
                              const std::string& reason) {
    if (database_.change("UPDATE batches SET state=?, reason=? WHERE run=? AND state='open'",
                         {state, reason, run}) > 0)
        add_run_event(run, {{"event", "batches"}, {"to", state}, {"why", reason}});
}

void Transaction::open_batches(const std::string& run, bool tasks_run_again) {
    // A plan that was given up gets another chance only if the retry computes something new.
    const std::string ended = tasks_run_again ? "('given_up', 'stopped')" : "('stopped')";
    if (database_.change(
            "UPDATE batches SET state='open', reason='' WHERE run=? AND state IN " + ended, {run}) >
        0)
        add_run_event(run, {{"event", "batches"}, {"to", "open"}});
}

std::vector<Batches> Store::open_batches() const {
    return reader()->select(selected_batches + "WHERE state='open' ORDER BY run", {}, batches_from);
}

std::optional<Batches> Store::batches_of(const std::string& run) const {
    return reader()->first(selected_batches + "WHERE run=?", {run}, batches_from);
}

}  // namespace breach::orchestrator
