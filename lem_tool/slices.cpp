#include "lem_tool/slices.hpp"

#include <algorithm>
#include <cmath>

namespace breach::lem {

double Surface::level(double x) const {
    const double u = x - circle.center.x();
    return circle.center.y() - std::sqrt(std::max(0.0, circle.radius * circle.radius - u * u));
}

void Slices::reserve(std::size_t slices, std::size_t most_layers) {
    for (auto* array : {&left, &width, &base, &sin_a, &cos_a, &length, &weight, &soil_weight, &push,
                        &u, &driving, &shaking, &lever, &force, &c, &tan_phi}) {
        array->assign(slices, 0.0);
    }
    crossings.reserve(2 * most_layers + 6);
}

Slices make_slices(const Strata& strata, int wanted) {
    std::size_t most_layers = 0;
    for (const Strip& strip : strata.strips) {
        most_layers = std::max(most_layers, strip.last - strip.first);
    }
    // a strip is cut by each of its boundaries at most twice; every piece may round up by one slice
    Slices slices;
    slices.reserve(static_cast<std::size_t>(wanted) + strata.strips.size() +
                       2 * strata.layers.size() + 4 * strata.strips.size() + 1,
                   most_layers);
    return slices;
}

Meeting meet(const scene::Circle& circle, const Line& line, double from, double to) {
    Meeting meeting;
    const double b = line.slope;
    const double h = line.at(circle.center.x()) - circle.center.y();
    const double stretch = 1.0 + b * b;
    const double discriminant = stretch * circle.radius * circle.radius - h * h;
    if (discriminant <= 0.0) return meeting;
    const double root = std::sqrt(discriminant);
    for (const double sign : {-1.0, 1.0}) {
        const double u = (-b * h + sign * root) / stretch;
        const double x = circle.center.x() + u;
        if (x > from && x < to && h + b * u <= 0.0) meeting.x[meeting.count++] = x;
    }
    return meeting;
}

namespace {

/// Lowest point of the arc between two abscissae.
double lowest(const Surface& surface, double from, double to) {
    return surface.level(std::clamp(surface.circle.center.x(), from, to));
}

/// One pass over the strips; knows the surface and where the next slice goes.
class Cutter {
  public:
    Cutter(const Strata& strata, const std::vector<Soil>& soils, const Surface& surface, int wanted,
           Slices& slices)
        : strata_(strata),
          soils_(soils),
          surface_(surface),
          slices_(slices),
          target_width_((surface.right - surface.left) / wanted),
          tolerance_(1e-9 * surface.circle.radius) {
        slices_.count = 0;
        slices_.depth = 0.0;
    }

    Cut run() {
        for (std::size_t i = strip_at(strata_, surface_.left); i < strata_.strips.size(); ++i) {
            const Strip& strip = strata_.strips[i];
            const double from = std::max(strip.from, surface_.left);
            const double to = std::min(strip.to, surface_.right);
            if (to - from > 0.0) {
                const Cut verdict = cut_strip(strip, from, to);
                if (verdict != Cut::done) return verdict;
            }
            if (strip.to >= surface_.right) break;
        }
        return Cut::done;
    }

  private:
    Cut cut_strip(const Strip& strip, double from, double to) {
        const Line& ground = strata_.ground(strip);
        // the lower arc is convex: below the straight ground at both ends, it is below everywhere
        // between
        if (base(strip, from) > ground.at(from) + tolerance_) return Cut::above_ground;
        if (base(strip, to) > ground.at(to) + tolerance_) return Cut::above_ground;
        if (dips_below(strip, from, to)) return Cut::leaves_model;
        find_crossings(strip, from, to);
        note_depth(strip, from, to);
        double start = from;
        for (const double end : slices_.crossings) {
            if (end - start > tolerance_ || end == to) {
                const Cut verdict = cut_piece(strip, start, end);
                if (verdict != Cut::done) return verdict;
                start = end;
            }
        }
        return Cut::done;
    }

    double base(const Strip& strip, double x) const {
        return std::max(surface_.level(x), strip.floor.at(x));
    }

    /// Greatest vertical distance from a straight ground to the base: where the arc has the
    /// ground's slope, or where the base has a corner.
    void note_depth(const Strip& strip, double from, double to) {
        const Line& ground = strata_.ground(strip);
        const scene::Circle& circle = surface_.circle;
        const double u =
            circle.radius * ground.slope / std::sqrt(1.0 + ground.slope * ground.slope);
        const auto note = [&](double x) {
            slices_.depth = std::max(slices_.depth, ground.at(x) - base(strip, x));
        };
        note(std::clamp(circle.center.x() + u, from, to));
        if (!has_floor(strip)) return;
        note(from);
        for (const double x : slices_.crossings) note(x);
    }

