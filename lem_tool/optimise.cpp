// Rounds of moves with steps that are halved, until no vertex of any surface lowers Spencer's F.
// The limits (kinks, rise, convexity, inclination of the interslice forces) keep the descent away
// from mechanisms whose resistance Spencer's method does not see.
#include "lem_tool/optimise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "lem_tool/slip_circle.hpp"

namespace breach::lem {

namespace {

using scene::Vec2;
using Points = std::vector<Vec2>;

constexpr double no_answer = std::numeric_limits<double>::infinity();
constexpr double first_step = 0.1;            // of the surface's width
constexpr double last_step = 5e-4;            // of the surface's width
constexpr double least_gain_of_round = 1e-4;  // relative, per round; below it the steps get smaller
constexpr double least_piece = 0.25;          // over the mean piece's width
/// The mass shears internally at a kink, and this resistance is missing with one inclination of
/// interslice forces: surfaces with sharper kinks have too low a factor of safety.
constexpr double sharpest_kink = M_PI / 6.0;
/// Largest rise of a base in the sliding direction: a passive wedge without friction has 45
/// degrees.
constexpr double steepest_rise = M_PI / 4.0;

/// Points of the arc, or the floor if that is higher, at equal angles.
Points points_of(const Strata& strata, const Surface& surface, int count) {
    const Vec2& center = surface.circle.center;
    const double R = surface.circle.radius;
    const double from = std::asin(std::clamp((surface.left - center.x()) / R, -1.0, 1.0));
    const double to = std::asin(std::clamp((surface.right - center.x()) / R, -1.0, 1.0));
    Points points;
    for (int i = 0; i < count; ++i) {
        const double x = i == 0 ? surface.left
                         : i == count - 1
                             ? surface.right
                             : center.x() + R * std::sin(from + (to - from) * i / (count - 1));
        points.emplace_back(x, base_level(strata, surface, x));
    }
    return points;
}

/// Moves vertices above the lower convex hull down to it.
void make_convex(Points& points) {
    Points hull;
    for (const Vec2& p : points) {
        while (hull.size() > 1) {
            const Vec2& a = hull[hull.size() - 2];
            const Vec2& b = hull.back();
            const double turn =
                (b.x() - a.x()) * (p.y() - a.y()) - (b.y() - a.y()) * (p.x() - a.x());
            if (turn > 0.0) break;
            hull.pop_back();
        }
        hull.push_back(p);
    }
    std::size_t n = 0;
    for (Vec2& p : points) {
        while (hull[n + 1].x() < p.x()) ++n;
        const double share = (p.x() - hull[n].x()) / (hull[n + 1].x() - hull[n].x());
        p.y() = hull[n].y() + share * (hull[n + 1].y() - hull[n].y());
    }
}

/// Halves the longest pieces until there are `count` points.
void refine(Points& points, std::size_t count) {
    while (points.size() < count) {
        std::size_t longest = 0;
        for (std::size_t i = 1; i + 1 < points.size(); ++i) {
            if ((points[i + 1] - points[i]).norm() > (points[longest + 1] - points[longest]).norm())
                longest = i;
        }
        points.insert(points.begin() + static_cast<std::ptrdiff_t>(longest) + 1,
                      0.5 * (points[longest] + points[longest + 1]));
    }
}

struct Shape {
    double kink;  ///< sharpest kink [rad]
    double rise;  ///< steepest rise in the sliding direction [rad]
};

Shape shape_of(const Points& points, bool upper_left) {
    Shape shape{0.0, 0.0};
    double before = 0.0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const Vec2 piece = points[i + 1] - points[i];
        const double angle = std::atan2(piece.y(), piece.x());
        shape.rise = std::max(shape.rise, upper_left ? angle : -angle);
        if (i > 0) shape.kink = std::max(shape.kink, angle - before);
        before = angle;
    }
    return shape;
}

/// A surface during its descent.
class Descent {
  public:
    Descent(const Model& model, const Room& room, bool upper_left)
        : model_(model),
          room_(room),
          upper_left_(upper_left),
          slices_(make_slices(model.strata, model.slices)) {}

    double value() const { return value_; }
    double least_depth() const { return least_depth_; }
    std::int64_t analysed() const { return analysed_; }
    const Points& points() const { return points_; }

