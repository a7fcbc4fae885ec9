// Evaluates an expression line by line: the values of its fields go in, its value comes out. Unknown
// (a field missing in the line, a window longer than the past so far) is NaN and propagates; a
// condition on something unknown is unknown too, and unknown never counts as true.
#pragma once

#include <span>

#include "core/criteria/expression.hpp"

namespace breach::criteria {

/// The past of one quantity over a sliding window of simulated time.
class Past {
  public:
    explicit Past(double length) : length_(length) {}
    /// Adds x(t) and returns x(t - length), interpolated linearly; NaN while the past is too short.
    /// Times ascend.
    double shifted(double t, double x);

  private:
    struct Sample {
        double t, x;
    };
    double length_;
    std::size_t first_ = 0;  ///< earlier samples are no longer needed
    std::vector<Sample> samples_;
};

class Evaluation {
  public:
    explicit Evaluation(Expression expression);

    const Expression& expression() const { return expression_; }
    /// `values`: one per field of the expression, NaN where the line has none; every line once, in
    /// ascending time (the windows remember). Conditions: 1 true, 0 false, NaN unknown.
    double operator()(double time, std::span<const double> values);

  private:
    Expression expression_;
    std::vector<double> stack_;
    std::vector<Past> pasts_;
};

}  // namespace breach::criteria
