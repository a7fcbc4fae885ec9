// A condition that must hold for a while: armed -> holding -> met, and back to armed when it is
// broken inside the hold. A pure function of the lines it was given, so that a replay decides the
// same.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/criteria/evaluation.hpp"
#include "core/telemetry/lines.hpp"

namespace breach::criteria {

/// One telemetry line as far as a criterion needs it; values in the order of the expression's
/// fields.
struct Line {
    double time;  ///< simulated [s]
    std::int64_t step;
    std::vector<double> values;
};

/// The line as this expression wants it; NaN where it lacks a field. beside: numbers that stand for
/// every line (critical_depth), before the line's own.
Line line_for(const Expression& expression, const telemetry::Line& line,
              const std::map<std::string, double>& beside = {});

class Criterion {
  public:
    /// hold [s] of simulated time: 0 is met on the first line on which the condition is true.
    Criterion(Expression condition, double hold);

    enum class State { armed, holding, met };

    /// Takes the next line; what is met stays met.
    State take(const Line& line);
    /// The same, but what is met is so only for as long as the condition is true.
    State follow(const Line& line);

    State state() const { return state_; }
    const Expression& expression() const { return evaluation_.expression(); }
    /// The line on which the condition became true for the hold that is going on or was met.
    const std::optional<Line>& crossing() const { return crossing_; }
    /// Simulated time at which it was met [s].
    double met_at() const { return met_at_; }

  private:
    Evaluation evaluation_;
    double hold_;
    State state_ = State::armed;
    std::optional<Line> crossing_;
    double met_at_ = 0.0;
};

}  // namespace breach::criteria
