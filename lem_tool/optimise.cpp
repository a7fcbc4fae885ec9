// Starts come from a grid of wedges along boundaries, and from the circles. Each descends in rounds
// of moves with steps that are halved, until none lowers Spencer's F. Limits (turns, rise, depth,
// inclination of the interslice forces) keep a descent away from mechanisms whose resistance
// Spencer's method does not see; they are the same for all starts.
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
constexpr double second_step = 0.03;          // after vertices were moved along the surface
constexpr double last_step = 5e-4;            // of the surface's width
constexpr double least_gain_of_round = 1e-3;  // relative, per round; below it the steps get smaller
constexpr double least_gain_of_return = 1e-4;  // relative, of a descent with moved vertices
constexpr int most_returns = 3;
constexpr double agreement = 1e-3;    // of two descents, relative: no more are tried
constexpr int wedges_per_range = 16;  // a grid of ends
constexpr std::size_t wedges_followed = 4;
/// The mass shears internally at a kink, and this resistance is missing with one inclination of
/// interslice forces: surfaces with sharper kinks have too low a factor of safety. Over a stretch
/// of `bend` the surface may turn by as much again, so that vertices that meet gain nothing.
constexpr double sharpest_kink = M_PI / 6.0;
constexpr double bend = 0.25;            // over the mean piece's width
constexpr double shortest_piece = 0.02;  // over the mean piece's width
/// Largest rise of a base in the sliding direction: a passive wedge without friction has 45
/// degrees.
constexpr double steepest_rise = M_PI / 4.0;
/// Price of each radian beyond a limit, relative to F: any surface can be a start. The last rounds
/// are strict.
constexpr double lenient = 2.0;
constexpr double strict = 1e3;

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

/// Direction of a piece, as a rise in the sliding direction [rad].
double rise_of(const Points& points, std::size_t piece, bool upper_left) {
    const Vec2 d = points[piece + 1] - points[piece];
    return std::atan2(upper_left ? d.y() : -d.y(), d.x());
}

double kink_at(const Points& points, std::size_t i) {
    return rise_of(points, i, true) - rise_of(points, i - 1, true);
}

double mean_piece(double width, int vertices) { return width / (vertices - 1); }

/// A wedge on a straight line: steep from the upper end, one piece of least width down to the line,
/// along it, and up to the lower end. Angles from the line [rad]. Empty if there is none.
Points wedge(const Line& line, const Vec2& upper, const Vec2& lower, double steep, double flat,
             double least) {
    const double sense = upper.x() < lower.x() ? 1.0 : -1.0;
    const double along = std::atan(sense * line.slope);
    const auto towards = [&](double angle) {
        return Vec2(sense * std::cos(angle), std::sin(angle));
    };
    const auto reach = [&](const Vec2& from, const Vec2& way) {
        return (line.at(from.x()) - from.y()) / (way.y() - line.slope * way.x());
    };
    const Vec2 turn = towards(along - sharpest_kink) * (least / std::cos(along - sharpest_kink));
    const Vec2 down = towards(along - steep);
    const double t = reach(upper + turn, down);
    const Vec2 out = towards(along + flat);
    const double back = reach(lower, -out);
    if (!(t > 0.0) || !(back > 0.0)) return {};
    Points points{upper, upper + t * down, upper + t * down + turn, lower - back * out, lower};
    if (sense < 0.0) std::ranges::reverse(points);
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
        if (points[i + 1].x() - points[i].x() < least * (1 - 1e-9)) return {};
    return points;
}

/// What every surface has to keep, as far as the critical circle does.
struct Limits {
    double kink = sharpest_kink;
    double rise = steepest_rise;
    double depth = 1e-9;
    double theta = 0.0;     ///< least inclination of the interslice forces [rad]
    double kinked = -1e-6;  ///< largest kinked_without_friction
};

/// A surface during its descent. Its vertices are moved from the upper end on, in directions that
/// go by the slide's: a mirrored section has the mirrored descent.
class Descent {
  public:
    Descent(const Model& model, const Room& room, const Limits& limits, bool upper_left)
        : model_(model),
          room_(room),
          limits_(limits),
          upper_left_(upper_left),
          slices_(make_slices(model.strata, model.slices)) {}

    double value() const { return value_; }
    std::int64_t analysed() const { return analysed_; }
    Polyline surface() const { return of(points_); }

