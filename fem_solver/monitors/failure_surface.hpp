// Failure surfaces: bands of large strain that cut the section from ground to ground.
// Watch reads the number of surfaces into each row of telemetry: triggers and the window of
// transfer times wait for it. ground_of is made once per body, the search runs per row.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "fem_solver/mesh/mesh.hpp"

namespace breach::fem {

/// The ground as a chain of border edges from the upper left to the upper right corner of the mesh:
/// element of each edge, and the distance along the ground of its ends [m]. Separate bodies have
/// one chain each, from left to right, with the distance between them.
struct Ground {
    std::vector<std::size_t> element;
    std::vector<double> begin;
    std::vector<double> end;
    /// [elements] neighbour across each edge: an element, `air` or `edge`
    std::vector<std::array<std::int32_t, 4>> beside;
    static constexpr std::int32_t air = -1;   ///< ground
    static constexpr std::int32_t edge = -2;  ///< other border
    std::vector<char> absent{};  ///< [elements] not placed yet or removed; empty: all are present
};

/// The border from the highest node of the left side to that of the right side. The mesh is one
/// body without holes. Edges at absent elements are ground too, unless they surround a hole.
Ground ground_of(const Mesh& mesh, std::vector<char> absent = {});

/// `holds` and `slides` serve slip_across_band (watch.cpp) and the kind of an entanglement.
struct FailureSurfaces {
    std::size_t count = 0;
    std::vector<bool> holds;  ///< [elements] in a band with a surface
    /// [elements] in the largest body that the bands separate
    std::vector<bool> slides;
};

/// Elements with epsilon_q above `threshold` that share nodes form a band; a band that meets the
/// ground at k separate places has k - 1 surfaces. Places closer than `least_separation` [m] along
/// the ground are one. Surfaces that share places are counted by the bodies between them, of at
/// least least_separation squared: each body that the bands separate from the rest of the border
/// has a surface below it, and so has each valley in a band that is enclosed by ridges of up to
/// three times the threshold. epsilon_q: [elements], 0 if absent.
FailureSurfaces failure_surfaces_of(const Mesh& mesh, const Ground& ground,
                                    std::span<const double> epsilon_q, double threshold,
                                    double least_separation);

}  // namespace breach::fem
