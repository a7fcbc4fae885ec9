#include "core/criteria/evaluation.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace breach::criteria {

namespace {

using Code = Instruction::Code;
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

double truth(double x, double y, bool value) {
    return std::isnan(x) || std::isnan(y) ? unknown : value ? 1.0 : 0.0;
}

/// Kleene's logic: false and unknown is false, true or unknown is true.
double both(double x, double y) {
    if (x == 0.0 || y == 0.0) return 0.0;
    return std::isnan(x) || std::isnan(y) ? unknown : 1.0;
}
double either(double x, double y) {
    if (x == 1.0 || y == 1.0) return 1.0;
    return std::isnan(x) || std::isnan(y) ? unknown : 0.0;
}

/// std::min and std::max would ignore a NaN operand.
double extreme(double x, double y, double chosen) {
    return std::isnan(x) || std::isnan(y) ? unknown : chosen;
}

double combined(Code code, double x, double y) {
    switch (code) {
        case Code::add:
            return x + y;
        case Code::subtract:
            return x - y;
        case Code::multiply:
            return x * y;
        case Code::divide:
            return x / y;
        case Code::smaller:
            return extreme(x, y, std::min(x, y));
        case Code::larger:
            return extreme(x, y, std::max(x, y));
        case Code::less:
            return truth(x, y, x < y);
        case Code::less_equal:
            return truth(x, y, x <= y);
        case Code::greater:
            return truth(x, y, x > y);
        case Code::greater_equal:
            return truth(x, y, x >= y);
        case Code::both:
            return both(x, y);
        case Code::either:
            return either(x, y);
        case Code::constant:
        case Code::field:
        case Code::negate:
        case Code::absolute:
        case Code::opposite:
        case Code::rate:
        case Code::growth:
            break;
    }
    assert(false);  // without second operand
    return unknown;
}

}  // namespace

double Past::shifted(double t, double x) {
    samples_.push_back({t, x});
    const double wanted = t - length_;
    const double slack = 1e-9 * length_;  // tolerance for round-off of the window's length
    while (first_ + 1 < samples_.size() && samples_[first_ + 1].t <= wanted + slack) ++first_;
    if (first_ > samples_.size() / 2) {
        samples_.erase(samples_.begin(), samples_.begin() + static_cast<std::ptrdiff_t>(first_));
        first_ = 0;
    }
    const Sample& before = samples_[first_];
    if (before.t > wanted + slack) return unknown;
    if (std::abs(before.t - wanted) <= slack || first_ + 1 == samples_.size()) return before.x;
    const Sample& after = samples_[first_ + 1];
    return before.x + (after.x - before.x) * (wanted - before.t) / (after.t - before.t);
}

Evaluation::Evaluation(Expression expression) : expression_(std::move(expression)) {
    stack_.reserve(expression_.depth);
    for (const Instruction& each : expression_.program) {
        if (each.code == Code::rate || each.code == Code::growth) pasts_.emplace_back(each.value);
    }
}

double Evaluation::operator()(double time, std::span<const double> values) {
    assert(values.size() == expression_.fields.size());
    stack_.clear();
    for (const Instruction& each : expression_.program) {
        switch (each.code) {
            case Code::constant:
                stack_.push_back(each.value);
                break;
            case Code::field:
                stack_.push_back(values[each.index]);
                break;
            case Code::negate:
                stack_.back() = -stack_.back();
                break;
            case Code::absolute:
                stack_.back() = std::abs(stack_.back());
                break;
            case Code::opposite:
                stack_.back() = 1.0 - stack_.back();
                break;
            case Code::rate: {
                const double x = stack_.back();
                stack_.back() = (x - pasts_[each.index].shifted(time, x)) / each.value;
                break;
            }
            case Code::growth: {
                const double x = stack_.back();
                const double x_past = pasts_[each.index].shifted(time, x);
                stack_.back() =
                    x > 0.0 && x_past > 0.0 ? std::log(x / x_past) / each.value : unknown;
                break;
            }
            case Code::add:
            case Code::subtract:
            case Code::multiply:
            case Code::divide:
            case Code::smaller:
            case Code::larger:
            case Code::less:
            case Code::less_equal:
            case Code::greater:
            case Code::greater_equal:
            case Code::both:
            case Code::either: {
                const double y = stack_.back();
                stack_.pop_back();
                stack_.back() = combined(each.code, stack_.back(), y);
            }
        }
    }
    return stack_.back();
}

}  // namespace breach::criteria
