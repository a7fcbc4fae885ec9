// Evaluates an expression line by line. A field that the line lacks, or a window longer than the
// record so far, is NaN and propagates; a condition on NaN is NaN and never counts as true.
#pragma once

#include <span>

#include "core/criteria/expression.hpp"

namespace breach::criteria {

/// Samples of one quantity over a sliding window of simulated time.
class Past {
  public:
    explicit Past(double length) : length_(length) {}
    /// Adds x(t) and returns x(t - length), interpolated linearly; NaN until the record is that
    /// long. Call with ascending t.
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
    /// Call once per line, in ascending time: the windows keep samples. `values`: one per field of
    /// the expression, NaN if the line lacks it. A condition returns 1 true, 0 false, NaN unknown.
    double operator()(double time, std::span<const double> values);

  private:
    Expression expression_;
    std::vector<double> stack_;
    std::vector<Past> pasts_;
};

}  // namespace breach::criteria
