// A condition that must stay true for a hold time: armed -> holding -> met; back to armed if it
// becomes false during the hold. A pure function of the lines it is given: a replay gives the same
// decision.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/criteria/evaluation.hpp"
#include "core/telemetry/lines.hpp"

namespace breach::criteria {

/// The part of a telemetry line that a criterion needs; values in the order of the expression's
/// fields.
struct Line {
    double time;  ///< simulated [s]
    std::int64_t step;
    std::vector<double> values;
};

/// The line's values for this expression; NaN for a field that it lacks. beside: constants for all
/// lines (critical_depth), unless the line has a value of that name.
Line line_for(const Expression& expression, const telemetry::Line& line,
              const std::map<std::string, double>& beside = {});

class Criterion {
  public:
    /// hold [s], simulated time. 0: met on the first line on which the condition is true.
    Criterion(Expression condition, double hold);

    enum class State { armed, holding, met };

    /// Updates with the next line; a met criterion stays met.
    State take(const Line& line);
    /// The same, but the criterion is met only as long as the condition is true.
    State follow(const Line& line);

    State state() const { return state_; }
    const Expression& expression() const { return evaluation_.expression(); }
    /// The line on which the condition became true, for the current or the completed hold.
    const std::optional<Line>& crossing() const { return crossing_; }
    double met_at() const { return met_at_; }

  private:
    Evaluation evaluation_;
    double hold_;
    State state_ = State::armed;
    std::optional<Line> crossing_;
    double met_at_ = 0.0;
};

}  // namespace breach::criteria
