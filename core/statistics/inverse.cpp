#include "core/statistics/inverse.hpp"

#include <algorithm>
#include <cmath>

#include "core/statistics/distribution.hpp"
#include "core/statistics/repeats.hpp"
#include "core/words/number.hpp"

namespace breach::statistics {

namespace {

std::string in_unit(double value, const std::string& unit = "") {
    return words::text_of(value, 4) + (unit.empty() || unit == "1" ? "" : " " + unit);
}

/// A larger step between the results at the bracket's ends, relative to the target, is remarked as
/// a jump.
constexpr double large_step = 0.25;

/// A step with a result; `at`: value on the bisected scale.
struct Point {
    double at;
    double value;
    double result;
    std::size_t lattices;
    std::size_t moving;
    std::size_t stood;
};

struct Scale {
    bool logarithmic;
    double of(double value) const { return logarithmic ? std::log(value) : value; }
    double back(double at) const { return logarithmic ? std::exp(at) : at; }
};

std::vector<Point> points_of(std::span<const InverseStep> steps, const Scale& scale) {
    std::vector<Point> points;
    for (const InverseStep& each : steps)
        if (!each.results.empty())
            points.push_back({scale.of(each.value), each.value, repeats_of(each.results).mean,
                              each.results.size(), each.moving, each.stood});
    std::ranges::sort(points, {}, &Point::at);
    return points;
}

/// Pooled over all steps with several lattices.
std::optional<Noise> noise_of_steps(std::span<const InverseStep> steps) {
    std::vector<Repeats> repeats;
    for (const InverseStep& each : steps)
        if (!each.results.empty() && each.stood == 0) repeats.push_back(repeats_of(each.results));
    return pooled_noise(repeats);
}

/// Of the mean with fewer lattices; 0: unknown.
double scatter_of_means(const std::optional<Noise>& noise, const Point& a, const Point& b) {
    return noise ? half_width_of_mean(*noise, std::min(a.lattices, b.lattices)) : 0.0;
}

double crossing(const Point& a, const Point& b, double level) {
    if (a.result == b.result) return 0.5 * (a.at + b.at);
    const double share = (level - a.result) / (b.result - a.result);
    return a.at + std::clamp(share, 0.0, 1.0) * (b.at - a.at);
}

/// Where the path from the bracket outwards leaves the band around the target; else the last point.
double edge_of_band(const std::vector<Point>& points, std::size_t from, int direction,
                    double target, double half) {
    const auto n = static_cast<std::ptrdiff_t>(points.size());
    auto here = static_cast<std::ptrdiff_t>(from);
    for (auto next = here + direction;; here = next, next += direction) {
        const Point& inner = points[static_cast<std::size_t>(here)];
        if (next < 0 || next >= n) return inner.at;
        const Point& outer = points[static_cast<std::size_t>(next)];
        const double off = outer.result - target;
        if (std::abs(off) >= half) return crossing(inner, outer, target + std::copysign(half, off));
    }
}

void add_remark(std::string& remark, const std::string& more) {
    remark += (remark.empty() ? "" : "; ") + more;
}

std::string outside(const InverseQuestion& question, const Point& low, const Point& high) {
    const auto result = [&](const Point& point) {
        return (point.moving > 0 ? "at least " : "") + in_unit(point.result, question.unit) +
               " at " + in_unit(point.value);
    };
    return question.quantity + " is " + result(low) + " and " + result(high) + ": " +
           in_unit(question.target, question.unit) + " is not between them";
}

enum class Side { below, at, above };

Side side_of(const Point& point, double target) {
    if (point.result == target) return Side::at;
    return point.result < target ? Side::below : Side::above;
}

std::string at_both_ends(const InverseQuestion& question, const Point& low, const Point& high) {
    return question.quantity + " is " + in_unit(question.target, question.unit) + " at " +
           in_unit(low.value) + " and at " + in_unit(high.value) +
           ": values between them give the same result";
}

/// Why there is no solution; empty: the ends enclose it.
std::string refusal_of(const InverseQuestion& question, const Point& low, const Point& high) {
    const Side side = side_of(low, question.target);
    if (side != side_of(high, question.target)) return "";
    return side == Side::at ? at_both_ends(question, low, high) : outside(question, low, high);
}

/// The neighbours between which the result crosses the target, or reaches or leaves it if several
/// values give the target itself. The ends must be on both sides of it.
std::size_t bracket_in(const std::vector<Point>& points, double target) {
    const Side first = side_of(points.front(), target);
    std::size_t k = 1;
    while (side_of(points[k], target) == first) ++k;
    return k - 1;
}

/// Whether the result equals the target at this point and at the next one in the direction.
bool stays_at_target(const std::vector<Point>& points, std::size_t here, int direction,
                     double target) {
    const auto next = static_cast<std::ptrdiff_t>(here) + direction;
    return next >= 0 && next < static_cast<std::ptrdiff_t>(points.size()) &&
           points[here].result == target && points[static_cast<std::size_t>(next)].result == target;
}

void tell(const InverseQuestion& question, const Scale& scale, const std::vector<Point>& points,
          std::size_t bracket, const std::optional<Noise>& noise, InverseAdvice& advice) {
    const Point& a = points[bracket];
    const Point& b = points[bracket + 1];
    const double value = scale.back(crossing(a, b, question.target));
    advice.found = Interval{value, value, value};
    if (const std::size_t moving = a.moving + b.moving; moving > 0) {
        advice.bound = b.result < a.result ? Bound::at_least : Bound::at_most;
        add_remark(advice.remark,
                   std::to_string(moving) + " of the " + std::to_string(a.lattices + b.lattices) +
                       " results beside it are lower bounds, for their soil still moved: it is " +
                       (advice.bound == Bound::at_least ? "at least" : "at most") + " this value");
    }
    if (a.stood + b.stood > 0)
        add_remark(advice.remark, "at " + in_unit((a.stood > 0 ? a : b).value) +
                                      " nothing was transferred, for no trigger's condition was "
                                      "met: the result is taken as 0 there");
    const double scatter = scatter_of_means(noise, a, b);
    const bool have_target = a.result == question.target || b.result == question.target;
    if (const double step = std::abs(b.result - a.result);
        !have_target && step > scatter && step > large_step * std::abs(question.target))
        add_remark(advice.remark, "from " + in_unit(a.value) + " to " + in_unit(b.value) +
                                      " it goes from " + in_unit(a.result, question.unit) + " to " +
                                      in_unit(b.result, question.unit) +
                                      " at once: no run gave the target itself");
    if (!noise) {
        add_remark(advice.remark,
                   "each value was run on one lattice of points: its scatter is not known, and "
                   "so no interval");
        return;
    }
    const auto edge = [&](std::size_t inside, int direction) {
        // The solution is the end of a range that gives the target itself, not all of it.
        const std::size_t end = direction < 0 ? bracket : bracket + 1;
        if (stays_at_target(points, end, direction, question.target)) return value;
        // The inner end of the band is inside the bracket if the step is outside the band.
        const Point root{scale.of(value), value, question.target, 0, 0, 0};
        std::vector<Point> way = points;
        way.insert(way.begin() + static_cast<std::ptrdiff_t>(bracket) + 1, root);
        return scale.back(edge_of_band(way, inside, direction, question.target, scatter));
    };
    advice.found->low = edge(bracket + 1, -1);
    advice.found->high = edge(bracket + 1, +1);
    advice.has_interval = true;
    const bool at_end = advice.found->low <= question.low || advice.found->high >= question.high;
    if (at_end && scatter > 0.0)
        add_remark(advice.remark,
                   "the interval reaches an end of the range, and may go on beyond it");
}

}  // namespace

InverseAdvice advise_inverse(const InverseQuestion& question, std::span<const InverseStep> steps) {
    InverseAdvice advice;
    for (const double end : {question.low, question.high})
        if (std::ranges::find(steps, end, &InverseStep::value) == steps.end())
            advice.run_next.push_back(end);
    if (!advice.run_next.empty() || std::ranges::any_of(steps, &InverseStep::open)) return advice;
    for (const InverseStep& each : steps)
        if (each.results.empty()) {
            advice.refused = "no run at " + in_unit(each.value) + " gave a result";
            return advice;
        }
    const Scale scale{question.logarithmic};
    const std::vector<Point> points = points_of(steps, scale);
    const std::optional<Noise> noise = noise_of_steps(steps);
    if (noise) advice.noise = noise->deviation;
    advice.refused = refusal_of(question, points.front(), points.back());
    if (!advice.refused.empty()) return advice;
    const std::size_t bracket = bracket_in(points, question.target);
    const Point& a = points[bracket];
    const Point& b = points[bracket + 1];
    const double width = b.at - a.at;
    const double range = question.logarithmic ? 1.0 : question.high - question.low;
    const double told = scatter_of_means(noise, a, b);
    const bool wide = width > question.tolerance * range && std::abs(b.result - a.result) > told;
    if (wide && steps.size() < question.most_values) {
        advice.run_next.push_back(in_six_digits(scale.back(0.5 * (a.at + b.at))));
        return advice;
    }
    tell(question, scale, points, bracket, noise, advice);
    if (wide)
        add_remark(advice.remark,
                   "the runs that \"samples\" allows are used up: the value lies between " +
                       in_unit(a.value) + " and " + in_unit(b.value));
    return advice;
}

}  // namespace breach::statistics
