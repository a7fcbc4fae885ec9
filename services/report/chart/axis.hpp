// Axis scales: positions of values, and ticks.
#pragma once

#include <string>
#include <vector>

namespace breach::report {

enum class Scale { linear, logarithmic };

struct Range {
    double low;
    double high;
};

/// Multiples of 1, 2 or 5 times a power of ten within the range, about `wanted` of them; high >
/// low.
std::vector<double> linear_ticks(const Range& range, double wanted = 6.0);
/// Powers of ten within the range, and their 2 and 5 folds; high > low > 0.
std::vector<double> log_ticks(const Range& range);
/// Position of the value as a share of the axis' length: 0 at low, 1 at high.
double place(double value, const Range& range, Scale scale);
/// Shortest text that reads back as the same number.
std::string exact(double value);
/// Six significant digits, without trailing zeros.
std::string short_number(double value);
/// The same with fewer digits.
std::string rounded(double value, int digits);

}  // namespace breach::report
