// What a ladder of settings says of its own error: observed order, limit, grid convergence index,
// noise; which settings are worth their cost. Pure functions of numbers; nothing here knows runs.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/statistics/repeats.hpp"

namespace breach::statistics {

/// A setting of a ladder: how coarse it is, and what it gives.
struct Rung {
    double size;  ///< > 0, falling along the ladder
    Repeats value;
};

struct Range {
    double low;
    double high;
};

/// No scheme here has a higher one: rungs that fall faster do so by chance, or because the coarsest is
/// far too coarse.
constexpr double highest_formal_order = 2.0;

/// How the three finest rungs of a ladder run; of two, whether they differ.
enum class Course {
    too_few,      ///< fewer than three have a value, and two differ by more than the noise
    monotone,     ///< towards a limit: order, limit and index are told
    oscillating,  ///< up and down: a spread, no order
    not_falling,  ///< the differences do not get smaller with the size: no order
    below_noise,  ///< the last difference is within the noise of the repeats: no order
    no_effect,    ///< all rungs give the same to the last digit
};
std::string_view name_of(Course course);

/// Whether what the finest rung is off by its course rests on how much finer each rung is than the
/// one before.
bool rests_on_sizes(Course course);

struct Convergence {
    Course course = Course::too_few;
    std::optional<double> order;  ///< p of value = limit + C size^p
    /// What the order could be as well, the two differences of the means being off by a standard
    /// error each: from 0, which is no limit, to 20. Nothing: no rung was repeated
    std::optional<Range> order_by_noise;
    std::optional<double> limit;  ///< Richardson's
    /// Roache's grid convergence index of the finest rung, with his factor of safety 1.25 for three
    /// grids; relative to its value. An order above `highest_formal_order` is not relied on: the
    /// index goes by that one
    std::optional<double> gci;
    /// What the finest rung may be off, relative to its value. monotone: the index; oscillating: half
    /// of the range of the three finest (Stern et al. 2001); below_noise: the last difference, and
    /// more where the rungs are near each other;
    /// otherwise Roache's index for two grids, 3 |difference| / (ratio - 1), of first order
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
/// Student's distribution, as the noise is known from few repeats.
double smallest_told_difference(const Noise& noise, std::size_t repeats);

/// What one ladder says a setting is off, relative, and whether that is told apart from noise.
struct Share {
    double error;
    bool told;
};
/// What several ladders say together. What is told adds up; what noise alone could make has either
/// sign, and such shares add as squares.
double sum_of(std::span<const Share> shares);

/// What a setting costs and how far one run with it is off.
struct Offer {
    double cpu_seconds;
    double error;  ///< relative
};
/// [offers] whether no other offer is as good in both and better in one.
std::vector<bool> pareto_front(std::span<const Offer> offers);
/// The cheapest whose error is at most `asked`; of equally cheap ones the more accurate.
std::optional<std::size_t> cheapest_within(std::span<const Offer> offers, double asked);

/// Root of the mean square of (one run - reference) / |reference|, of a relative bias and the
/// scatter of repeats. reference other than zero.
double error_of_one_run(double bias, const Repeats& value, double reference);

}  // namespace breach::statistics
