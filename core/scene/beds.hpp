// Beds: firm soil below weaker soil, and their tops in the MPM's grid. A cell has one velocity
// gradient for all its soil, so firm soil that does not yield restrains sliding soil in the same
// cell (docs/verification/mpm_convergence.md, "Firm soil beside soil that slides").
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/scene/scene.hpp"

namespace breach::scene {

/// Soil is firm if it never yields, or if its strength is this multiple of the residual strength
/// above it.
constexpr double firm_strength_ratio = 2.0;

struct Bed {
    std::size_t region;           ///< index into the section's regions
    std::size_t material;         ///< of its points: index into materials
    std::size_t above;            ///< a region directly above it
    std::optional<double> level;  ///< of its top [m]; none: the top slopes
};

/// One bed for each level top of firm soil, and one for all sloping tops (up to 45 degrees).
/// Ignores regions without a polygon.
std::vector<Bed> beds_of(const Scene& scene);

/// Height of a level above the MPM's floor [cells].
double cells_up_to(const Mpm& mpm, double level);
/// Number of the grid line at a level, counted from the floor; tolerance 0.01 cells.
std::optional<std::int32_t> line_at(const Mpm& mpm, double level);

/// Rows of cells between the floor and the highest ground of a material, if that is the level top
/// of a bed on a grid line: the domains of its points can then be clipped there.
std::optional<std::int32_t> rows_below_bed(const Scene& scene, std::size_t material);

}  // namespace breach::scene
