// Edges of the plateau of runout(t_T), with few MPM runs. Pure: from the known runouts it returns
// the next runs.
//
// On the plateau, the runout is at least `share` of the largest known one. Seeds spread over the
// range find it. Each edge is then bisected between the outermost time on the plateau and the next
// time off it. A larger runout raises the level for all. Assumes one plateau, wider than the
// spacing of the seeds.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace breach::statistics {

/// Runout of a transfer or MPM that broke down or was refused: never on the plateau. A run that a
/// machine fault ended has no value; the bisection waits for it.
inline constexpr double no_runout = -std::numeric_limits<double>::infinity();

struct Edge {
    std::optional<double> off;  ///< nearest time off the plateau; none: at the end of the range [s]
    double on;                  ///< outermost time on the plateau [s]
};

struct Plateau {
    Edge lower, upper;
    double largest;     ///< runout [m]
    double largest_at;  ///< [s]
};

struct Advice {
    std::vector<std::size_t> run_next;  ///< indices into the times; empty: done
    std::optional<Plateau> plateau;     ///< none: no runout above zero yet
};

/// `times`: of snapshots, ascending [s]; `runouts`: one per time [m], empty if not run. All
/// requested runs must have ended.
Advice advise(std::span<const double> times, std::span<const std::optional<double>> runouts,
              double share, int seeds);

}  // namespace breach::statistics
