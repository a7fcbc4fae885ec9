// Divides regions into parts with one kind of mesh: the region itself, or its middle and graded
// strips.
// Both meshers start from these pieces: blocks map them, gmsh gets them as surfaces.
#include <algorithm>
#include <cmath>

#include "fem_solver/mesh/mesh.hpp"

namespace breach::fem {
namespace {

/// An even number, so that gmsh can make quads of the neighbours by halving.
int divisions_for(double length, double size) {
    return 2 * std::max(1, static_cast<int>(std::lround(0.5 * length / size)));
}

/// Length of n elements that start with `first` and grow by the factor `growth`.
double total_length(double first, double growth, int n) {
    double sum = 0.0, size = first;
    for (int i = 0; i < n; ++i, size *= growth) sum += size;
    return sum;
}

struct Progression {
    int elements;
    double growth;
};

/// Elements from `first` to about `last` that fill `length`.
Progression fill(double length, double first, double last) {
    if (length <= 2.0 * first || last <= first) return {divisions_for(length, first), 1.0};
    const double end = std::min(last, 0.5 * length);
    // Sums of a geometric series: n elements from `first` to `end` fill the length for this ratio.
    const double wanted = (length - first) / (length - end);
    const double many = 1.0 + std::log(end / first) / std::log(wanted);
    const int n = 2 * std::max(1, static_cast<int>(std::lround(0.5 * many)));
    double low = 1.0, high = 2.0 * wanted;
    if (total_length(first, low, n) >= length) return {n, 1.0};
    while (total_length(first, high, n) < length) high *= 2.0;
    for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        (total_length(first, middle, n) < length ? low : high) = middle;
    }
    return {n, 0.5 * (low + high)};
}

geometry::Polygon without_straight_vertices(const geometry::Polygon& polygon) {
    const std::size_t n = polygon.size();
    geometry::Polygon kept;
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2 &before = polygon[(i + n - 1) % n], &after = polygon[(i + 1) % n];
        const double off = geometry::distance_to_segment(polygon[i], before, after);
        if (off > 1e-9 * (after - before).norm()) kept.push_back(polygon[i]);
    }
    return kept;
}

enum class Side { left, right };

fault::BadInput refusal(const scene::Region& region, std::size_t index, const std::string& cause,
                        const std::string& remedy) {
    return fault::BadInput("scene", {{"/section/regions/" + std::to_string(index) + "/mesh/graded",
                                      cause + " of region '" + region.name + "'", remedy}});
}

/// The strip on one side of x as a block, starting at its lower left corner.
Piece strip(const scene::Region& region, std::size_t index, Side side, double x) {
    const Vec2 a{x, side == Side::left ? 0.0 : 1.0}, b{x, side == Side::left ? 1.0 : 0.0};
    geometry::Polygon ring =
        without_straight_vertices(geometry::clipped_left(region.polygon, a, b));
    if (ring.size() != 4) {
        throw refusal(region, index,
                      "the part beyond x = " + std::to_string(x) + " is not a quadrilateral",
                      "move the end of the strip to where ground and base are straight");
    }
    // Two left and two right corners, the lower one first: 0, 2, 3, 1 is counter-clockwise.
    std::ranges::sort(ring, {}, [](const Vec2& p) { return p.x(); });
    if (ring[0].y() > ring[1].y()) std::swap(ring[0], ring[1]);
    if (ring[2].y() > ring[3].y()) std::swap(ring[2], ring[3]);
    Piece piece{region, index, 1.0, 2};
    piece.region.polygon = {ring[0], ring[2], ring[3], ring[1]};
    piece.region.mesh = scene::RegionMesh::block;
    piece.region.corners = {0, 1, 2, 3};
    const double width = (ring[2] - ring[0]).norm();
    const Vec2 inner = side == Side::left ? ring[3] - ring[2] : ring[1] - ring[0];
    const auto [columns, growth] = fill(width, region.element_size, region.grading.largest);
    piece.region.divisions = {columns, divisions_for(inner.norm(), region.element_size)};
    // Elements grow away from the middle; side 0-1 runs from left to right.
    piece.growth = side == Side::left ? 1.0 / growth : growth;
    return piece;
}

/// The part between the strips; a block keeps the order of its corners.
Piece middle(const scene::Region& region, std::size_t index) {
    Piece piece{region, index};
    geometry::Polygon& ring = piece.region.polygon;
    if (const auto x = region.grading.left_of) {
        ring = geometry::clipped_left(ring, {*x, 1.0}, {*x, 0.0});
    }
    if (const auto x = region.grading.right_of) {
        ring = geometry::clipped_left(ring, {*x, 0.0}, {*x, 1.0});
    }
    if (ring.size() < 3) {
        throw refusal(region, index, "nothing is left between the strips", "move the strips apart");
    }
    if (region.mesh == scene::RegionMesh::block && region.grading.any()) {
        ring = without_straight_vertices(ring);
        if (ring.size() != 4) {
            throw refusal(region, index, "the block between the strips is not a quadrilateral",
                          "mesh it unstructured, or split the region");
        }
        piece.region.corners = {0, 1, 2, 3};
    }
    return piece;
}

void size_block(Piece& piece) {
    scene::Region& region = piece.region;
    if (region.mesh != scene::RegionMesh::block || region.divisions[0] > 0) return;
    for (std::size_t k = 0; k < 2; ++k) {
        double length = 0.0;
        for (std::size_t i = region.corners[k]; i != region.corners[k + 1];) {
            const std::size_t next = (i + 1) % region.polygon.size();
            length += (region.polygon[next] - region.polygon[i]).norm();
            i = next;
        }
        region.divisions[k] = divisions_for(length, region.element_size);
    }
    piece.unit = 2;
}

}  // namespace

std::vector<Piece> pieces_of(const scene::Section& section) {
    std::vector<Piece> pieces;
    for (std::size_t i = 0; i < section.regions.size(); ++i) {
        const scene::Region& region = section.regions[i];
        if (const auto x = region.grading.left_of) {
            pieces.push_back(strip(region, i, Side::left, *x));
        }
        pieces.push_back(middle(region, i));
        size_block(pieces.back());
        if (const auto x = region.grading.right_of) {
            pieces.push_back(strip(region, i, Side::right, *x));
        }
    }
    return pieces;
}

}  // namespace breach::fem
