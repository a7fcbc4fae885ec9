// Both edges of the plateau of runout(t_T), with as few MPM runs as possible. Pure: from the known
// runouts it returns the next runs.
//
// The plateau is where the runout is at least `share` of the largest one known. A few seeds spread
// over the range find it; from the largest, each edge is closed in by halving between the last time
// known to be on the plateau and the next one known to be off it. A larger runout found on the way
// raises the level for all. What it assumes: one plateau, wider than the distance of the seeds.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace breach::statistics {

/// A transfer or a runout that broke down or was refused: never on the plateau. (A run that a
/// machine fault ended is unknown: the bisection does not continue without it.)
inline constexpr double no_runout = -std::numeric_limits<double>::infinity();

struct Edge {
    std::optional<double> off;  ///< nearest time known to be off; nothing: the range ends first [s]
    double on;                  ///< outermost time known to be on [s]
};

struct Plateau {
    Edge lower, upper;
    double largest;     ///< runout [m]
    double largest_at;  ///< [s]
};

struct Advice {
    std::vector<std::size_t> run_next;  ///< indices into the times; empty: nothing more to run
    std::optional<Plateau> plateau;     ///< as far as it is known; nothing: no runout above zero
};

/// `times`: where snapshots are, ascending [s]; `runouts`: one per time, empty where not run yet
/// [m]; every requested run has ended.
Advice advise(std::span<const double> times, std::span<const std::optional<double>> runouts,
              double share, int seeds);

}  // namespace breach::statistics
