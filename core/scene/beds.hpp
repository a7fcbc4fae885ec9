// Firm soil below weaker soil, and the place of its top in the MPM's grid. A cell has one
// velocity gradient for all soil in it: firm soil does not yield, and holds sliding soil in
// the same cells back (docs/verification/mpm_convergence.md, "Firm soil beside soil that
// slides").
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/scene/scene.hpp"

namespace breach::scene {

/// Firm soil never yields, or has this many times the residual strength of the soil on it.
constexpr double firm_strength_ratio = 2.0;

struct Bed {
    std::size_t region;           ///< index into the section's regions
    std::size_t material;         ///< of its points: index into materials
    std::size_t above;            ///< a region that lies on it
    std::optional<double> level;  ///< of its top [m]; none: its top slopes
};

/// One bed for every level that is a top of firm soil, and one for all tops that slope (up to 45
/// degrees). Regions without a polygon are left out.
std::vector<Bed> beds_of(const Scene& scene);

/// From the MPM's floor up to a level [cells].
double cells_up_to(const Mpm& mpm, double level);
/// The line of the grid at a level, to a hundredth of a cell, counted from the floor.
std::optional<std::int32_t> line_at(const Mpm& mpm, double level);

/// The number of rows of cells between the floor and the highest ground of a material, when this is
/// a level bed on a line of the grid: the domains of its points can end there, too.
std::optional<std::int32_t> rows_below_bed(const Scene& scene, std::size_t material);

}  // namespace breach::scene
