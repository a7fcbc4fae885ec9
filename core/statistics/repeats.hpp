// Repeats of one setting on moved lattices: mean, scatter, and the error of a mean
// of few; the number of repeats (runs on moved lattices) whose mean keeps a given
// error.
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

/// Scatter of repeats of one setting, from all settings that were repeated.
struct Noise {
    double deviation;     ///< standard deviation of one run
    std::size_t freedom;  ///< degrees of freedom of that, >= 1: each repeat but a setting's first
};
/// Nothing: no setting was repeated.
std::optional<Noise> pooled_noise(std::span<const Repeats> settings);

/// t s / sqrt(count): the largest distance of the mean of `count` lattices from that of all, in
/// nine of ten cases.
double half_width_of_mean(const Noise& noise, std::size_t count);
/// The same with the scatter of these repeats alone; nothing: one repeat.
std::optional<double> half_width_of_mean(const Repeats& repeats);

constexpr std::size_t most_draws_of_a_mean = 20;

/// Largest error of the mean of `draws` new repeats, relative to the reference, in nine of ten
/// cases: the bias, which is the setting's own, and half of the interval that the measured repeats
/// predict for such a mean, t s sqrt(1 / draws + 1 / measured): the second term is there because few
/// repeats gave the bias. The scatter of a setting that was measured once is unknown: the bias
/// alone. bias >= 0, relative; reference other than zero.
double promised_error(double bias, const Repeats& measured, double reference, std::size_t draws);

/// The fewest repeats with a mean within `asked`; nothing: more than most_draws_of_a_mean.
std::optional<std::size_t> draws_within(double asked, double bias, const Repeats& measured,
                                        double reference);

}  // namespace breach::statistics