    /// Relaxes limits that the circle itself exceeds.
    void start(const Points& points) {
        points_ = points;
        const Shape shape = shape_of(points, upper_left_);
        allowed_ = {std::max(sharpest_kink, shape.kink), std::max(steepest_rise, shape.rise)};
        // Chords are slightly above the arc's lowest point.
        const auto found = analyse(model_, surface(), slices_);
        least_depth_ = std::min(room_.minimum_depth, found ? found->depth : 0.0);
        value_ = factor_of(points_);
    }

    /// Interslice forces may lift the mass no more than for the circle.
    void hold_theta(double of_circle) { least_theta_ = std::min(0.0, of_circle) - 1e-6; }

    /// Adds vertices to the same surface; from here on surfaces may be no shallower than
    /// least_depth.
    void refine_to(std::size_t count, double least_depth) {
        refine(points_, count);
        least_depth_ = least_depth;
        value_ = factor_of(points_);
    }

    void settle() {
        double step = first_step * width();
        while (step > last_step * width()) {
            const double before = value_;
            round(step);
            if (value_ > before * (1.0 - least_gain_of_round)) step *= 0.5;
        }
    }

    Polyline surface() const {
        if (model_.strata.crack.reach == Crack::Reach::none) return {points_, CrackAt::none};
        return {points_, upper_left_ ? CrackAt::left : CrackAt::right};
    }

  private:
    double width() const { return points_.back().x() - points_.front().x(); }

    double factor_of(const Points& points) {
        Polyline polyline = surface();
        polyline.points = points;
        ++analysed_;
        const auto found = analyse(model_, polyline, slices_, near_);
        if (!found || found->depth < least_depth_ * (1.0 - 1e-9)) return no_answer;
        // Not valid, as in the search for circles.
        if (found->spencer.m_alpha < least_m_alpha) return no_answer;
        if (found->spencer.theta < least_theta_) return no_answer;
        near_ = found->spencer;
        return found->spencer.factor_of_safety;
    }

    /// Accepts the points if they give a lower factor of safety.
    bool take(Points points) {
        if (!fit(points)) return false;
        const double F = factor_of(points);
        if (!(F < value_)) return false;
        value_ = F;
        points_ = std::move(points);
        return true;
    }

    /// Moves the ends onto the ground, within their ranges; separates vertices and makes the
    /// surface convex.
    bool fit(Points& points) const {
        const auto place = [&](Vec2& p, SurfaceEnd end, const std::array<double, 2>& range) {
            p.x() = std::clamp(p.x(), range[0], range[1]);
            p.y() = end_level(model_.strata, p.x(), end);
        };
        place(upper_left_ ? points.front() : points.back(), SurfaceEnd::upper, room_.upper);
        place(upper_left_ ? points.back() : points.front(), SurfaceEnd::lower, room_.lower);
        const double mean =
            (points.back().x() - points.front().x()) / static_cast<double>(points.size() - 1);
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
            // Vertices that meet would make short steep pieces.
            if (points[i + 1].x() - points[i].x() < least_piece * mean) return false;
        }
        make_convex(points);
        const Shape shape = shape_of(points, upper_left_);
        return shape.kink <= allowed_.kink && shape.rise <= allowed_.rise;
    }

    /// Moves every vertex by a step in every direction: alone, and with its neighbours.
    void round(double step) {
        // Wide moves first: single vertices of a convex line can hardly move alone.
        for (const int reach : {3, 1, 0}) {
            for (std::size_t i = 0; i < points_.size(); ++i) {
                for (int k = 0; k < 8; ++k) {
                    const double angle = 0.25 * M_PI * k;
                    const Vec2 move = step * Vec2(std::cos(angle), std::sin(angle));
                    for (int n = 0; n < 4 && take(moved(i, move, reach)); ++n) {
                    }
                }
            }
        }
        for (std::size_t i = 1; i + 1 < points_.size(); ++i) rest_on_boundaries(i, 4.0 * step);
    }

    Points moved(std::size_t i, const Vec2& move, int reach) const {
        Points points = points_;
        for (std::size_t j = 0; j < points.size(); ++j) {
            const double away = std::abs(static_cast<double>(j) - static_cast<double>(i));
            if (away <= reach) points[j] += (1.0 - away / (reach + 1)) * move;
        }
        return points;
    }

