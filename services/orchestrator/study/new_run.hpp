// A checked study as the rows of its run. POST /v1/runs and POST /v1/sweeps store it in one
// transaction (http_submission.cpp); the dispatcher, woken then, starts what is ready.
#pragma once

#include "services/orchestrator/study/study.hpp"

namespace breach::orchestrator {

/// With a new id. numerics: of the installed phases, for the keys of the cache.
NewRun new_run(const Study& study, const Numerics& numerics);

}  // namespace breach::orchestrator
