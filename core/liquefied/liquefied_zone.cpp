#include "core/liquefied/liquefied_zone.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/exchange/excess_pressure.hpp"
#include "core/geometry/polyline.hpp"
#include "core/liquefied/elements.hpp"
#include "core/words/number.hpp"
#include "core/words/remedy.hpp"

namespace breach::liquefied {
namespace {

using exchange::MeshSnapshot;

constexpr double nowhere = std::numeric_limits<double>::infinity();

/// Half the distance to the farthest corner on both sides of each node, over its elements in
/// regions that can liquefy.
struct Reach {
    double left = 0.0;
    double right = 0.0;
    bool counts = false;
};

std::vector<Reach> reaches(const MeshSnapshot& mesh, const std::vector<char>& regions) {
    std::vector<Reach> reach(mesh.position_0.size());
    for (std::size_t e = 0; e < mesh.quads.size(); ++e) {
        if (!regions[mesh.region_of_element[e]]) continue;
        const Corners x = undeformed_corners(mesh, e);
        const double low = x.row(0).minCoeff();
        const double high = x.row(0).maxCoeff();
        for (const std::int32_t node : mesh.quads[e]) {
            const double here = mesh.position_0[node].x();
            Reach& r = reach[node];
            r.counts = true;
            r.left = std::max(r.left, 0.5 * (here - low));
            r.right = std::max(r.right, 0.5 * (high - here));
        }
    }
    return reach;
}

struct ZoneEdge {
    double x;
    double level;
    bool begins;
};

}  // namespace

LiquefiedZone::LiquefiedZone(const MeshSnapshot& mesh, const std::vector<char>& regions,
                             double threshold, scene::LiquefiedWhen when, double narrowest_wall)
    : highest_(-nowhere), lowest_(nowhere), deepest_(nowhere) {
    std::vector<ZoneEdge> edges;
    const std::vector<Reach> reach = reaches(mesh, regions);
    const std::vector<double> excess = when == scene::LiquefiedWhen::ever
                                           ? exchange::largest_excess_pressure(mesh)
                                           : exchange::nodal_excess_pressure(mesh);
    for (std::size_t i = 0; i < reach.size(); ++i) {
        if (!reach[i].counts) continue;
        highest_ = std::max(highest_, mesh.position_0[i].y());
        lowest_ = std::min(lowest_, mesh.position_0[i].y());
        if (pore_pressure_ratio(excess[i], mesh.sigma_v0[i]) <= threshold) continue;
        const Vec2& place = mesh.position_0[i];
        edges.push_back({place.x() - reach[i].left, place.y(), true});
        edges.push_back({place.x() + reach[i].right, place.y(), false});
        deepest_ = std::min(deepest_, place.y());
        ++nodes_;
    }
    std::ranges::sort(edges, {}, &ZoneEdge::x);
    // A sweep from left to right: between two edges the deepest node among the open columns
    // decides.
    std::multiset<double> open;  // levels of the nodes whose columns contain the present x
    for (std::size_t i = 0; i < edges.size(); ++i) {
        if (edges[i].begins)
            open.insert(edges[i].level);
        else
            // One of equal levels, not all: erase(value) would close the others' columns, too.
            open.erase(open.find(edges[i].level));
        // Only the last edge at an x knows which columns are open to its right.
        if (i + 1 < edges.size() && edges[i + 1].x == edges[i].x) continue;
        level_from_[edges[i].x] = open.empty() ? nowhere : *open.begin();
    }
    close_walls(narrowest_wall);
}

/// Liquefies what lies between each column and those that begin less than `narrowest` after its
/// end.
void LiquefiedZone::close_walls(double narrowest) {
    // Levels before any wall was closed: a closed one must not close its neighbours.
    const std::map<double, double> own = level_from_;
    for (auto left = own.begin(); left != own.end(); ++left) {
        const auto first = std::next(left);
        if (first == own.end()) break;
        for (auto right = std::next(first);
             right != own.end() && right->first - first->first < narrowest; ++right) {
            const double shallower = std::max(left->second, right->second);
            for (auto wall = first; wall != right; ++wall) {
                double& level = level_from_.at(wall->first);
                level = std::min(level, shallower);
            }
        }
    }
    for (auto column = own.begin(); column != own.end(); ++column)
        if (level_from_.at(column->first) < column->second)
            closed_width_ += std::next(column)->first - column->first;
}

std::vector<LiquefiedGap> LiquefiedZone::gaps() const {
    const double large = 0.2 * (highest_ - lowest_), thin = 0.025 * (highest_ - lowest_);
    const auto level = [&](const auto& column) { return std::min(column->second, highest_); };
    std::vector<LiquefiedGap> gaps;
    for (auto before = level_from_.begin(); before != level_from_.end(); ++before) {
        const auto first = std::next(before);
        if (first == level_from_.end()) break;
        const double rises_to = level(first);
        if (rises_to - level(before) < large) continue;
        auto after = std::next(first);
        while (after != level_from_.end() && rises_to - level(after) < large) ++after;
        if (after == level_from_.end()) break;
        const double width = after->first - first->first;
        if (width >= thin && width <= large)
            gaps.push_back(
                {first->first, after->first, rises_to, std::max(level(before), level(after))});
        before = std::prev(after);
    }
    return gaps;
}

bool LiquefiedZone::holds(const Vec2& place) const {
    // First: dry soil does not liquefy, also above a line that was drawn by hand.
    if (!water_table_.empty() && place.y() >= geometry::level_at(water_table_, place.x()))
        return false;
    const bool below_line = line_.empty() || place.x() > line_.back().x() ||
                            place.y() < geometry::level_at(line_, place.x());
    if (!below_line) return true;
    const auto after = level_from_.upper_bound(place.x());
    return after != level_from_.begin() && place.y() >= std::prev(after)->second;
}

std::optional<fault::Flag> flag_of(const std::vector<LiquefiedGap>& gaps, double cell_size) {
    if (gaps.empty()) return std::nullopt;
    const auto width = [](const LiquefiedGap& each) { return each.to - each.from; };
    const auto [narrowest, widest] = std::ranges::minmax_element(gaps, {}, width);
    const bool no_wall = width(*narrowest) < cells_of_a_wall * cell_size;
    const LiquefiedGap& gap = no_wall ? *narrowest : *widest;
    const std::string pointer = "/transfer/liquefied/narrowest_wall";
    const auto text = [](double value) {
        return words::text_of(std::round(100.0 * value) / 100.0);
    };
    return fault::Flag{
        "liquefied_gap", no_wall ? fault::Severity::questionable : fault::Severity::warning,
        "from x = " + text(gap.from) + " to " + text(gap.to) +
            " m the soil has liquefied down to y = " + text(gap.level) +
            " m at most, and on both sides to " + text(gap.beside) + " m at least (" +
            std::to_string(gaps.size()) +
            " such gaps): single nodes near the threshold of r_u decide, and a wall of unliquefied "
            "soil "
            "can hold the runout back; " +
            (no_wall ? words::set(pointer, cells_of_a_wall * cell_size) + ", or " : "") +
            "compare neighbouring transfer times",
        pointer};
}

}  // namespace breach::liquefied
