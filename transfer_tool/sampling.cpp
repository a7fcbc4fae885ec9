#include "transfer_tool/sampling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "core/fault/fault.hpp"

namespace breach::transfer {
namespace {

constexpr double most_points = 50e6;
constexpr double area_round_off = 1e-9;  // of a cell's area
constexpr int most_rounds = 40;
// The FEM has stretched elements a little: whole numbers of points need not follow.
constexpr double almost = 0.9;

/// The cells in the mesh's bounding box, with the areas that elements cover.
class CellCover {
  public:
    struct Part {
        std::size_t cell;
        std::size_t element;
    };

    CellCover(const std::vector<Corners>& elements, const CellDemand& demand)
        : h_(demand.cell_size), origin_(demand.origin) {
        Vec2 low = elements.front().rowwise().minCoeff();
        Vec2 high = elements.front().rowwise().maxCoeff();
        for (const Corners& x : elements) {
            low = low.cwiseMin(x.rowwise().minCoeff());
            high = high.cwiseMax(x.rowwise().maxCoeff());
        }
        first_ = cell_of(low);
        const Eigen::Array2i last = cell_of(high);
        columns_ = last.x() - first_.x() + 1;
        rows_ = last.y() - first_.y() + 1;
        share.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0.0);
        for (std::size_t e = 0; e < elements.size(); ++e) cover(elements[e], e);
    }

    std::size_t cell(const Vec2& place) const {
        const Eigen::Array2i at = (cell_of(place) - first_).max(0);
        return static_cast<std::size_t>(std::min(at.x(), columns_ - 1)) *
                   static_cast<std::size_t>(rows_) +
               static_cast<std::size_t>(std::min(at.y(), rows_ - 1));
    }

    std::vector<double> share;  ///< covered share of each cell [-]
    std::vector<Part> parts;    ///< elements in cells

  private:
    Eigen::Array2i cell_of(const Vec2& place) const {
        return ((place - origin_) / h_).array().floor().cast<int>();
    }

    /// Adds the areas of the element within each cell.
    void cover(const Corners& x, std::size_t element) {
        const Eigen::Array2i from = cell_of(x.rowwise().minCoeff());
        const Eigen::Array2i to = cell_of(x.rowwise().maxCoeff());
        for (int i = from.x(); i <= to.x(); ++i)
            for (int j = from.y(); j <= to.y(); ++j) {
                const Vec2 low = origin_ + h_ * Vec2(i, j);
                const double part = area_within(x, low) / (h_ * h_);
                if (part <= area_round_off) continue;
                const auto c =
                    static_cast<std::size_t>(i - first_.x()) * static_cast<std::size_t>(rows_) +
                    static_cast<std::size_t>(j - first_.y());
                share[c] += part;
                parts.push_back({c, element});
            }
    }

    /// Area of a convex quad within the cell, clipped side by side (Sutherland & Hodgman 1974).
    double area_within(const Corners& x, const Vec2& low) const {
        // Enough: a convex quad gains at most one vertex from each of four lines.
        std::array<Vec2, 8> ring;
        std::size_t n = 4;
        for (int k = 0; k < 4; ++k) ring[k] = x.col(k);
        for (int d = 0; d < 2; ++d) {
            n = clip(ring, n, d, low[d], 1.0);
            n = clip(ring, n, d, low[d] + h_, -1.0);
        }
        double twice = 0.0;
        for (std::size_t k = 0; k < n; ++k) {
            const Vec2 a = ring[k] - low;
            const Vec2 b = ring[(k + 1) % n] - low;
            twice += a.x() * b.y() - a.y() * b.x();
        }
        return 0.5 * twice;
    }

    static std::size_t clip(std::array<Vec2, 8>& ring, std::size_t n, int d, double at,
                            double side) {
        std::array<Vec2, 8> kept;
        std::size_t m = 0;
        for (std::size_t k = 0; k < n; ++k) {
            const Vec2& a = ring[k];
            const Vec2& b = ring[(k + 1) % n];
            const double to_a = side * (a[d] - at);
            const double to_b = side * (b[d] - at);
            if (to_a >= 0.0) kept[m++] = a;
            if ((to_a > 0.0 && to_b < 0.0) || (to_a < 0.0 && to_b > 0.0))
                kept[m++] = a + (b - a) * (to_a / (to_a - to_b));
        }
        ring = kept;
        return m;
    }

