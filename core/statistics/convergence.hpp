// Error of a ladder of settings: observed order, limit, grid convergence index, noise; which
// settings are worth their cost. Pure functions of numbers, without access to runs.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/statistics/repeats.hpp"

namespace breach::statistics {

/// A setting of a ladder: its size and its result.
struct Rung {
    double size;  ///< > 0, falling along the ladder
    Repeats value;
};

struct Range {
    double low;
    double high;
};

/// No scheme here has a higher order: faster convergence of the rungs is chance, or the coarsest is
/// far too coarse.
constexpr double highest_formal_order = 2.0;

/// Course of the three finest rungs of a ladder; of two, whether they differ.
enum class Course {
    too_few,      ///< fewer than three have a value, and two differ by more than the noise
    monotone,     ///< towards a limit: order, limit and index are given
    oscillating,  ///< up and down: a spread, no order
    not_falling,  ///< the differences do not get smaller with the size: no order
    below_noise,  ///< the last difference is within the noise of the repeats: no order
    no_effect,    ///< all rungs give the same to the last digit
};
std::string_view name_of(Course course);

/// Whether, in this course, the error of the finest rung depends on the ratios of the rungs'
/// sizes.
bool rests_on_sizes(Course course);

struct Convergence {
    Course course = Course::too_few;
    std::optional<double> order;  ///< p of value = limit + C size^p
    /// Range of the order if the two differences of the means are off by a standard error each:
    /// from 0, which has no limit, to 20. Nothing: no rung was repeated
    std::optional<Range> order_by_noise;
    std::optional<double> limit;  ///< Richardson's
    /// Roache's grid convergence index of the finest rung, with his factor of safety 1.25 for
    /// three grids; relative to its value. An order above `highest_formal_order` is replaced by
    /// that one
    std::optional<double> gci;
    /// Error of the finest rung, relative to its value. monotone: the index; oscillating: half of the
    /// range of the three finest (Stern et al. 2001); below_noise: the last difference, and more
    /// where the rungs' sizes are close; otherwise Roache's index for two grids, 3 |difference| /
    /// (ratio - 1), of first order
    std::optional<double> error_of_finest;
    std::optional<double> spread;  ///< largest minus smallest value of the rungs
    std::optional<Noise> noise;    ///< nothing: no rung was repeated
};

/// rungs: from coarse to fine.
Convergence convergence_of(std::span<const Rung> rungs);

/// p of value = limit + C size^p through three values, for any ratios of their sizes (Roache 1998,
/// 5.10.6: for unequal ratios p is the root of an equation). ratio_*: of the coarser size to the
/// finer one, > 1; change_*: finer value minus coarser value. Nothing: the changes differ in sign,
/// or do not fall faster than they would for p = 0, or so fast that the last one says nothing (p >
/// 20).
std::optional<double> observed_order(double ratio_coarse, double ratio_fine, double change_coarse,
                                     double change_fine);

/// The difference of two means of so many repeats that noise alone exceeds in one of twenty pairs: by
/// Student's distribution, as few repeats give the noise.
double smallest_told_difference(const Noise& noise, std::size_t repeats);

/// Relative error of a setting from one ladder, and whether it exceeds the noise.
struct Share {
    double error;
    bool told;
};
/// The errors of several ladders together. Those above the noise add up; those within the noise
/// have either sign, so they add as squares.
double sum_of(std::span<const Share> shares);

/// Cost of a setting and error of one run with it.
struct Offer {
    double cpu_seconds;
    double error;  ///< relative
};
/// [offers] whether no other offer is as good in both and better in one.
std::vector<bool> pareto_front(std::span<const Offer> offers);
/// The cheapest with an error of at most `asked`; of equally cheap ones the more accurate.
std::optional<std::size_t> cheapest_within(std::span<const Offer> offers, double asked);

/// Root of the mean square of (one run - reference) / |reference|, from a relative bias and the
/// scatter of repeats. reference other than zero.
double error_of_one_run(double bias, const Repeats& value, double reference);

}  // namespace breach::statistics
