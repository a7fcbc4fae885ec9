// Progress reports and stop requests for long computations.
// run.cpp connects it with the session's progress bar and stop requests.
#pragma once

#include <functional>

namespace breach::transfer {

struct Watch {
    /// Gets the completed share, in [0, 1]; returns false to stop. Called by one thread only.
    std::function<bool(double)> go_on = [](double) { return true; };
};

}  // namespace breach::transfer
