#include "lem_tool/simplex.hpp"

#include <algorithm>
#include <vector>

namespace breach::lem {

namespace {

constexpr int most_starts = 8;
constexpr int most_moves = 120;
constexpr double collapsed = 1e-6;  // of the unit box

using Point3 = std::array<double, 3>;
using Objective = std::function<double(const Point3&)>;

Corner corner(const Objective& f, Point3 at) {
    for (double& x : at) x = std::clamp(x, 0.0, 1.0);
    return {at, f(at)};
}

Corner descend_once(const Objective& f, const Corner& start, const Point3& step) {
    std::vector<Corner> corners{start};
    for (int d = 0; d < 3; ++d) {
        if (step[d] == 0.0) continue;
        Point3 next = start.at;
        // Inwards at the border of the box.
        next[d] += next[d] + step[d] > 1.0 || next[d] + step[d] < 0.0 ? -step[d] : step[d];
        corners.push_back(corner(f, next));
    }
    numerics::Simplex<Point3> simplex(std::move(corners));
    for (int n = 0; n < most_moves && simplex.extent() > collapsed; ++n) {
        simplex.move([&](const Point3& at) { return corner(f, at); });
    }
    return simplex.lowest();
}

}  // namespace

Corner descend(const Objective& f, const Corner& start, const Point3& step, double gain) {
    Corner best = start;
    Point3 edge = step;
    for (int n = 0; n < most_starts; ++n) {
        const Corner next = descend_once(f, best, edge);
        const bool settled = n > 0 && next.value >= best.value * (1.0 - gain);
        if (next.value < best.value) best = next;
        if (settled) break;
        // Mirrored and smaller: the next simplex looks to the other side of the same place.
        for (double& d : edge) d *= -0.7;
    }
    return best;
}

}  // namespace breach::lem