    /// A weak layer is a kink in F that steps miss: moves vertices, and pairs of them, onto the
    /// boundaries nearby.
    void rest_on_boundaries(std::size_t i, double reach) {
        const Strata& strata = model_.strata;
        const Strip& strip = strata.strips[strip_at(strata, points_[i].x())];
        for (std::size_t k = strip.first + 1; k <= strip.last; ++k) {
            const Line line = k < strip.last ? strata.layers[k].top : strip.bottom;
            if (std::abs(line.at(points_[i].x()) - points_[i].y()) > reach) continue;
            for (const std::size_t last : {i, i + 1, i + 2}) {
                if (last + 1 >= points_.size()) break;
                Points points = points_;
                for (std::size_t j = i; j <= last; ++j) points[j].y() = line.at(points[j].x());
                take(std::move(points));
            }
        }
    }

    const Model& model_;
    const Room& room_;
    bool upper_left_;
    Slices slices_;
    Points points_;
    std::optional<Spencer> near_;  ///< answer of the last valid surface
    double value_ = no_answer;
    double least_theta_ = -no_answer;
    double least_depth_ = 0.0;
    Shape allowed_{sharpest_kink, steepest_rise};
    std::int64_t analysed_ = 0;
};

double frictionless_share(const Slices& slices) {
    double all = 0.0;
    double without = 0.0;
    for (std::size_t i = 0; i < slices.count; ++i) {
        all += slices.length[i];
        if (slices.tan_phi[i] == 0.0) without += slices.length[i];
    }
    return without / all;
}

}  // namespace

std::optional<Bent> analyse(const Model& model, const Polyline& polyline, Slices& slices,
                            const std::optional<Spencer>& near) {
    const scene::Circle pivot = pivot_of(polyline);
    if (cut(model.strata, model.soils, polyline, pivot, model.slices, slices) != Cut::done)
        return std::nullopt;
    const bool to_left = polyline.points.front().y() < polyline.points.back().y();
    const auto found =
        spencer(slices, pivot, to_left ? Slide::to_left : Slide::to_right, model.k_h, near);
    const auto* balanced = std::get_if<Spencer>(&found);
    if (balanced == nullptr) return std::nullopt;
    return Bent{polyline, *balanced, slices.depth, frictionless_share(slices)};
}

Room room_of(const scene::Lem& lem, const Strata& strata) {
    const std::array<double, 2> everywhere{strata.left(), strata.right()};
    const auto inside = [&](const std::array<double, 2>& range) {
        return std::array<double, 2>{std::max(range[0], everywhere[0]),
                                     std::min(range[1], everywhere[1])};
    };
    const int vertices = lem.non_circular->vertices;
    if (!lem.search) return {everywhere, everywhere, 0.0, vertices};
    return {inside(lem.search->entry), inside(lem.search->exit), lem.search->minimum_depth,
            vertices};
}

std::optional<Optimised> optimise(const Model& model, const Room& room, const Surface& circle) {
    const bool upper_left = base_level(model.strata, circle, circle.left) >
                            base_level(model.strata, circle, circle.right);
    Descent descent(model, room, upper_left);
    descent.start(points_of(model.strata, circle, room.vertices));
    const double start = descent.value();
    if (start == no_answer) return std::nullopt;
    const Points fine = descent.points();
    const double depth = descent.least_depth();
    Slices slices = make_slices(model.strata, model.slices);
    descent.hold_theta(analyse(model, descent.surface(), slices)->spencer.theta);
    // First with half the vertices, which find the shape, then with all.
    descent.start(points_of(model.strata, circle, std::max(4, room.vertices / 2)));
    descent.settle();
    descent.refine_to(static_cast<std::size_t>(room.vertices), depth);
    // Half the vertices may end worse than the circle: then all of them start from it.
    if (!(descent.value() < start)) descent.start(fine);
    descent.settle();
    auto best = analyse(model, descent.surface(), slices);
    if (!best) return std::nullopt;
    return Optimised{*best, start, descent.analysed()};
}

}  // namespace breach::lem