    /// F, with the price of what exceeds the limits; infinite without a valid answer.
    double value_of(const Points& points) {
        ++analysed_;
        const auto found = analyse(model_, of(points), slices_, &similar_);
        // Not valid, as in the search for circles.
        if (!found || found->spencer.m_alpha < least_m_alpha) return no_answer;
        similar_.answer = found->spencer;
        excess_ = excess_of(points, *found);
        // Round-off must not cost anything.
        if (excess_ < 1e-9) excess_ = 0.0;
        return found->spencer.factor_of_safety * (1.0 + price_ * excess_);
    }

    /// False if the surface has no answer or cannot keep the limits.
    bool settle(Points start) {
        constexpr double far_beyond = 0.05;
        refine(start, static_cast<std::size_t>(room_.vertices));
        price_ = lenient;
        value_ = no_answer;
        similar_ = {};
        if (!take(std::move(start))) return false;
        descend(first_step);
        if (excess() > far_beyond) return false;
        for (int n = 0; n < most_returns; ++n) {
            const double before = value_;
            use_idle_vertices();
            descend(second_step);
            if (!(value_ < before * (1.0 - least_gain_of_return))) break;
        }
        if (excess() == 0.0) return true;
        price_ = strict;
        value_ = value_of(points_);
        descend(second_step);
        return excess() < 1e-6;
    }

  private:
    Polyline of(Points points) const {
        if (model_.strata.crack.reach == Crack::Reach::none)
            return {std::move(points), CrackAt::none};
        return {std::move(points), upper_left_ ? CrackAt::left : CrackAt::right};
    }

    double width() const { return points_.back().x() - points_.front().x(); }

    /// Of the present surface.
    double excess() {
        value_of(points_);
        return excess_;
    }

    /// Sum of what exceeds the limits [rad, or relative].
    double excess_of(const Points& points, const Bent& found) const {
        const std::size_t pieces = points.size() - 1;
        const auto rise = [&](std::size_t piece) { return rise_of(points, piece, upper_left_); };
        double excess =
            std::max(0.0, rise(upper_left_ ? pieces - 1 : 0) - limits_.rise) +
            std::max(0.0, 1.0 - found.depth / limits_.depth) +
            std::max(0.0, limits_.theta - found.spencer.theta) +
            std::max(0.0, kinked_without_friction(found.frictionless, found.frictionless_mass) -
                              limits_.kinked);
        const double stretch =
            bend * mean_piece(points.back().x() - points.front().x(), room_.vertices);
        rises_.resize(pieces);
        for (std::size_t i = 0; i < pieces; ++i) rises_[i] = rise_of(points, i, true);
        for (std::size_t i = 0; i + 1 < pieces; ++i) {
            double worst = 0.0;
            for (std::size_t j = i + 1; j < pieces; ++j) {
                const double allowed =
                    limits_.kink * (1.0 + (points[j].x() - points[i + 1].x()) / stretch);
                worst = std::max(worst, rises_[j] - rises_[i] - allowed);
            }
            excess += worst;
        }
        return excess;
    }

    void descend(double first) {
        for (double step = first * width(); step > last_step * width();) {
            const double before = value_;
            round(step);
            if (!(value_ < before * (1.0 - least_gain_of_round))) step *= 0.5;
        }
    }

    /// Accepts the points if their value is lower.
    bool take(Points points) {
        if (!fit(points)) return false;
        const double value = value_of(points);
        if (!(value < value_)) return false;
        value_ = value;
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
        const double least =
            shortest_piece * mean_piece(points.back().x() - points.front().x(), room_.vertices);
        for (std::size_t i = 0; i + 1 < points.size(); ++i)
            if (!(points[i + 1].x() - points[i].x() > least)) return false;
        make_convex(points);
        return true;
    }

