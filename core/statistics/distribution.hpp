// The distributions of uncertain numbers, each by its quantile function: a share of probability in, a
// value out. No random numbers here, and nothing of std's distributions, which differ between libraries.
#pragma once

#include <array>
#include <optional>

#include "core/words/words.hpp"

namespace breach::statistics {

enum class DistributionKind { uniform, log_uniform, normal, lognormal, triangular };
constexpr auto words_of(DistributionKind) {
    using enum DistributionKind;
    return words::in_order<DistributionKind>({{uniform, "uniform"},
                                              {log_uniform, "log_uniform"},
                                              {normal, "normal"},
                                              {lognormal, "lognormal"},
                                              {triangular, "triangular"}});
}

/// Meaning of the numbers by kind:
///     uniform, log_uniform   from, to
///     normal                 mean, standard deviation
///     lognormal              median, coefficient of variation (standard deviation over mean)
///     triangular             from, mode, to
struct Distribution {
    DistributionKind kind = DistributionKind::uniform;
    std::array<double, 3> numbers{};
    /// Truncation: the distribution given that the value lies between. Its quantiles are those of
    /// the shares between, so no value accumulates at an end.
    std::optional<std::array<double, 2>> between{};
};

/// Share of probability below x, without `between`.
double share_below(const Distribution& distribution, double x);
/// Share of probability inside `between`; 1 without it.
double share_between(const Distribution& distribution);
/// The value below which the share u lies, 0 < u < 1, with `between`.
double quantile(const Distribution& distribution, double u);

/// Rounded as text shows it: the number stored, set and shown is the same.
double in_six_digits(double value);

}  // namespace breach::statistics
