// Repeats of one setting on moved lattices: mean, scatter, and what the scatter leaves of a mean of
// few. Pure functions of numbers.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

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
    double deviation;  ///< standard deviation of one run
    std::size_t
        freedom;  ///< degrees of freedom of that, >= 1: each repeat beyond a setting's first
};
/// Nothing: no setting was repeated.
std::optional<Noise> pooled_noise(std::span<const Repeats> settings);

/// Of the means, so many are to keep what is promised of them.
constexpr double confidence = 0.9;

/// t s / sqrt(count): so far the mean of all repeats may be from that of `count`, in nine of ten times.
double half_width_of_mean(const Noise& noise, std::size_t count);
/// The same of these repeats alone: so far the mean of all lattices may be from that of these, in nine of ten times;
/// nothing: one repeat.
std::optional<double> half_width_of_mean(const Repeats& repeats);

}  // namespace breach::statistics
