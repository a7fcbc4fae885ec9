#include "lem_tool/slices.hpp"

#include <algorithm>
#include <cmath>

namespace breach::lem {

double Surface::level(double x) const {
    const double u = x - circle.center.x();
    return circle.center.y() - std::sqrt(std::max(0.0, circle.radius * circle.radius - u * u));
}

void Slices::reserve(std::size_t slices, std::size_t most_layers) {
    for (auto* array : {&left, &width, &base, &sin_a, &cos_a, &length, &weight, &u, &driving,
                        &shaking, &force, &c, &tan_phi}) {
        array->assign(slices, 0.0);
    }
    crossings.reserve(2 * most_layers + 4);
}

Slices make_slices(const Strata& strata, int wanted) {
    std::size_t most_layers = 0;
    for (const Strip& strip : strata.strips) {
        most_layers = std::max(most_layers, strip.last - strip.first);
    }
    // a strip is cut by each of its boundaries at most twice; every piece may round up by one slice
    Slices slices;
    slices.reserve(static_cast<std::size_t>(wanted) + strata.strips.size() +
                       2 * strata.layers.size() + 2 * strata.strips.size() + 1,
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
        if (surface_.level(from) > ground.at(from) + tolerance_) return Cut::above_ground;
        if (surface_.level(to) > ground.at(to) + tolerance_) return Cut::above_ground;
        if (dips_below(strip.bottom, from, to)) return Cut::leaves_model;
        slices_.depth = std::max(slices_.depth, depth_under(ground, from, to));
        find_crossings(strip, from, to);
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

    /// Greatest vertical distance from a straight ground to the arc: where both have the same
    /// slope.
    double depth_under(const Line& ground, double from, double to) const {
        const scene::Circle& circle = surface_.circle;
        const double u =
            circle.radius * ground.slope / std::sqrt(1.0 + ground.slope * ground.slope);
        const double x = std::clamp(circle.center.x() + u, from, to);
        return ground.at(x) - surface_.level(x);
    }

    bool dips_below(const Line& bottom, double from, double to) const {
        if (surface_.level(from) < bottom.at(from) - tolerance_) return true;
        if (surface_.level(to) < bottom.at(to) - tolerance_) return true;
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
            const Meeting meeting = meet(surface_.circle, top, from, to);
            for (int j = 0; j < meeting.count; ++j) crossings.push_back(meeting.x[j]);
        }
        if (strata_.gamma_w > 0.0) {
            const Meeting meeting = meet(surface_.circle, strip.water, from, to);
            for (int j = 0; j < meeting.count; ++j) crossings.push_back(meeting.x[j]);
        }
        std::sort(crossings.begin(), crossings.end());
        crossings.push_back(to);
    }

    Cut cut_piece(const Strip& strip, double from, double to) {
        const double middle = 0.5 * (from + to);
        const double base = surface_.level(middle);
        std::size_t k = strip.first;
        while (k + 1 < strip.last && strata_.layers[k + 1].top.at(middle) > base) ++k;
        const Layer& layer = strata_.layers[k];
        const Soil& soil = soils_[layer.region];
        if (soil.passage == Soil::Passage::closed) return Cut::closed_region;
        const int parts =
            std::max(1, static_cast<int>(std::ceil((to - from) / target_width_ - 1e-6)));
        const double width = (to - from) / parts;
        double x = from;
        double y = surface_.level(x);
        for (int part = 1; part <= parts; ++part) {
            const double next_x = part == parts ? to : from + part * width;
            const double next_y = surface_.level(next_x);
            add_slice(strip, layer, soil, x, y, next_x, next_y);
            x = next_x;
            y = next_y;
        }
        return Cut::done;
    }

    void add_slice(const Strip& strip, const Layer& layer, const Soil& soil, double x0, double y0,
                   double x1, double y1) {
        const double R = surface_.circle.radius;
        const double dx = x1 - x0;
        const double dy = y1 - y0;
        const double chord = std::sqrt(dx * dx + dy * dy);
        const double bend = chord * chord / (R * R);
        // between chord and arc: (theta - sin theta) R^2 / 2, to the next order in theta
        const double segment = chord * chord * chord / (12.0 * R) * (1.0 + 0.075 * bend);
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
        slices_.weight[i] = soil_weight + strip.surcharge * dx;
        slices_.driving[i] = (moment(dx, w0, w1, d0, d1) +
                              (layer.gamma * segment + strip.surcharge * dx) * 0.5 * (d0 + d1)) /
                             R;
        const double middle = 0.5 * (x0 + x1);
        const double mid_height = 0.5 * (strata_.ground(strip).at(middle) + slices_.base[i]);
        slices_.shaking[i] = soil_weight * (surface_.circle.center.y() - mid_height) / R;
        slices_.u[i] = soil.r_u * soil_weight / dx;
        if (strata_.gamma_w > 0.0) add_water(strip, i, x0, x1, d0, d1);
        slices_.c[i] = soil.c;
        slices_.tan_phi[i] = soil.tan_phi;
        const double flat = slices_.length[i] * slices_.cos_a[i];
        slices_.force[i] = soil.c * flat + (slices_.weight[i] - slices_.u[i] * flat) * soil.tan_phi;
    }

    /// Exact integral of a linear load (w0 to w1) times a linear arm (d0 to d1).
    static double moment(double dx, double w0, double w1, double d0, double d1) {
        return dx * ((w0 + w1) * (d0 + d1) / 4.0 + (w1 - w0) * (d1 - d0) / 12.0);
    }

    /// Pore pressure below the water line; above ground the water's weight, and its thrust on the
    /// slope.
    void add_water(const Strip& strip, std::size_t i, double x0, double x1, double d0, double d1) {
        const double dx = x1 - x0;
        const double below = strip.water.at(0.5 * (x0 + x1)) - slices_.base[i];
        if (below <= 0.0) return;
        slices_.u[i] = strata_.gamma_w * below;
        const Line& ground = strata_.ground(strip);
        const double p0 = strata_.gamma_w * std::max(0.0, strip.water.at(x0) - ground.at(x0));
        const double p1 = strata_.gamma_w * std::max(0.0, strip.water.at(x1) - ground.at(x1));
        if (p0 + p1 <= 0.0) return;
        const double y0 = ground.at(x0) - surface_.circle.center.y();
        const double y1 = ground.at(x1) - surface_.circle.center.y();
        slices_.weight[i] += 0.5 * dx * (p0 + p1);
        slices_.driving[i] +=
            (moment(dx, p0, p1, d0, d1) + ground.slope * moment(dx, p0, p1, y0, y1)) /
            surface_.circle.radius;
    }

    const Strata& strata_;
    const std::vector<Soil>& soils_;
    const Surface& surface_;
    Slices& slices_;
    double target_width_;
    double tolerance_;
};

}  // namespace

namespace {

/// An end is sound when nothing but air lies beyond it: the arc comes out at the ground or at a
/// vertical face.
Cut check_end(const Strata& strata, const Surface& surface, double x, From beyond) {
    const double tolerance = 1e-9 * surface.circle.radius;
    if (x < strata.left() || x > strata.right()) return Cut::leaves_model;
    if (std::abs(x - surface.circle.center.x()) > surface.circle.radius + tolerance) {
        return Cut::overhangs;
    }
    const double outside = ground_level(strata, x, beyond);
    if (surface.level(x) >= outside - tolerance) return Cut::done;
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
    return Cutter(strata, soils, surface, wanted, slices).run();
}

}  // namespace breach::lem