    double h_;
    Vec2 origin_;
    Eigen::Array2i first_;
    int columns_ = 0;
    int rows_ = 0;
};

/// Longer of the two edges along xi, and along eta [m].
Vec2 lengths(const Corners& x) {
    return {std::max((x.col(1) - x.col(0)).norm(), (x.col(2) - x.col(3)).norm()),
            std::max((x.col(3) - x.col(0)).norm(), (x.col(2) - x.col(1)).norm())};
}

void refuse_too_many(const std::vector<Numbers>& numbers) {
    double points = 0.0;
    for (const Numbers& each : numbers) points += static_cast<double>(each[0]) * each[1];
    if (points <= most_points) return;
    throw fault::BadInput(
        "scene", {{"/transfer/points_per_cell",
                   "would take " + std::to_string(static_cast<long long>(points)) + " points",
                   "ask for fewer points per cell, or give larger cells (/mpm/cell_size)"}});
}

std::vector<std::size_t> counts(const std::vector<Corners>& elements,
                                const std::vector<Numbers>& numbers, const Shift& shift,
                                const CellCover& cover) {
    std::vector<std::size_t> count(cover.share.size(), 0);
    for (std::size_t e = 0; e < elements.size(); ++e) {
        const GaussRule along = geometry::even_rule(numbers[e][0], shift[0]);
        const GaussRule across = geometry::even_rule(numbers[e][1], shift[1]);
        for (const double eta : across.position)
            for (const double xi : along.position)
                ++count[cover.cell(elements[e] * shape_functions({xi, eta}))];
    }
    return count;
}

std::size_t owed(double share, int asked) {
    // Rounded down: a cell at the soil's border may have a share too small for a single point.
    return static_cast<std::size_t>(std::floor((share + 1e-6) * std::max(1.0, 0.5 * asked)));
}

/// Of the four numbers around an even distance: the fewest points that are `wanted`, of these the
/// most even.
Numbers fewest_for(double wanted, const Vec2& length, double distance, int least) {
    const auto around = [&](double edge) {
        const int below = static_cast<int>(edge / distance);
        return std::array{std::max(least, below), std::max(least, below + 1)};
    };
    Numbers best{};
    double points = std::numeric_limits<double>::infinity(), apart = points;
    for (const int along : around(length[0]))
        for (const int across : around(length[1])) {
            const double now = static_cast<double>(along) * across;
            const double distance_now = std::max(length[0] / along, length[1] / across);
            if (now < wanted || std::tie(now, distance_now) >= std::tie(points, apart)) continue;
            best = {along, across};
            points = now;
            apart = distance_now;
        }
    return best;
}

CellSupply supply_of(const CellCover& cover, const std::vector<std::size_t>& count, int asked) {
    CellSupply supply;
    for (std::size_t c = 0; c < count.size(); ++c) {
        if (cover.share[c] <= area_round_off) continue;
        ++supply.occupied;
        if (count[c] < owed(cover.share[c], asked)) ++supply.short_cells;
        if (cover.share[c] < 1.0 - 1e-6) continue;
        if (supply.filled++ == 0 || count[c] < supply.least_in_filled)
            supply.least_in_filled = count[c];
    }
    return supply;
}

}  // namespace

Sampling equal_numbers(std::size_t elements, int per_direction) {
    return {.numbers = std::vector<Numbers>(elements, Numbers{per_direction, per_direction}),
            .rule = geometry::shifted_rule,
            .supply = {}};
}

Sampling sampling_for_cells(const std::vector<Corners>& elements, const CellDemand& demand) {
    const int asked = demand.points_per_cell;
    const double per_area = asked / (demand.cell_size * demand.cell_size);
    Sampling sampling{.numbers = {}, .rule = geometry::even_rule, .supply = {}};
    for (const Corners& x : elements)
        sampling.numbers.push_back(
            fewest_for(almost * per_area * geometry::corner_jacobians(x).sum(), lengths(x),
                       1.0 / std::sqrt(per_area), demand.least_per_direction));
    refuse_too_many(sampling.numbers);

    const CellCover cover(elements, demand);
    std::vector<std::size_t> count = counts(elements, sampling.numbers, demand.shift, cover);
    std::vector<char> refined(elements.size());
    for (int round = 0; round < most_rounds; ++round) {
        std::ranges::fill(refined, char{0});
        bool any = false;
        for (const CellCover::Part& part : cover.parts) {
            if (count[part.cell] >= owed(cover.share[part.cell], asked)) continue;
            // Once per round: an element lies in many cells, and the next count shows whether that
            // was enough.
            if (refined[part.element]) continue;
            refined[part.element] = 1;
            any = true;
            Numbers& numbers = sampling.numbers[part.element];
            const Vec2 length = lengths(elements[part.element]);
            ++numbers[length[0] / numbers[0] >= length[1] / numbers[1] ? 0 : 1];
        }
        if (!any) break;
        refuse_too_many(sampling.numbers);
        count = counts(elements, sampling.numbers, demand.shift, cover);
    }
    // Cells that are short after the last round are reported and logged, not refused.
    sampling.supply = supply_of(cover, count, asked);
    return sampling;
}

}  // namespace breach::transfer
