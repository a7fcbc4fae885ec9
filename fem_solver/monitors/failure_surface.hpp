// Bands of large strain that cut the section from ground to ground: failure surfaces, counted.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "fem_solver/mesh/mesh.hpp"

namespace breach::fem {

/// The ground as a chain of border edges from the upper left to the upper right corner of the
/// mesh: the element of each edge and the distance along the ground where it begins [m]. Soil in
/// several parts has a chain each, from left to right and as far apart as their ends.
struct Ground {
    std::vector<std::size_t> element;
    std::vector<double> begin;
    std::vector<double> end;
    /// [elements] what lies across each edge: an element, or one of the two below
    std::vector<std::array<std::int32_t, 4>> beside;
    static constexpr std::int32_t air = -1;   ///< the ground
    static constexpr std::int32_t edge = -2;  ///< the rest of the border
    std::vector<char> absent{};  ///< [elements] not placed yet or removed; empty: all are there
};

/// The border from the highest node of the left side to the highest of the right side. The mesh is
/// one body without holes. Edges beside absent elements are ground, too, unless they surround a
/// hole.
Ground ground_of(const Mesh& mesh, std::vector<char> absent = {});

struct FailureSurfaces {
    std::size_t count = 0;
    std::vector<bool> holds;  ///< [elements] belongs to a band with a surface
    /// [elements] belongs to the largest body that the bands separate from the rest of the section
    std::vector<bool> slides;
};

/// Elements with epsilon_q above `threshold` that share nodes form bands; a band that meets the
/// ground at k separate places has k - 1 surfaces. Places closer than `least_separation` [m] along
/// the ground are one. Surfaces with common places are counted by the bodies between them, of
/// least_separation squared or more: each body that the bands separate from the rest of the border
/// lies above a surface of its own, and so does each valley within a band that ridges of up to
/// three times the threshold enclose. A wide band has no such body inside. epsilon_q: [elements], 0
/// for absent ones.
FailureSurfaces failure_surfaces_of(const Mesh& mesh, const Ground& ground,
                                    std::span<const double> epsilon_q, double threshold,
                                    double least_separation);

}  // namespace breach::fem
