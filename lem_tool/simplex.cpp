#include "lem_tool/simplex.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace breach::lem {

namespace {

constexpr int most_starts = 8;
constexpr int most_moves = 120;
constexpr double collapsed = 1e-6;  // of the unit box

using Place = std::array<double, 3>;
using Function = std::function<double(const Place&)>;

Corner corner(const Function& f, Place at) {
    for (double& x : at) x = std::clamp(x, 0.0, 1.0);
    return {at, f(at)};
}

/// from + factor (to - from)
Place along(const Place& from, const Place& to, double factor) {
    Place result{};
    for (int d = 0; d < 3; ++d) result[d] = from[d] + factor * (to[d] - from[d]);
    return result;
}

Place centre_of(const std::vector<Corner>& simplex) {
    Place centre{};
    for (std::size_t i = 0; i + 1 < simplex.size(); ++i) {
        for (int d = 0; d < 3; ++d)
            centre[d] += simplex[i].at[d] / static_cast<double>(simplex.size() - 1);
    }
    return centre;
}

double extent_of(const std::vector<Corner>& simplex) {
    double extent = 0.0;
    for (const Corner& each : simplex) {
        for (int d = 0; d < 3; ++d) {
            extent = std::max(extent, std::abs(each.at[d] - simplex.front().at[d]));
        }
    }
    return extent;
}

void move(const Function& f, std::vector<Corner>& simplex) {
    const Place centre = centre_of(simplex);
    Corner& worst = simplex.back();
    const Corner reflected = corner(f, along(worst.at, centre, 2.0));
    if (reflected.value < simplex.front().value) {
        const Corner expanded = corner(f, along(worst.at, centre, 3.0));
        worst = expanded.value < reflected.value ? expanded : reflected;
        return;
    }
    if (reflected.value < simplex[simplex.size() - 2].value) {
        worst = reflected;
        return;
    }
    const double side = reflected.value < worst.value ? 1.5 : 0.5;
    const Corner contracted = corner(f, along(worst.at, centre, side));
    if (contracted.value < std::min(reflected.value, worst.value)) {
        worst = contracted;
        return;
    }
    for (std::size_t i = 1; i < simplex.size(); ++i) {
        simplex[i] = corner(f, along(simplex.front().at, simplex[i].at, 0.5));
    }
}

Corner descend_once(const Function& f, const Corner& start, const Place& step) {
    std::vector<Corner> simplex{start};
    for (int d = 0; d < 3; ++d) {
        if (step[d] == 0.0) continue;
        Place next = start.at;
        // turned inwards where the box ends
        next[d] += next[d] + step[d] > 1.0 || next[d] + step[d] < 0.0 ? -step[d] : step[d];
        simplex.push_back(corner(f, next));
    }
    const auto lower = [](const Corner& a, const Corner& b) { return a.value < b.value; };
    std::stable_sort(simplex.begin(), simplex.end(), lower);
    for (int n = 0; n < most_moves && extent_of(simplex) > collapsed; ++n) {
        move(f, simplex);
        std::stable_sort(simplex.begin(), simplex.end(), lower);
    }
    return simplex.front();
}

}  // namespace

Corner descend(const Function& f, const Corner& start, const Place& step, double gain) {
    Corner best = start;
    Place edge = step;
    for (int n = 0; n < most_starts; ++n) {
        const Corner next = descend_once(f, best, edge);
        const bool settled = n > 0 && next.value >= best.value * (1.0 - gain);
        if (next.value < best.value) best = next;
        if (settled) break;
        for (double& d : edge) d *= -0.7;
    }
    return best;
}

}  // namespace breach::lem
