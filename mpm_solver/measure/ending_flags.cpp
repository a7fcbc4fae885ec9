#include "mpm_solver/measure/ending_flags.hpp"

#include <algorithm>
#include <cmath>

#include "core/scene/resolution.hpp"
#include "core/words/number.hpp"
#include "core/words/remedy.hpp"

namespace breach::mpm {

namespace {

using fault::Flag;
using fault::Severity;

constexpr int points_per_cell_wanted = scene::points_across_cell * scene::points_across_cell;

std::string three_digits(double value) { return words::text_of(value, 3); }

Flag still_moving(const Ending& ending) {
    const char* bound = ending.until_rest ? "/mpm/longest_duration" : "/mpm/duration";
    const bool waves = ending.stood && ending.damping_ratio < usual_damping_ratio;
    const std::string remedy = waves ? "the soil stands, and its stress waves are not damped: " +
                                           words::set("/mpm/damping_ratio", usual_damping_ratio)
                               : ending.until_rest
                                   ? words::set(bound, 2.0 * ending.time)
                                   : words::set(bound, "until_rest") + ", or a longer one";
    return {"still_moving", Severity::questionable,
            "still moving at " + three_digits(ending.time) + " s with " +
                three_digits(100.0 * ending.kinetic_share) + " % of the released energy (" +
                *ending.moving + "): the runout is a lower bound; " + remedy,
            bound};
}

/// Appends a hint: soil without tensile strength disintegrates in its stress waves, with any cell
/// size.
std::string or_tension(const Ending& ending, const std::string& remedy) {
    if (ending.tension_share >= usual_tension_share) return remedy;
    return words::set("/mpm/tension_share", usual_tension_share) +
           " where the soil has cohesion; else " + remedy;
}

/// Names at most half the cells: a deposit that flows farther on finer cells gets thinner.
Flag thin_deposit(const Ending& ending) {
    const double h = ending.cell_size;
    const double enough = words::rounded_down(ending.deposit_depth / deposit_cells_wanted);
    return {"thin_deposit", Severity::warning,
            "what lies beyond the toe is " + three_digits(ending.deposit_depth) +
                " m deep on the mean, " + three_digits(ending.deposit_depth / h) +
                " cells: on fewer than " + three_digits(deposit_cells_wanted) +
                " a runout is likely too short, the unsafe side; compare with " +
                words::set("/mpm/cell_size", std::max(enough, 0.5 * h)) +
                " until two cell sizes agree within 5 %",
            "/mpm/cell_size"};
}

bool has_few_points(const Ending& ending) {
    constexpr double almost = 0.9;  // cut cells and compression change the mean
    return ending.points_per_cell < almost * points_per_cell_wanted;
}

std::string with_more_points(const Ending& ending) {
    return ending.filled ? words::set("/mpm/fill_points", scene::points_across_cell)
                         : words::set("/transfer/points_per_cell", points_per_cell_wanted);
}

Flag overlap(const Ending& ending) {
    const bool trusted = ending.overlap <= largest_overlap;
    std::string remedy;
    if (ending.overlap_rate < scene::usual_overlap_rate)
        remedy = words::set("/mpm/overlap_correction/rate", scene::usual_overlap_rate);
    if (has_few_points(ending)) remedy += (remedy.empty() ? "" : " ") + with_more_points(ending);
    return {
        "overlap", trusted ? Severity::warning : Severity::questionable,
        three_digits(100.0 * ending.overlap) +
            " % of the mobile soil overlaps (from 1 % on a runout is too short, beyond 5 % it is "
            "unreliable): the deposit lacks this volume, mostly at its front; runouts with 1 to 7 "
            "% were 3 to 17 % too short; " +
            (remedy.empty() ? "rate and points are those advised: compare with " +
                                  words::set("/mpm/cell_size", 0.5 * ending.cell_size)
                            : remedy),
        "/mpm/overlap_correction/rate"};
}

Flag overlap_work(const Ending& ending) {
    return {"overlap_work", Severity::warning,
            "the overlap correction put in " + three_digits(100.0 * ending.correction_share) +
                " % of the released energy (5 % can be trusted), and the rest of the scheme took " +
                three_digits(100.0 * (ending.numerical_share + ending.correction_share)) +
                " %: the two cancel in the energy, not in the runout, which may be a tenth too "
                "long and depends on where the points lie; compare with " +
                (has_few_points(ending)
                     ? with_more_points(ending)
                     : words::set("/mpm/overlap_correction/rate", 0.5 * ending.overlap_rate)),
            "/mpm/overlap_correction/rate"};
}

/// For soil that did not fail: it releases almost no energy, and the numerical share of that is
/// irrelevant for a runout.
Flag share_of_settling(const Ending& ending) {
    return {"numerical_share", Severity::warning,
            "the soil stands: it fell by a few centimetres on the mean and its fronts stayed "
            "within a cell; the scheme " +
                std::string(ending.numerical_share > 0.0 ? "took " : "made ") +
                three_digits(100.0 * std::abs(ending.numerical_share)) +
                " % of what so small a movement is measured by",
            "/mpm"};
}

}  // namespace

std::vector<Flag> flags_of_ending(const Ending& ending) {
    std::vector<Flag> flags;
    if (ending.softer && ending.mach > largest_mach)
        flags.push_back({"high_mach", Severity::warning,
                         "the flow reached Mach " + words::text_of(ending.mach, 2) +
                             " in soil that is softer than the scene's (at most " +
                             words::text_of(largest_mach, 2) +
                             " can be trusted): the flow compresses it; " +
                             words::set("/mpm/stiffness_scale", ending.scaled ? "auto" : "1"),
                         "/mpm/stiffness_scale"});
    if (ending.moving) flags.push_back(still_moving(ending));
    // Negated, here and below: a NaN raises the flag.
    const bool much = !(std::abs(ending.numerical_share) <= largest_numerical_share);
    const bool stands = ending.stood && !ending.moving && std::isfinite(ending.numerical_share);
    if (much && stands) {
        flags.push_back(share_of_settling(ending));
    } else if (much) {
        flags.push_back(
            {"numerical_share", Severity::questionable,
             "the scheme " + std::string(ending.numerical_share > 0.0 ? "took " : "made ") +
                 three_digits(100.0 * std::abs(ending.numerical_share)) +
                 " % of the released energy (at most 20 % can be trusted): the runout is the "
                 "scheme's as much as the soil's; " +
                 or_tension(ending,
                            "try smaller cells, more points per cell, a smaller /mpm/cfl, "
                            "and the materials' viscosity"),
             "/mpm"});
    }
    if (!(ending.volume_ratio >= least_volume_ratio && ending.volume_ratio <= most_volume_ratio)) {
        flags.push_back({"volume_ratio", Severity::questionable,
                         "the mobile soil has " + three_digits(ending.volume_ratio) +
                             " of its initial volume (0.8 to 1.3 can be trusted): depth and "
                             "length of the deposit are wrong; " +
                             or_tension(ending, "look for spray in the last frame, try " +
                                                    words::set("/mpm/gap_room", "true") +
                                                    ", "
                                                    "try smaller cells or a smaller /mpm/cfl"),
                         "/mpm"});
    }
    if (!(ending.overlap <= told_overlap)) flags.push_back(overlap(ending));
    if (!(ending.correction_share <= largest_correction_share))
        flags.push_back(overlap_work(ending));
    if (ending.deposit_depth > 0.0 &&
        ending.deposit_depth < deposit_cells_wanted * ending.cell_size)
        flags.push_back(thin_deposit(ending));
    return flags;
}

}  // namespace breach::mpm
