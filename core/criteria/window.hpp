// The window of transfer times, from the developed failure (lower edge) to the too distorted mesh
// (upper edge), and the choice of a time in it. Sordo et al. take the midpoint.
#pragma once

#include <limits>
#include <span>

#include "core/criteria/criterion.hpp"

namespace breach::criteria {

enum class Pick { first, midpoint, last_before };

/// "first", "midpoint", "last_before"; none for another word.
std::optional<Pick> pick_named(std::string_view name);

/// Lower edge: when the lower condition first became true, if it stays true for the hold. Upper
/// edge: the beginning of the first interval in which the upper condition stays true for the hold;
/// it must reach the lower edge or begin after it. If the interval begins at or before the lower
/// edge, there is no window. Shorter intervals are ignored, also one that the end of the telemetry
/// cuts short.
class Window {
  public:
    Window(Expression lower, Expression upper, double hold);

    void take_lower(const Line& line) { lower_.take(line); }
    /// Call after take_lower with the same line.
    void take_upper(const Line& line);
    /// Updates both edges with a line of telemetry. beside: constants for all lines.
    void take(const telemetry::Line& line, const std::map<std::string, double>& beside = {});
    const Criterion& lower() const { return lower_; }
    const Expression& upper() const { return upper_.expression(); }
    /// None: not known yet, or there is no window.
    std::optional<Line> upper_edge() const;
    /// When the mesh became too distorted, if that was not after the lower edge: then there is no
    /// window. Known together with the lower edge, because the holds are equal.
    std::optional<Line> shut_since() const;
    /// Whether the upper edge is known to come after t [s], independent of later lines. Once the
    /// lower edge is known, t must not be before it.
    bool is_open_at(double t) const;

  private:
    Criterion lower_, upper_;
    std::optional<Line> began_;  ///< interval that sets the upper edge or excludes a window
    double last_time_ = std::numeric_limits<double>::lowest();  ///< time of the last line [s]
};

/// The snapshot to use in [lower, upper]; `times` ascend [s]. first: the earliest; last_before: the
/// latest before the upper edge; midpoint: the nearest to the middle, the earlier of two. None if
/// no snapshot lies in the window.
std::optional<double> picked(Pick pick, double lower, double upper, std::span<const double> times);

}  // namespace breach::criteria
