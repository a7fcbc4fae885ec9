// Repeats of one setting (runs on moved lattices): mean, scatter, error of a mean, and the number
// of repeats for a required error.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "core/statistics/quantiles.hpp"

namespace breach::statistics {

struct Repeats {
    double mean = 0.0;
    std::optional<double> deviation;  ///< standard deviation of one repeat; none: only one repeat
    std::size_t count = 0;
};
/// At least one value.
Repeats repeats_of(std::span<const double> values);

/// Scatter of repeats, pooled over all settings with repeats.
struct Noise {
    double deviation;     ///< standard deviation of one run
    std::size_t freedom;  ///< its degrees of freedom, >= 1: repeats minus settings
};
/// None: no setting has repeats.
std::optional<Noise> pooled_noise(std::span<const Repeats> settings);

/// t s / sqrt(count): half of the 90 % confidence interval of the mean of `count` lattices.
double half_width_of_mean(const Noise& noise, std::size_t count);
/// The same with the scatter of these repeats alone; none: only one repeat.
std::optional<double> half_width_of_mean(const Repeats& repeats);

constexpr std::size_t most_draws_of_a_mean = 20;

/// Error of the mean of `draws` new repeats, relative to the reference, that 90 % of such means do
/// not exceed: the bias, and half of the prediction interval from the measured repeats, t s sqrt(1
/// / draws + 1 / measured); the second term because few repeats gave the bias. Only the bias if the
/// setting was measured once. bias >= 0, relative; reference must not be 0.
double promised_error(double bias, const Repeats& measured, double reference, std::size_t draws);

/// Fewest repeats whose mean is within `asked`; none: more than most_draws_of_a_mean.
std::optional<std::size_t> draws_within(double asked, double bias, const Repeats& measured,
                                        double reference);

}  // namespace breach::statistics
