// The window of transfer times: from the failure having developed (lower edge) to the mesh being
// too distorted (upper edge), and the time to take in it. Sordo et al.: half-way between.
#pragma once

#include <span>

#include "core/criteria/criterion.hpp"

namespace breach::criteria {

enum class Pick { first, midpoint, last_before };

/// "first", "midpoint", "last_before"; anything else: nothing.
std::optional<Pick> pick_named(std::string_view name);

class Window {
  public:
    Window(Expression lower, Expression upper, double hold);

    void take_lower(const Line& line) { lower_.take(line); }
    /// After take_lower of the same line. The upper edge counts only once the lower one is reached.
    void take_upper(const Line& line);
    /// Both, of a line as telemetry has it. beside: numbers that stand for every line.
    void take(const telemetry::Line& line, const std::map<std::string, double>& beside = {});
    const Criterion& lower() const { return lower_; }
    const Criterion& upper() const { return upper_; }
    /// Since when the mesh was too distorted, where that was before the failure had developed and
    /// lasted until it counted: there is no window. Known once the upper edge is met.
    const std::optional<Line>& shut_since() const { return shut_since_; }

  private:
    Criterion lower_, upper_;
    Criterion span_;  ///< of the upper condition, before the lower edge too; never met itself
    std::optional<Line> shut_since_;
};

/// The snapshot to take in [lower, upper]; `times` ascend [s]. first: the first not before the
/// lower edge; last_before: the last before the upper edge; midpoint: the nearest to half-way, the
/// earlier of two. Nothing when no snapshot lies in the window.
std::optional<double> picked(Pick pick, double lower, double upper, std::span<const double> times);

}  // namespace breach::criteria
