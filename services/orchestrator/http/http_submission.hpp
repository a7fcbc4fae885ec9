// What several routes share: taking a study in (once per Idempotency-Key), and pages of lists.
#pragma once

#include "services/orchestrator/http/http_routes.hpp"

namespace breach::orchestrator {

/// The parameter limit: entries of one page.
std::size_t wanted_length(const Call& call);
/// Of a list that was read with one entry more than its page has, the page; what the next one begins
/// after, or null: this is the last.
template <class Row, class Mark>
nlohmann::json cut_to(std::size_t length, std::vector<Row>& rows, const Mark& mark) {
    if (rows.size() <= length) return nullptr;
    rows.pop_back();
    return std::invoke(mark, rows.back());
}
/// (created, id) of a cursor "created~id", the "next" of an earlier page.
std::pair<std::string, std::string> place_of(const std::string& cursor);

enum class Ask { run, sweep };

struct Accepted {
    std::string run;
    std::vector<fault::Flag>
        warnings;  ///< of the study; empty where the request was a repeated one
};

/// Stores the study of the body as a run; the answer may be sent when this returns.
///
/// With the header Idempotency-Key (1 to 255 visible ASCII characters) a repeated request makes no
/// second run: same body: the first run again (header Idempotent-Replayed: true); another body: 422
/// /problems/idempotency-key-reused; while the first is still being stored: 409
/// /problems/idempotency-in-progress. A request that was refused does not use its key up. Keys are
/// kept for as long as their runs.
Accepted accept_study(Service& service, Call& call, Ask ask);

/// Stores a study that the service itself has made; the run's id.
std::string accept_made_study(Service& service, const Call& call, const nlohmann::json& study);

}  // namespace breach::orchestrator
