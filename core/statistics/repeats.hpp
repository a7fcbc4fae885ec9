// Repeats of one setting on moved lattices: mean, scatter, and what the scatter leaves of a mean of
// few; how many draws (runs on moved lattices) must be averaged for their mean to keep an error that
// is asked for.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "core/statistics/quantiles.hpp"

namespace breach::statistics {

struct Repeats {
    double mean = 0.0;
    std::optional<double> deviation;  ///< standard deviation of one repeat; nothing: one repeat
    std::size_t count = 0;
};
/// At least one value.
Repeats repeats_of(std::span<const double> values);

/// How repeats of one setting scatter, from all settings that were repeated.
struct Noise {
    double deviation;     ///< standard deviation of one run
    std::size_t freedom;  ///< degrees of freedom of that, >= 1: each repeat but a setting's first
};
/// Nothing: no setting was repeated.
std::optional<Noise> pooled_noise(std::span<const Repeats> settings);

/// t s / sqrt(count): so far the mean of all lattices may be from that of `count`, in nine of ten
/// times.
double half_width_of_mean(const Noise& noise, std::size_t count);
/// The same with the scatter of these repeats alone; nothing: one repeat.
std::optional<double> half_width_of_mean(const Repeats& repeats);

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
