// Shared by several routes: accepting a study (once per Idempotency-Key), and pages of lists.
#pragma once

#include "services/orchestrator/http/http_routes.hpp"

namespace breach::orchestrator {

/// The parameter limit: entries of one page.
std::size_t wanted_length(const Call& call);
/// Cuts a list that was read with one entry more than a page. Returns the mark after which the next
/// page begins, or null for the last page.
template <class Row, class Mark>
nlohmann::json cut_to(std::size_t length, std::vector<Row>& rows, const Mark& mark) {
    if (rows.size() <= length) return nullptr;
    rows.pop_back();
    return std::invoke(mark, rows.back());
}
/// (created, id) of a cursor "created~id", the "next" of an earlier page.
std::pair<std::string, std::string> place_of(const std::string& cursor);

enum class Ask { run, sweep };

/// Stores the study of the body as a run and returns its id; when this returns the answer may be
/// sent.
///
/// The header Idempotency-Key (1 to 255 visible ASCII characters) prevents a second run. Repeated
/// with the same body: the first run again (header Idempotent-Replayed: true); with another body:
/// 422 /problems/idempotency-key-reused; while the first is being stored: 409
/// /problems/idempotency-in-progress. A refused request does not use up its key. Keys are kept as
/// long as their runs.
std::string accept_study(Service& service, Call& call, Ask ask);

}  // namespace breach::orchestrator
