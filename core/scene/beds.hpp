// Firm soil that weaker soil lies on, and where its top lies in the MPM's grid. A cell has one
// velocity gradient for all that is in it: firm soil does not yield, and holds what slides on it as
// far as it reaches into the same cells (docs/verification/mpm_convergence.md, "Firm soil beside soil that
// slides").
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/scene/scene.hpp"

namespace breach::scene {

/// Firm: it never yields, or has this many times the residual strength of what lies on it.
constexpr double firm_strength_ratio = 2.0;

struct Bed {
    std::size_t region;           ///< index into the section's regions
    std::size_t material;         ///< of its points: index into materials
    std::size_t above;            ///< a region that lies on it
    std::optional<double> level;  ///< of its top [m]; none: its top slopes
};

/// Every level that firm soil's points have as their top, and one bed for all tops that slope (up
/// to 45 degrees). Regions without a polygon are left out.
std::vector<Bed> beds_of(const Scene& scene);

/// From the MPM's floor up to a level [cells].
double cells_up_to(const Mpm& mpm, double level);
/// The line of the grid that a level lies on, to a hundredth of a cell, counted from the floor.
std::optional<std::int32_t> line_at(const Mpm& mpm, double level);

/// How many rows of cells above the floor a material's points end, when its highest ground is a
/// level bed and lies on a line of the grid: there their domains can end, too.
std::optional<std::int32_t> rows_below_bed(const Scene& scene, std::size_t material);

}  // namespace breach::scene
