#include "services/report/section/ground_line.hpp"

#include <algorithm>

#include "core/check/section.hpp"

namespace breach::report {

using mechanics::Vec2;
using Line = std::vector<Vec2>;

std::vector<Line> ground_between(const scene::Scene& scene, double from, double to) {
    std::vector<double> xs;
    for (const scene::Region& each : scene.section.regions)
        for (const Vec2& vertex : each.polygon) xs.push_back(std::clamp(vertex.x(), from, to));
    if (xs.empty()) return {};
    xs.push_back(std::clamp(from, std::ranges::min(xs), std::ranges::max(xs)));
    std::ranges::sort(xs);
    const double aside = 1e-7 * std::max(1.0, xs.back() - xs.front());
    std::vector<Line> pieces;
    for (std::size_t i = 0; i + 1 < xs.size(); ++i) {
        if (xs[i + 1] - xs[i] < 4.0 * aside) continue;
        const auto left = check::strata_at(scene, xs[i] + aside);
        const auto right = check::strata_at(scene, xs[i + 1] - aside);
        if (left.empty() || right.empty()) continue;
        const Vec2 a(xs[i], left.front().top), b(xs[i + 1], right.front().top);
        if (pieces.empty() || (pieces.back().back() - a).norm() > 1e3 * aside)
            pieces.push_back({a});
        pieces.back().push_back(b);
    }
    return pieces;
}

}  // namespace breach::report
