// The distribution function of the beta distribution.
#pragma once

namespace breach::statistics {

/// I_x(a, b): the probability that a beta variable with a, b > 0 is at most x in [0, 1]
/// (Abramowitz & Stegun 1964, 26.5.8, the continued fraction), to about 1e-14.
double incomplete_beta(double a, double b, double x);

}  // namespace breach::statistics
