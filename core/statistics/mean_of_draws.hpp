// How many draws of a setting (runs on moved lattices) must be averaged for their mean to keep an
// error that is asked for. Pure functions of numbers; nothing here knows runs.
#pragma once

#include <cstddef>
#include <optional>

#include "core/statistics/convergence.hpp"

namespace breach::statistics {

constexpr std::size_t most_draws_of_a_mean = 20;

/// What the mean of `draws` new draws is off at most, relative to the reference, in nine of ten
/// times: the bias, which is the setting's own, and half of the interval that the measured draws
/// predict for such a mean, t s sqrt(1 / draws + 1 / measured): the second term is there because the
/// bias was measured by few draws. Of a setting that was measured once the scatter is not known: the
/// bias alone. bias >= 0, relative; reference other than zero.
double promised_error(double bias, const Repeats& measured, double reference, std::size_t draws);

/// The fewest draws whose mean keeps `asked`; nothing: not even most_draws_of_a_mean do.
std::optional<std::size_t> draws_within(double asked, double bias, const Repeats& measured,
                                        double reference);

}  // namespace breach::statistics
