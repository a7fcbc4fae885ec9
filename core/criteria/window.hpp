// The window of transfer times: from the developed failure (lower edge) to the too distorted
// mesh (upper edge), and the time to choose in it. Sordo et al.: half-way between.
#pragma once

#include <limits>
#include <span>

#include "core/criteria/criterion.hpp"

namespace breach::criteria {

enum class Pick { first, midpoint, last_before };

/// "first", "midpoint", "last_before"; anything else: nothing.
std::optional<Pick> pick_named(std::string_view name);

/// The lower edge is the time at which the lower condition was first true for its hold. The upper edge
/// is the beginning of the first span of the upper condition that is true there or later and lasts for
/// the hold, counted from the span's beginning. If that is not after the lower edge, there is no
/// window. Ignored: spans that ended before the lower edge or did not last for the hold, and a span
/// that had not lasted for it yet when the telemetry ended.
class Window {
  public:
    Window(Expression lower, Expression upper, double hold);

    void take_lower(const Line& line) { lower_.take(line); }
    /// After take_lower of the same line.
    void take_upper(const Line& line);
    /// Both, with a line of telemetry. beside: constants for all lines.
    void take(const telemetry::Line& line, const std::map<std::string, double>& beside = {});
    const Criterion& lower() const { return lower_; }
    const Expression& upper() const { return upper_.expression(); }
    /// The line of the upper edge. Nothing: it is not known yet, or there is no window.
    std::optional<Line> upper_edge() const;
    /// Since when the mesh was too distorted, if it already was when the failure had developed: then
    /// there is no window. Known as soon as the lower edge is: the holds are equally long.
    std::optional<Line> shut_since() const;
    /// Whether the lines so far show that the upper edge comes after t [s], for any later lines. For
    /// times from the lower edge on, once that is known.
    bool is_open_at(double t) const;

  private:
    Criterion lower_, upper_;
    std::optional<Line> began_;  ///< the span that is the upper edge or shuts the window
    double last_time_ = std::numeric_limits<double>::lowest();  ///< of the lines [s]
};

/// The snapshot to choose in [lower, upper]; `times` ascend [s]. first: the first not before the
/// lower edge; last_before: the last before the upper edge; midpoint: the nearest to half-way, the
/// earlier of two. Nothing when no snapshot lies in the window.
std::optional<double> picked(Pick pick, double lower, double upper, std::span<const double> times);

}  // namespace breach::criteria
