// Intersections of an arc with straight lines, strip by strip, in closed form: between two of them
// the base lies in one layer, and a slice needs no integration.
#include "lem_tool/arc.hpp"

#include <algorithm>
#include <cmath>

#include "lem_tool/slice_maker.hpp"

namespace breach::lem {

double Surface::level(double x) const {
    const double u = x - circle.center.x();
    return circle.center.y() - std::sqrt(std::max(0.0, circle.radius * circle.radius - u * u));
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
        // At or below the centre: the upper half of the circle is no slip surface.
        if (x > from && x < to && h + b * u <= 0.0) meeting.x[meeting.count++] = x;
    }
    return meeting;
}

namespace {

/// Lowest point of the arc between two abscissae.
double lowest(const Surface& surface, double from, double to) {
    return surface.level(std::clamp(surface.circle.center.x(), from, to));
}

/// One pass over the strips, with the surface and the next slice's position.
class ArcCutter {
  public:
    ArcCutter(const Strata& strata, const std::vector<Soil>& soils, const Surface& surface,
              int wanted, Slices& slices)
        : strata_(strata),
          surface_(surface),
          slices_(slices),
          maker_(strata, soils, surface.circle, (surface.right - surface.left) / wanted, slices),
          tolerance_(maker_.tolerance()) {}

    Cut run() {
        // Slices never cross a strip's border: within it each boundary is one straight line.
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
        // The lower arc is convex: if it is below the straight ground at both ends, it is below in
        // between.
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

    /// Greatest vertical distance from a straight ground to the base: at the ground's slope, or at
    /// a corner of the base.
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
        // Above the bottom at both ends, a convex arc is below it in between only if it crosses it
        // twice.
        return meet(surface_.circle, allowed, from, to).count == 2;
    }

    /// Abscissae at which the layer at the arc changes, ascending, `to` last.
    void find_crossings(const Strip& strip, double from, double to) {
        std::vector<double>& crossings = slices_.crossings;
        crossings.clear();
        const double low = lowest(surface_, from, to);
        for (std::size_t k = strip.first + 1; k < strip.last; ++k) {
            const Line& top = strata_.layers[k].top;
            // Layers are ordered from the ground down: all others are deeper.
            if (std::max(top.at(from), top.at(to)) < low) break;
            add_crossings(top, from, to);
        }
        for (std::size_t n = 0; n < strata_.lines; ++n)
            // Pore pressure has a kink where water begins.
            add_crossings(strata_.pressures[strip.pressures + n].top, from, to);
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
        // Crossings with the floor are among the cuts, so that a piece is arc or floor as a whole.
        const Base kind =
            strip.floor.at(middle) > surface_.level(middle) ? Base::straight : Base::arc;
        return maker_.add_piece(strip, from, to, kind, [&](double x) { return base(strip, x); });
    }

    const Strata& strata_;
    const Surface& surface_;
    Slices& slices_;
    SliceMaker maker_;
    double tolerance_;
};

/// Beyond a valid end there is only air: it is on the ground, on a vertical face or in a crack.
Cut check_end(const Strata& strata, const Surface& surface, From beyond) {
    const double x = beyond == From::left ? surface.left : surface.right;
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

MassEnd end_of(const Strata& strata, const Surface& surface, From outside) {
    const double x = outside == From::left ? surface.left : surface.right;
    const CrackAt side = outside == From::left ? CrackAt::left : CrackAt::right;
    return {x, std::max(surface.level(x), strata.strips[strip_at(strata, x)].floor.at(x)),
            surface.crack == side ? MassEnd::Kind::crack : MassEnd::Kind::ground};
}

}  // namespace

Cut cut(const Strata& strata, const std::vector<Soil>& soils, const Surface& surface, int wanted,
        Slices& slices) {
    for (const From side : {From::left, From::right}) {
        const Cut verdict = check_end(strata, surface, side);
        if (verdict != Cut::done) return verdict;
    }
    const Cut verdict = ArcCutter(strata, soils, surface, wanted, slices).run();
    if (verdict != Cut::done) return verdict;
    if (!strata.pushes.empty())
        add_pushes(strata, surface.circle, surface.left, surface.right, slices);
    if (strata.gamma_w > 0.0 || surface.crack != CrackAt::none) {
        for (const From side : {From::left, From::right})
            add_end(strata, surface.circle, end_of(strata, surface, side), side, slices);
    }
    return Cut::done;
}

}  // namespace breach::lem