    static bool has_floor(const Strip& strip) { return std::isfinite(strip.floor.level); }

    bool dips_below(const Strip& strip, double from, double to) const {
        const Line& bottom = strip.bottom;
        if (base(strip, from) < bottom.at(from) - tolerance_) return true;
        if (base(strip, to) < bottom.at(to) - tolerance_) return true;
        const auto held_at = [&](double x) {
            return strip.floor.at(x) >= bottom.at(x) - tolerance_;
        };
        if (held_at(from) && held_at(to)) return false;
        const Line allowed{bottom.level - tolerance_, bottom.slope};
        return meet(surface_.circle, allowed, from, to).count == 2;
    }

    /// Abscissae where the layer under the arc changes, ascending, `to` last.
    void find_crossings(const Strip& strip, double from, double to) {
        std::vector<double>& crossings = slices_.crossings;
        crossings.clear();
        const double low = lowest(surface_, from, to);
        for (std::size_t k = strip.first + 1; k < strip.last; ++k) {
            const Line& top = strata_.layers[k].top;
            if (std::max(top.at(from), top.at(to)) < low) break;
            add_crossings(top, from, to);
        }
        if (strata_.gamma_w > 0.0) add_crossings(strip.water, from, to);
        if (has_floor(strip)) add_crossings(strip.floor, from, to);
        std::sort(crossings.begin(), crossings.end());
        crossings.push_back(to);
    }

    void add_crossings(const Line& line, double from, double to) {
        const Meeting meeting = meet(surface_.circle, line, from, to);
        for (int j = 0; j < meeting.count; ++j) slices_.crossings.push_back(meeting.x[j]);
    }

    Cut cut_piece(const Strip& strip, double from, double to) {
        const double middle = 0.5 * (from + to);
        const double arc = surface_.level(middle);
        const double floor = strip.floor.at(middle);
        const Base kind = floor > arc ? Base::floor : Base::arc;
        // a floor may coincide with a boundary: the soil on it counts
        const double above = kind == Base::floor ? floor + tolerance_ : arc;
        std::size_t k = strip.first;
        while (k + 1 < strip.last && strata_.layers[k + 1].top.at(middle) > above) ++k;
        const Layer& layer = strata_.layers[k];
        const Soil& soil = soils_[layer.region];
        if (soil.passage == Soil::Passage::closed) return Cut::closed_region;
        const int parts =
            std::max(1, static_cast<int>(std::ceil((to - from) / target_width_ - 1e-6)));
        const double width = (to - from) / parts;
        double x = from;
        double y = base(strip, x);
        for (int part = 1; part <= parts; ++part) {
            const double next_x = part == parts ? to : from + part * width;
            const double next_y = base(strip, next_x);
            add_slice(strip, layer, soil, kind, {x, y, next_x, next_y});
            x = next_x;
            y = next_y;
        }
        return Cut::done;
    }

    enum class Base { arc, floor };

    struct Chord {
        double x0, y0, x1, y1;
    };

