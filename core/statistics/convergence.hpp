// Error of a setting from a ladder of runs: observed order, limit, grid convergence index, noise;
// and which settings are worth their cost. Pure functions of numbers.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/statistics/repeats.hpp"

namespace breach::statistics {

/// A setting of a ladder: its size and its result.
struct Rung {
    double size;  ///< > 0, descending along the ladder
    Repeats value;
};

struct Range {
    double low;
    double high;
};

/// Upper limit of the order of all schemes here: faster convergence is chance, or the coarsest rung
/// is far too coarse.
constexpr double highest_formal_order = 2.0;

/// Convergence of the three finest rungs, or whether two differ.
enum class Course {
    too_few,      ///< fewer than three values, and two differ by more than the noise
    monotone,     ///< towards a limit: with order, limit and index
    oscillating,  ///< no order; the spread is known
    not_falling,  ///< the differences do not decrease with the size: no order
    below_noise,  ///< the last difference is within the scatter of repeats: no order
    no_effect,    ///< all rungs have identical values
};
std::string_view name_of(Course course);

/// Whether the error of the finest rung depends on the ratios of sizes.
bool rests_on_sizes(Course course);

struct Convergence {
    Course course = Course::too_few;
    std::optional<double> order;  ///< p of value = limit + C size^p
    /// Range of the order if both differences of means are off by one standard error; from 0 (no
    /// limit) to 20. None: no rung has repeats.
    std::optional<Range> order_by_noise;
    std::optional<double> limit;  ///< Richardson extrapolation
    /// Roache's grid convergence index of the finest rung, relative to its value, with the safety
    /// factor 1.25 for three grids. The order is at most `highest_formal_order`.
    std::optional<double> gci;
    /// Error of the finest rung, relative to its value. monotone: the index; oscillating: half the
    /// range of the three finest (Stern et al. 2001); below_noise: the last difference, more for
    /// similar sizes; otherwise Roache's index for two grids with first order, 3 |difference| /
    /// (ratio - 1).
    std::optional<double> error_of_finest;
    std::optional<double> spread;  ///< range of all values
    std::optional<Noise> noise;    ///< none: no rung has repeats
};

/// rungs: from coarse to fine
Convergence convergence_of(std::span<const Rung> rungs);

/// p of value = limit + C size^p through three values, for any size ratios (Roache 1998, 5.10.6:
/// the root of an equation if they differ). ratio_*: coarser over finer size, > 1; change_*: finer
/// minus coarser value. None if the changes differ in sign, do not decrease as they would for p >
/// 0, or give p > 20.
std::optional<double> observed_order(double ratio_coarse, double ratio_fine, double change_coarse,
                                     double change_fine);

/// Smallest significant difference of two means of this many repeats: noise alone exceeds it in 5 %
/// of pairs (Student's distribution, because few repeats give the noise).
double smallest_told_difference(const Noise& noise, std::size_t repeats);

/// Relative error of a setting from one ladder, and whether it exceeds the noise.
struct Share {
    double error;
    bool told;
};
/// Combined error of several ladders: errors above the noise add linearly, others as squares.
double sum_of(std::span<const Share> shares);

/// Cost of a setting and its error for one run.
struct Offer {
    double cpu_seconds;
    double error;  ///< relative
};
/// [offers] whether no other offer is at least as good in both and better in one.
std::vector<bool> pareto_front(std::span<const Offer> offers);
/// The cheapest with an error of at most `asked`; of several, the most accurate.
std::optional<std::size_t> cheapest_within(std::span<const Offer> offers, double asked);

/// Root mean square of (one run - reference) / |reference|, from a relative bias and the scatter of
/// repeats. reference must not be 0.
double error_of_one_run(double bias, const Repeats& value, double reference);

}  // namespace breach::statistics
