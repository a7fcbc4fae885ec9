#include "core/statistics/quantiles.hpp"

#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <numbers>

namespace breach::statistics {

namespace math = boost::math;

// In double: long double differs between machines.
using InDouble = math::policies::policy<math::policies::promote_double<false>>;

double normal_cdf(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

double normal_quantile(double p) {
    return -std::numbers::sqrt2 * math::erfc_inv(2.0 * p, InDouble());
}

double student_factor(double share, std::size_t freedom) {
    const math::students_t_distribution<double, InDouble> student(static_cast<double>(freedom));
    return math::quantile(math::complement(student, 0.5 * (1.0 - share)));
}

double incomplete_beta(double a, double b, double x) { return math::ibeta(a, b, x, InDouble()); }

}  // namespace breach::statistics