    void add_slice(const Strip& strip, const Layer& layer, const Soil& soil, Base kind,
                   const Chord& ends) {
        const auto& [x0, y0, x1, y1] = ends;
        const double R = surface_.circle.radius;
        const double dx = x1 - x0;
        const double dy = y1 - y0;
        const double chord = std::sqrt(dx * dx + dy * dy);
        const double bend = kind == Base::arc ? chord * chord / (R * R) : 0.0;
        // between chord and arc: (theta - sin theta) R^2 / 2, to the next order in theta
        const double segment = bend * chord * R * (1.0 / 12.0) * (1.0 + 0.075 * bend);
        const double w0 = layer.weight_above.at(x0) + layer.gamma * (layer.top.at(x0) - y0);
        const double w1 = layer.weight_above.at(x1) + layer.gamma * (layer.top.at(x1) - y1);
        const double d0 = x0 - surface_.circle.center.x();
        const double d1 = x1 - surface_.circle.center.x();
        const std::size_t i = slices_.count++;
        const double soil_weight = 0.5 * dx * (w0 + w1) + layer.gamma * segment;
        slices_.left[i] = x0;
        slices_.width[i] = dx;
        slices_.base[i] = 0.5 * (y0 + y1);
        slices_.cos_a[i] = dx / chord;
        slices_.sin_a[i] = dy / chord;
        slices_.length[i] = chord * (1.0 + bend / 24.0);
        slices_.soil_weight[i] = soil_weight;
        slices_.weight[i] = soil_weight + strip.surcharge * dx;
        slices_.push[i] = 0.0;
        slices_.driving[i] = (moment(dx, w0, w1, d0, d1) +
                              (layer.gamma * segment + strip.surcharge * dx) * 0.5 * (d0 + d1)) /
                             R;
        const double middle = 0.5 * (x0 + x1);
        const double mid_height = 0.5 * (strata_.ground(strip).at(middle) + slices_.base[i]);
        slices_.shaking[i] = soil_weight * (surface_.circle.center.y() - mid_height) / R;
        slices_.u[i] = soil.r_u * soil_weight / dx;
        double turned_sideways = 0.0;
        if (strata_.gamma_w > 0.0) turned_sideways = add_water(strip, i, ends);
        slices_.lever[i] = 1.0;
        if (kind == Base::floor) {
            const double h = surface_.circle.center.y() - slices_.base[i];
            slices_.lever[i] = h * chord / (R * dx);
            slices_.driving[i] = slices_.weight[i] * h * dy / (dx * R);
        }
        slices_.driving[i] += turned_sideways;
        slices_.c[i] = soil.c;
        if (soil.coefficient > 0.0) slices_.c[i] += undrained(strip, soil, i);
        slices_.tan_phi[i] = soil.tan_phi;
        const double flat = slices_.length[i] * slices_.cos_a[i];
        slices_.force[i] =
            (slices_.c[i] * flat + (slices_.weight[i] - slices_.u[i] * flat) * soil.tan_phi) *
            slices_.lever[i];
    }

    /// The part of s_u that grows with the vertical effective stress under soil and free water.
    double undrained(const Strip& strip, const Soil& soil, std::size_t i) const {
        const double dx = slices_.width[i];
        const double sigma_v0 = slices_.weight[i] / dx - strip.surcharge - slices_.u[i];
        return soil.coefficient * std::pow(std::max(0.0, sigma_v0) / p_a, soil.exponent);
    }

    /// Exact integral of a linear load (w0 to w1) times a linear arm (d0 to d1).
    static double moment(double dx, double w0, double w1, double d0, double d1) {
        return dx * ((w0 + w1) * (d0 + d1) / 4.0 + (w1 - w0) * (d1 - d0) / 12.0);
    }

    /// Pore pressure below the water line; above ground the water's weight, and its thrust on the
    /// slope, whose moment over R is returned.
    double add_water(const Strip& strip, std::size_t i, const Chord& ends) {
        const double x0 = ends.x0;
        const double x1 = ends.x1;
        const double dx = x1 - x0;
        const double below = strip.water.at(0.5 * (x0 + x1)) - slices_.base[i];
        if (below <= 0.0) return 0.0;
        slices_.u[i] = strip.gamma_u * below;
        const Line& ground = strata_.ground(strip);
        const double p0 = strata_.gamma_w * std::max(0.0, strip.water.at(x0) - ground.at(x0));
        const double p1 = strata_.gamma_w * std::max(0.0, strip.water.at(x1) - ground.at(x1));
        if (p0 + p1 <= 0.0) return 0.0;
        const scene::Vec2& center = surface_.circle.center;
        const double R = surface_.circle.radius;
        slices_.weight[i] += 0.5 * dx * (p0 + p1);
        slices_.driving[i] += moment(dx, p0, p1, x0 - center.x(), x1 - center.x()) / R;
        slices_.push[i] = -ground.slope * 0.5 * dx * (p0 + p1);
        return ground.slope *
               moment(dx, p0, p1, ground.at(x0) - center.y(), ground.at(x1) - center.y()) / R;
    }