    void round(double step) {
        const double along = upper_left_ ? step : -step;
        const auto repeat = [&](const auto& moved) {
            for (int n = 0; n < 4 && take(moved()); ++n) {
            }
        };
        const std::size_t last = points_.size() - 1;
        for (std::size_t k = 0; k < last; ++k) {
            const std::size_t i = upper_left_ ? k : last - 1 - k;
            for (const double sign : {1.0, -1.0}) {
                const double lift = sign * step;
                const double turn = sign * along;
                repeat([&] { return with_piece(i, lift, 0.0); });
                repeat([&] { return with_piece(i, 0.0, turn); });
                repeat([&] { return with_piece(i, lift, turn); });
                repeat([&] { return with_piece(i, lift, -turn); });
            }
        }
        for (std::size_t k = 0; k <= last; ++k) {
            const std::size_t i = upper_left_ ? k : last - k;
            for (const Vec2& move :
                 {Vec2(along, 0.0), Vec2(0.0, step), Vec2(-along, 0.0), Vec2(0.0, -step)}) {
                repeat(
                    [&] { return upper_left_ ? with_part(0, i, move) : with_part(i, last, move); });
                repeat(
                    [&] { return upper_left_ ? with_part(i, last, move) : with_part(0, i, move); });
            }
        }
        for (std::size_t k = 0; k <= last; ++k) {
            const std::size_t i = upper_left_ ? k : last - k;
            for (int n = 0; n < 8; ++n) {
                const double angle = 0.25 * M_PI * n;
                const Vec2 move(along * std::cos(angle), step * std::sin(angle));
                repeat([&] { return with_vertex(i, move); });
            }
        }
        for (std::size_t k = 1; k < last; ++k)
            rest_on_boundaries(upper_left_ ? k : last - k, 4.0 * step);
    }

    /// A vertex moved, and its neighbours by half as much.
    Points with_vertex(std::size_t i, const Vec2& move) const {
        Points points = points_;
        points[i] += move;
        if (i > 0) points[i - 1] += 0.5 * move;
        if (i + 1 < points.size()) points[i + 1] += 0.5 * move;
        return points;
    }

    /// Vertices moved from one to another, as a wedge whose foot slides along a layer.
    Points with_part(std::size_t from, std::size_t to, const Vec2& move) const {
        Points points = points_;
        for (std::size_t j = from; j <= to; ++j) points[j] += move;
        return points;
    }

    /// A piece lifted, and turned about its middle. Its neighbours keep their lines, and most kinks
    /// their angles: where kinks are at their limit, vertices cannot move alone.
    Points with_piece(std::size_t i, double lift, double turn) const {
        Points points = points_;
        const Vec2 piece = points[i + 1] - points[i];
        const Vec2 normal = Vec2(-piece.y(), piece.x()).normalized();
        const Vec2 a = points[i] + (lift - turn) * normal;
        const Vec2 b = points[i + 1] + (lift + turn) * normal;
        const auto meet = [&](const Vec2& outer, const Vec2& vertex, const Vec2& unbound) {
            const Vec2 d = b - a;
            const Vec2 e = vertex - outer;
            const double cross = d.x() * e.y() - d.y() * e.x();
            // Of one straight line with the neighbour, the vertex moves as it is.
            if (std::abs(cross) < 1e-3 * d.norm() * e.norm()) return unbound;
            return Vec2(a +
                        ((outer.x() - a.x()) * e.y() - (outer.y() - a.y()) * e.x()) / cross * d);
        };
        points[i] = i > 0 ? meet(points[i - 1], points[i], a) : a;
        points[i + 1] = i + 2 < points.size() ? meet(points[i + 2], points[i + 1], b) : b;
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
            for (std::size_t count = 1; count <= 3; ++count) {
                Points points = points_;
                for (std::size_t j = 0; j < count; ++j) {
                    const std::size_t v = upper_left_ ? i + j : i - j;
                    if (v == 0 || v + 1 >= points.size()) return;
                    points[v].y() = line.at(points[v].x());
                }
                take(std::move(points));
            }
        }
    }

    /// Moves vertices from straight parts to both sides of the sharpest kinks. The surface remains,
    /// and so does its value.
    void use_idle_vertices() {
        const std::size_t count = points_.size();
        const double least = 2.0 * shortest_piece * mean_piece(width(), room_.vertices);
        for (std::size_t i = count - 2; i > 0; --i)
            if (kink_at(points_, i) < 0.01 && points_.size() > 3)
                points_.erase(points_.begin() + static_cast<std::ptrdiff_t>(i));
        std::vector<bool> halved(points_.size() - 1, false);
        while (points_.size() < count) {
            std::optional<std::size_t> sharpest;
            double most = 0.0;
            for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
                if (halved[i] || points_[i + 1].x() - points_[i].x() < least) continue;
                const double kink =
                    std::max(i > 0 ? kink_at(points_, i) : 0.0,
                             i + 2 < points_.size() ? kink_at(points_, i + 1) : 0.0);
                if (kink > most) {
                    most = kink;
                    sharpest = i;
                }
            }
            if (!sharpest) break;
            const auto at = static_cast<std::ptrdiff_t>(*sharpest);
            halved[*sharpest] = true;
            halved.insert(halved.begin() + at, true);
            points_.insert(points_.begin() + at + 1,
                           0.5 * (points_[*sharpest] + points_[*sharpest + 1]));
        }
        refine(points_, count);
        value_ = value_of(points_);
    }

    const Model& model_;
    const Room& room_;
    const Limits& limits_;
    bool upper_left_;
    Slices slices_;
    Points points_;
    double value_ = no_answer;
    double price_ = lenient;
    double excess_ = 0.0;                ///< of the last surface with a value
    Similar similar_;                    ///< the last valid answer, and a failure since
    mutable std::vector<double> rises_;  ///< of the pieces, scratch memory
    std::int64_t analysed_ = 0;
};

