#include "services/report/chart/axis.hpp"

#include <charconv>
#include <cmath>
#include <cstdio>

namespace breach::report {

std::vector<double> linear_ticks(const Range& range, double wanted) {
    const double rough = (range.high - range.low) / wanted;
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    const double share = rough / power;
    const double step = power * (share < 1.5 ? 1.0 : share < 3.5 ? 2.0 : share < 7.5 ? 5.0 : 10.0);
    std::vector<double> ticks;
    const double slack = 1e-9;  // of a step: keeps the last tick despite round-off
    const double first = std::ceil(range.low / step - slack);
    const double more = std::floor(range.high / step + slack) - first;
    if (!(more < 1e3)) return ticks;  // no ticks in a range within round-off
    for (int k = 0; k <= more; ++k) ticks.push_back((first + k) * step + 0.0);
    return ticks;
}

std::vector<double> log_ticks(const Range& range) {
    std::vector<double> ticks;
    const int last = static_cast<int>(std::floor(std::log10(range.high)));
    for (int k = static_cast<int>(std::floor(std::log10(range.low))); k <= last; ++k) {
        for (const double fold : {1.0, 2.0, 5.0}) {
            const double tick = fold * std::pow(10.0, k);
            if (tick >= range.low * (1 - 1e-9) && tick <= range.high * (1 + 1e-9)) {
                ticks.push_back(tick);
            }
        }
    }
    return ticks;
}

double place(double value, const Range& range, Scale scale) {
    if (scale == Scale::logarithmic) {
        return std::log(value / range.low) / std::log(range.high / range.low);
    }
    return (value - range.low) / (range.high - range.low);
}

std::string exact(double value) {
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::string short_number(double value) { return rounded(value, 6); }

std::string rounded(double value, int digits) {
    char text[32];
    std::snprintf(text, sizeof text, "%.*g", digits, value);
    return text;
}

}  // namespace breach::report
