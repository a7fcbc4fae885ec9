// Distributions of uncertain numbers by their quantile functions: probability in, value out. No std
// distributions: they differ between libraries.
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

/// Parameters by kind:
///     uniform, log_uniform   from, to
///     normal                 mean, standard deviation
///     lognormal              median, coefficient of variation (standard deviation over mean)
///     triangular             from, mode, to
struct Distribution {
    DistributionKind kind = DistributionKind::uniform;
    std::array<double, 3> numbers{};
    /// Truncation to this interval: the conditional distribution, without extra probability at the
    /// ends.
    std::optional<std::array<double, 2>> between{};
};

/// Probability of a value below x, without `between`.
double share_below(const Distribution& distribution, double x);
/// Probability of a value inside `between`; 1 without it.
double share_between(const Distribution& distribution);
/// The quantile of probability u, 0 < u < 1, with `between`.
double quantile(const Distribution& distribution, double u);

/// Rounds as text shows it, so that stored, used and shown numbers agree.
double in_six_digits(double value);

}  // namespace breach::statistics