    const Strata& strata_;
    const std::vector<Soil>& soils_;
    const Surface& surface_;
    Slices& slices_;
    double target_width_;
    double tolerance_;
};

/// Adds a force on a vertical to one slice.
void add_load(const scene::Circle& circle, const PointLoad& load, std::size_t i, Slices& slices) {
    const double R = circle.radius;
    const double arm = slices.lever[i] == 1.0
                           ? (load.x - circle.center.x()) / R
                           : slices.lever[i] * slices.sin_a[i];  // on a floor h tan a / R
    slices.weight[i] += load.down;
    slices.push[i] += load.left;
    slices.driving[i] += load.down * arm + load.left * (circle.center.y() - load.level) / R;
    slices.force[i] += load.down * slices.tan_phi[i] * slices.lever[i];
}

void add_loads(const Strata& strata, const Surface& surface, Slices& slices) {
    for (const PointLoad& load : strata.loads) {
        if (load.x <= surface.left || load.x >= surface.right) continue;
        const auto end = slices.left.begin() + static_cast<std::ptrdiff_t>(slices.count);
        const auto next = std::upper_bound(slices.left.begin(), end, load.x);
        std::size_t i = static_cast<std::size_t>(next - slices.left.begin()) - 1;
        // water presses on the soil behind the face, not on the slice before it
        const bool on_left_one = load.left > 0.0 && load.down == 0.0 && load.x <= slices.left[i];
        if (on_left_one && i > 0) --i;
        add_load(surface.circle, load, i, slices);
    }
}

/// An end as the mass sees it: a vertical from the base up to the ground, high where there is a
/// face or a crack.
struct EndFace {
    double x;
    double foot;
    double head;
    double water;    ///< level of what stands before it [m]
    double gamma_w;  ///< its unit weight [N/m3]
};

EndFace face_of(const Strata& strata, const Surface& surface, double x, From outside) {
    const From inside = outside == From::left ? From::right : From::left;
    std::size_t i = strip_at(strata, x);
    const bool on_border = x >= strata.strips[i].to && i + 1 < strata.strips.size();
    const Strip& within = strata.strips[on_border && inside == From::right ? i + 1 : i];
    const Strip& beyond = strata.strips[on_border && outside == From::right ? i + 1 : i];
    EndFace face{x, std::max(surface.level(x), within.floor.at(x)), strata.ground(within).at(x),
                 beyond.water.at(x), strata.gamma_w};
    const CrackAt side = outside == From::left ? CrackAt::left : CrackAt::right;
    if (surface.crack != side) return face;
    face.gamma_w = strata.crack.gamma_w;
    // a crack under free water is full of it
    const bool drowned = strata.gamma_w > 0.0 && within.water.at(x) > face.head;
    face.water =
        drowned ? within.water.at(x) : face.foot + strata.crack.filled * (face.head - face.foot);
    return face;
}

void add_end(const Strata& strata, const Surface& surface, From outside, Slices& slices) {
    const double x = outside == From::left ? surface.left : surface.right;
    const EndFace face = face_of(strata, surface, x, outside);
    if (face.gamma_w == 0.0 || face.head - face.foot <= 1e-9 * surface.circle.radius) return;
    const Thrust push = thrust(face.gamma_w, face.water, face.foot, face.head);
    add_load(surface.circle, {x, push.level, 0.0, outside == From::left ? -push.force : push.force},
             outside == From::left ? 0 : slices.count - 1, slices);
}

/// An end is sound when nothing but air lies beyond it: the arc comes out at the ground, at a
/// vertical face or in a crack.
Cut check_end(const Strata& strata, const Surface& surface, double x, From beyond) {
    const double tolerance = 1e-9 * surface.circle.radius;
    if (x < strata.left() || x > strata.right()) return Cut::leaves_model;
    if (std::abs(x - surface.circle.center.x()) > surface.circle.radius + tolerance) {
        return Cut::overhangs;
    }
    const CrackAt side = beyond == From::left ? CrackAt::left : CrackAt::right;
    if (surface.crack == side) return Cut::done;
    const double outside = ground_level(strata, x, beyond);
    const Line& floor = strata.strips[strip_at(strata, x)].floor;
    if (std::max(surface.level(x), floor.at(x)) >= outside - tolerance) return Cut::done;
    const bool vertical =
        std::abs(x - surface.circle.center.x()) > surface.circle.radius - tolerance;
    return vertical ? Cut::overhangs : Cut::leaves_model;
}

}  // namespace

Cut cut(const Strata& strata, const std::vector<Soil>& soils, const Surface& surface, int wanted,
        Slices& slices) {
    const Cut left = check_end(strata, surface, surface.left, From::left);
    if (left != Cut::done) return left;
    const Cut right = check_end(strata, surface, surface.right, From::right);
    if (right != Cut::done) return right;
    const Cut verdict = Cutter(strata, soils, surface, wanted, slices).run();
    if (verdict != Cut::done) return verdict;
    if (!strata.loads.empty()) add_loads(strata, surface, slices);
    if (strata.gamma_w > 0.0 || surface.crack != CrackAt::none) {
        add_end(strata, surface, From::left, slices);
        add_end(strata, surface, From::right, slices);
    }
    return Cut::done;
}

}  // namespace breach::lem
