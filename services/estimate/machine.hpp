// Speed of this machine, for forecasts: their rates are of one reference machine.
#pragma once

namespace breach::estimate {

/// CPU time of a fixed workload over that of the reference machine: 2 on one half as fast. Measured
/// by the first call, in some 30 ms.
double slowness();

}  // namespace breach::estimate