/// The wedges of the lowest value, at least a sixth of the ranges apart.
std::vector<Points> best_wedges(const Model& model, const Room& room,
                                const std::vector<Line>& lines, bool upper_left, Descent& judge) {
    struct Judged {
        Points points;
        double value;
    };
    std::vector<Judged> all;
    const auto on_ground = [&](const std::array<double, 2>& range, int i, SurfaceEnd end) {
        const double x = range[0] + (range[1] - range[0]) * i / wedges_per_range;
        return Vec2(x, end_level(model.strata, x, end));
    };
    const auto add = [&](const Line& line, const Vec2& upper, const Vec2& lower) {
        const double width = std::abs(upper.x() - lower.x());
        if ((upper.x() < lower.x()) != upper_left || width == 0.0) return;
        const double least = 1.01 * bend * mean_piece(width, room.vertices);
        Judged best{{}, no_answer};
        for (const double steep : {2.0 * sharpest_kink, 1.5 * sharpest_kink}) {
            for (const double flat : {sharpest_kink, 0.5 * sharpest_kink}) {
                Points points = wedge(line, upper, lower, 0.999 * steep, 0.999 * flat, least);
                if (points.empty()) continue;
                const double value = judge.value_of(points);
                if (value < best.value) best = {std::move(points), value};
            }
        }
        if (best.value < no_answer) all.push_back(std::move(best));
    };
    for (const Line& line : lines) {
        for (int i = 0; i <= wedges_per_range; ++i) {
            // From the slope outwards, whichever side it faces.
            const int u = upper_left ? i : wedges_per_range - i;
            for (int j = 0; j <= wedges_per_range; ++j)
                add(line, on_ground(room.upper, u, SurfaceEnd::upper),
                    on_ground(room.lower, upper_left ? j : wedges_per_range - j,
                              SurfaceEnd::lower));
        }
    }
    std::ranges::stable_sort(all, {}, &Judged::value);
    const double apart_left =
        (upper_left ? room.upper[1] - room.upper[0] : room.lower[1] - room.lower[0]) / 6.0;
    const double apart_right =
        (upper_left ? room.lower[1] - room.lower[0] : room.upper[1] - room.upper[0]) / 6.0;
    std::vector<Points> chosen;
    for (Judged& each : all) {
        if (chosen.size() == wedges_followed) break;
        const auto near = [&](const Points& other) {
            return std::abs(other.front().x() - each.points.front().x()) < apart_left &&
                   std::abs(other.back().x() - each.points.back().x()) < apart_right;
        };
        if (std::ranges::none_of(chosen, near)) chosen.push_back(std::move(each.points));
    }
    return chosen;
}

/// Share of the mass's area without friction.
double frictionless_mass(const Model& model, const Slices& slices) {
    double all = 0.0;
    double without = 0.0;
    for (std::size_t i = 0; i < slices.count; ++i) {
        const double x = slices.left[i] + 0.5 * slices.width[i];
        const Strip& strip = model.strata.strips[strip_at(model.strata, x)];
        for (std::size_t k = strip.first; k < strip.last; ++k) {
            const Layer& layer = model.strata.layers[k];
            const double top = layer.top.at(x);
            // Layers are ordered from the ground down: the rest is below the surface.
            if (top <= slices.base[i]) break;
            const double bottom =
                k + 1 < strip.last ? std::max(slices.base[i], model.strata.layers[k + 1].top.at(x))
                                   : slices.base[i];
            const Soil& soil = model.soils[layer.region];
            all += slices.width[i] * (top - bottom);
            if (soil.tan_phi > 0.0) continue;
            const double wet =
                soil.above_water && soil.line
                    ? std::min(top, model.strata.pressures[strip.pressures + *soil.line].top.at(x))
                    : top;
            without += slices.width[i] * std::max(0.0, wet - bottom);
        }
    }
    return without / all;
}

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

