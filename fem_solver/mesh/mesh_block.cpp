// Blocks: the mesh of a region between its four corners. No optimisation and no random numbers, so
// the mesh follows from the polygon and the divisions alone.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "fem_solver/mesh/mesh.hpp"

namespace breach::fem {

std::vector<int> share_divisions(const std::vector<double>& lengths, int divisions, int unit) {
    const std::size_t segments = lengths.size();
    if (segments == 0 || divisions < unit * static_cast<int>(segments)) return {};
    std::vector<int> shares(segments, unit);
    // Gives units one by one to the segment with the longest elements: deterministic, and as even
    // as possible.
    for (int given = unit * static_cast<int>(segments); given < divisions; given += unit) {
        std::size_t longest = 0;
        for (std::size_t i = 1; i < segments; ++i) {
            const double gain = lengths[i] / shares[i] - lengths[longest] / shares[longest];
            if (gain > 1e-12 * lengths[i]) longest = i;
        }
        shares[longest] += unit;
    }
    return shares;
}

namespace {

/// Share of a segment in the first k of n elements, each `growth` times as long as the one before.
double share_at(int k, int n, double growth) {
    // The geometric series divides by growth - 1.
    if (growth == 1.0) return static_cast<double>(k) / n;
    return std::expm1(k * std::log(growth)) / std::expm1(n * std::log(growth));
}

}  // namespace

std::vector<Vec2> divide_side(const geometry::Polygon& polygon, std::size_t from, std::size_t to,
                              int divisions, double growth, int unit) {
    std::vector<Vec2> vertices{polygon[from]};
    for (std::size_t i = from; i != to;) {
        i = (i + 1) % polygon.size();
        vertices.push_back(polygon[i]);
    }
    std::vector<double> lengths;
    for (std::size_t i = 0; i + 1 < vertices.size(); ++i) {
        lengths.push_back((vertices[i + 1] - vertices[i]).norm());
    }
    const std::vector<int> shares = share_divisions(lengths, divisions, unit);
    if (shares.empty()) return {};
    std::vector<Vec2> points{vertices.front()};
    for (std::size_t i = 0; i < shares.size(); ++i) {
        for (int k = 1; k < shares[i]; ++k) {
            const double s = share_at(k, shares[i], growth);
            points.push_back((1.0 - s) * vertices[i] + s * vertices[i + 1]);
        }
        points.push_back(vertices[i + 1]);
    }
    return points;
}

namespace {

/// Distance along a chain of points as a share of its length, [0, 1].
std::vector<double> arc_shares(const std::vector<Vec2>& points) {
    std::vector<double> s(points.size(), 0.0);
    for (std::size_t i = 1; i < points.size(); ++i) {
        s[i] = s[i - 1] + (points[i] - points[i - 1]).norm();
    }
    for (double& value : s) value /= s.back();
    return s;
}

struct Sides {
    std::vector<Vec2> bottom, right, top,
        left;  ///< bottom and top along xi, left and right along eta
};

/// Transfinite interpolation (Gordon & Hall 1973) at grid line i, j.
Vec2 blend(const Sides& sides, std::size_t i, std::size_t j, double xi, double eta) {
    const Vec2& P00 = sides.bottom.front();
    const Vec2& P10 = sides.bottom.back();
    const Vec2& P11 = sides.top.back();
    const Vec2& P01 = sides.top.front();
    return (1.0 - eta) * sides.bottom[i] + eta * sides.top[i] + (1.0 - xi) * sides.left[j] +
           xi * sides.right[j] -
           ((1.0 - xi) * (1.0 - eta) * P00 + xi * (1.0 - eta) * P10 + xi * eta * P11 +
            (1.0 - xi) * eta * P01);
}

std::string place(std::size_t index, const std::string& key) {
    return "/section/regions/" + std::to_string(index) + "/" + key;
}

Sides divide_sides(const Piece& piece) {
    const scene::Region& region = piece.region;
    // Sides run counter-clockwise: side 2-3 is divided from the other end.
    const std::array<double, 4> growth{piece.growth, 1.0, 1.0 / piece.growth, 1.0};
    std::array<std::vector<Vec2>, 4> sides;
    for (std::size_t k = 0; k < 4; ++k) {
        sides[k] = divide_side(region.polygon, region.corners[k], region.corners[(k + 1) % 4],
                               region.divisions[k % 2], growth[k], piece.unit);
        if (sides[k].empty()) {
            throw fault::BadInput("scene",
                                  {{place(piece.of, "mesh/divisions"),
                                    "side " + std::to_string(k + 1) + " of region '" + region.name +
                                        "' has more polygon segments than divisions (" +
                                        std::to_string(region.divisions[k % 2]) + ")",
                                    "give at least one division per segment, or other corners"}});
        }
    }
    std::reverse(sides[2].begin(), sides[2].end());
    std::reverse(sides[3].begin(), sides[3].end());
    return {std::move(sides[0]), std::move(sides[1]), std::move(sides[2]), std::move(sides[3])};
}

/// Parameter of a grid line: runs from the share on one side to that on the opposite side, which
/// may be divided differently.
double between(double at_start, double at_end, double other) {
    return (1.0 - other) * at_start + other * at_end;
}

}  // namespace

Mesh map_block(const Piece& piece) {
    const Sides sides = divide_sides(piece);
    const auto s_bottom = arc_shares(sides.bottom), s_top = arc_shares(sides.top);
    const auto s_left = arc_shares(sides.left), s_right = arc_shares(sides.right);
    const std::size_t columns = sides.bottom.size(), rows = sides.left.size();
    Mesh mesh;
    mesh.nodes.reserve(columns * rows);
    for (std::size_t j = 0; j < rows; ++j) {
        for (std::size_t i = 0; i < columns; ++i) {
            const double xi_start = s_bottom[i], xi_end = s_top[i];
            const double eta_start = s_left[j], eta_end = s_right[j];
            // Intersection of the straight grid lines in the parameter square.
            const double d_xi = xi_end - xi_start, d_eta = eta_end - eta_start;
            const double xi = (xi_start + d_xi * eta_start) / (1.0 - d_xi * d_eta);
            const double eta = between(eta_start, eta_end, xi);
            // Border nodes are the sides' own points and not the interpolated ones: a neighbouring
            // region divides the same side into the same points.
            if (j == 0)
                mesh.nodes.push_back(sides.bottom[i]);
            else if (j + 1 == rows)
                mesh.nodes.push_back(sides.top[i]);
            else if (i == 0)
                mesh.nodes.push_back(sides.left[j]);
            else if (i + 1 == columns)
                mesh.nodes.push_back(sides.right[j]);
            else
                mesh.nodes.push_back(blend(sides, i, j, xi, eta));
        }
    }
    for (std::size_t j = 0; j + 1 < rows; ++j) {
        for (std::size_t i = 0; i + 1 < columns; ++i) {
            const auto k = static_cast<std::int32_t>(j * columns + i);
            const auto next = static_cast<std::int32_t>(columns);
            mesh.quads.push_back({k, k + 1, k + 1 + next, k + next});
            mesh.region_of_element.push_back(static_cast<std::int32_t>(piece.of));
        }
    }
    return mesh;
}

}  // namespace breach::fem
