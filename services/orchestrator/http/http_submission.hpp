// What several routes share: taking a study in (once per Idempotency-Key), and a page of runs.
#pragma once

#include "services/orchestrator/http/http_routes.hpp"

namespace breach::orchestrator {

constexpr std::int64_t longest_list = 500;  ///< entries of one page
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

struct RunPage {
    std::vector<Run> runs;
    nlohmann::json next;  ///< cursor of the next page, or null
};

/// The parameters limit, cursor, state and name on top of `filter`.
RunPage wanted_page(const Service& service, const Call& call, RunFilter filter);

}  // namespace breach::orchestrator
