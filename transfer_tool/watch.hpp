// Progress reports and stop requests for long computations.
#pragma once

#include <functional>

namespace breach::transfer {

struct Watch {
    /// Takes the share that is done, in [0, 1]; false: stop. Called on one thread only.
    std::function<bool(double)> go_on = [](double) { return true; };
};

}  // namespace breach::transfer
