#include "lem_tool/polyline.hpp"

#include <algorithm>
#include <cmath>

#include "lem_tool/slice_maker.hpp"

namespace breach::lem {

namespace {

using scene::Vec2;

Line through(const Vec2& a, const Vec2& b) {
    const double slope = (b.y() - a.y()) / (b.x() - a.x());
    return {a.y() - slope * a.x(), slope};
}

/// One pass over the strips and the polyline's pieces.
class PolylineCutter {
  public:
    PolylineCutter(const Strata& strata, const std::vector<Soil>& soils, const Polyline& polyline,
                   const scene::Circle& pivot, int wanted, Slices& slices)
        : strata_(strata),
          points_(polyline.points),
          slices_(slices),
          maker_(strata, soils, pivot, (points_.back().x() - points_.front().x()) / wanted,
                 slices) {}

    Cut run() {
        std::size_t i = strip_at(strata_, points_.front().x());
        std::size_t n = 0;
        while (i < strata_.strips.size() && n + 1 < points_.size()) {
            const Strip& strip = strata_.strips[i];
            const double from = std::max(strip.from, points_[n].x());
            const double to = std::min(strip.to, points_[n + 1].x());
            if (to > from) {
                const Cut verdict =
                    cut_straight(strip, through(points_[n], points_[n + 1]), from, to);
                if (verdict != Cut::done) return verdict;
            }
            // The border that comes first ends the part.
            strip.to < points_[n + 1].x() ? ++i : ++n;
        }
        return Cut::done;
    }

  private:
    /// A part of one straight piece within one strip.
    Cut cut_straight(const Strip& strip, const Line& base, double from, double to) {
        for (const double x : {from, to}) {
            const Cut verdict = check(strip, x, base.at(x));
            if (verdict != Cut::done) return verdict;
        }
        find_crossings(strip, base, from, to);
        double start = from;
        for (const double end : slices_.crossings) {
            if (end - start <= maker_.tolerance() && end != to) continue;
            const Cut verdict = maker_.add_piece(strip, start, end, Base::straight,
                                                 [&](double x) { return base.at(x); });
            if (verdict != Cut::done) return verdict;
            start = end;
        }
        return Cut::done;
    }

    Cut check(const Strip& strip, double x, double y) {
        const double depth = strata_.ground(strip).at(x) - y;
        if (depth < -maker_.tolerance()) return Cut::above_ground;
        if (y < std::max(strip.bottom.at(x), strip.floor.at(x)) - maker_.tolerance())
            return Cut::leaves_model;
        slices_.depth = std::max(slices_.depth, depth);
        return Cut::done;
    }

    /// Abscissae at which the layer at the base changes or its water begins, ascending, `to` last.
    void find_crossings(const Strip& strip, const Line& base, double from, double to) {
        std::vector<double>& crossings = slices_.crossings;
        crossings.clear();
        const auto add = [&](const Line& line) {
            // Parallel lines give an infinity or NaN, which the comparison leaves out.
            const double x = (line.level - base.level) / (base.slope - line.slope);
            if (x > from && x < to) crossings.push_back(x);
        };
        for (std::size_t k = strip.first + 1; k < strip.last; ++k) add(strata_.layers[k].top);
        for (std::size_t n = 0; n < strata_.lines; ++n)
            add(strata_.pressures[strip.pressures + n].top);
        std::sort(crossings.begin(), crossings.end());
        crossings.push_back(to);
    }

    const Strata& strata_;
    const std::vector<Vec2>& points_;
    Slices& slices_;
    SliceMaker maker_;
};

/// Every boundary and every strip border may cut each piece once.
void make_room(const Strata& strata, std::size_t points, int wanted, Slices& slices) {
    const std::size_t most = static_cast<std::size_t>(wanted) +
                             (points + strata.strips.size()) * (1 + slices.crossings.capacity());
    if (slices.capacity() < most) slices.reserve(most, slices.crossings.capacity());
}

/// Beyond an end there is only air, unless it is in a crack.
Cut check_end(const Strata& strata, const Polyline& polyline, From beyond) {
    const Vec2& end = beyond == From::left ? polyline.points.front() : polyline.points.back();
    if (end.x() < strata.left() || end.x() > strata.right()) return Cut::leaves_model;
    const CrackAt side = beyond == From::left ? CrackAt::left : CrackAt::right;
    if (polyline.crack == side) return Cut::done;
    const double tolerance = 1e-9 * (strata.right() - strata.left());
    return end.y() >= ground_level(strata, end.x(), beyond) - tolerance ? Cut::done
                                                                        : Cut::leaves_model;
}

MassEnd end_of(const Polyline& polyline, From outside) {
    const Vec2& end = outside == From::left ? polyline.points.front() : polyline.points.back();
    const CrackAt side = outside == From::left ? CrackAt::left : CrackAt::right;
    return {end.x(), end.y(),
            polyline.crack == side ? MassEnd::Kind::crack : MassEnd::Kind::ground};
}

}  // namespace

double end_level(const Strata& strata, double x, SurfaceEnd end) {
    const double left = ground_level(strata, x, From::left);
    const double right = ground_level(strata, x, From::right);
    if (end == SurfaceEnd::lower) return std::min(left, right);
    // On a vertical face the mass begins at the top: below it the face would stay behind.
    if (strata.crack.reach == Crack::Reach::none) return std::max(left, right);
    std::size_t i = strip_at(strata, x);
    if (right > left && i + 1 < strata.strips.size()) ++i;
    return strata.crack_foot(strata.strips[i]).at(x);
}

scene::Circle pivot_of(const Polyline& polyline) {
    const Vec2& left = polyline.points.front();
    const Vec2& right = polyline.points.back();
    const double width = right.x() - left.x();
    return {{0.5 * (left.x() + right.x()), std::max(left.y(), right.y()) + width}, width};
}

Cut cut(const Strata& strata, const std::vector<Soil>& soils, const Polyline& polyline,
        const scene::Circle& pivot, int wanted, Slices& slices) {
    for (const From side : {From::left, From::right}) {
        const Cut verdict = check_end(strata, polyline, side);
        if (verdict != Cut::done) return verdict;
    }
    make_room(strata, polyline.points.size(), wanted, slices);
    const Cut verdict = PolylineCutter(strata, soils, polyline, pivot, wanted, slices).run();
    if (verdict != Cut::done) return verdict;
    if (!strata.pushes.empty())
        add_pushes(strata, pivot, polyline.points.front().x(), polyline.points.back().x(), slices);
    if (strata.gamma_w > 0.0 || polyline.crack != CrackAt::none) {
        for (const From side : {From::left, From::right})
            add_end(strata, pivot, end_of(polyline, side), side, slices);
    }
    return Cut::done;
}

}  // namespace breach::lem