double kinked_without_friction(double share_of_base, double share_of_mass) {
    constexpr double most_of_base = 0.5;
    constexpr double thin_layer = 0.1;  // over the mass: the soil above the layer deforms at kinks
    return std::min(share_of_base - most_of_base, share_of_mass - thin_layer);
}

std::optional<Bent> analyse(const Model& model, const Polyline& polyline, Slices& slices,
                            Similar* similar) {
    const scene::Circle pivot = pivot_of(polyline);
    if (cut(model.strata, model.soils, polyline, pivot, model.slices, slices) != Cut::done)
        return std::nullopt;
    const bool to_left = polyline.points.front().y() < polyline.points.back().y();
    const auto found = spencer(slices, pivot, to_left ? Slide::to_left : Slide::to_right, model.k_h,
                               similar ? *similar : Similar{});
    const auto* balanced = std::get_if<Spencer>(&found);
    if (similar) {
        similar->failure.reset();
        if (!balanced) similar->failure = std::get<Unbalanced>(found);
    }
    if (!balanced) return std::nullopt;
    Bent bent{polyline, *balanced, slices.depth, frictionless_share(slices), 0.0};
    // The mass is only asked for where the base is mostly without friction: it costs as much as a cut.
    if (kinked_without_friction(bent.frictionless, 1.0) >= 0.0)
        bent.frictionless_mass = frictionless_mass(model, slices);
    return bent;
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

std::optional<Optimised> optimise(const Model& model, const Room& room,
                                  const std::vector<Start>& starts) {
    std::vector<Points> arcs;
    for (const Start& each : starts)
        arcs.push_back(points_of(each.strata, each.surface, room.vertices));
    const Points& circle = arcs.front();
    const bool upper_left = circle.front().y() > circle.back().y();
    Slices slices = make_slices(model.strata, model.slices);
    const auto as_polyline = analyse(model, {circle, starts.front().surface.crack}, slices);
    // The critical circle itself may exceed a limit; its chords are slightly above its lowest point.
    Limits limits;
    limits.rise =
        std::max(limits.rise, rise_of(circle, upper_left ? circle.size() - 2 : 0, upper_left));
    for (std::size_t i = 1; i + 1 < circle.size(); ++i)
        limits.kink = std::max(limits.kink, kink_at(circle, i));
    limits.depth = std::max(limits.depth, room.minimum_depth);
    if (as_polyline) {
        limits.depth = std::min(limits.depth, std::max(as_polyline->depth, 1e-9));
        limits.theta = std::min(0.0, as_polyline->spencer.theta) - 1e-6;
    }

    Descent descent(model, room, limits, upper_left);
    std::vector<Line> lines = boundaries_of(model.strata);
    lines.push_back({std::ranges::min(circle, {}, [](const Vec2& p) { return p.y(); }).y(), 0.0});
    std::vector<Points> all = best_wedges(model, room, lines, upper_left, descent);
    // The circle second: where no layer is weak, wedges are poor starts.
    all.insert(all.begin() + (all.empty() ? 0 : 1), arcs.begin(), arcs.end());
    const double start = as_polyline ? as_polyline->spencer.factor_of_safety : no_answer;
    std::optional<Optimised> best;
    double second = no_answer;
    const auto follow = [&](const Points& from) {
        if (!descent.settle(from)) return;
        const auto found = analyse(model, descent.surface(), slices);
        if (!found) return;
        const double F = found->spencer.factor_of_safety;
        const double least = best ? best->best.spencer.factor_of_safety : no_answer;
        second = std::min(second, std::max(F, least));
        if (F < least) best = Optimised{*found, start, 0.0, 0};
    };
    for (std::size_t n = 0; n < all.size(); ++n) {
        if (n > 2 && second <= best->best.spencer.factor_of_safety * (1.0 + agreement)) break;
        follow(all[n]);
    }
    if (!best) {
        // In soil without friction no polyline is valid; a flag then says so of this one.
        limits.kinked = no_answer;
        follow(circle);
    }
    if (!best) return std::nullopt;
    best->error = second / best->best.spencer.factor_of_safety - 1.0;
    best->analysed = descent.analysed();
    return best;
}

}  // namespace breach::lem
