// Soil with a state parameter at the transfer: collapsed or not, and its undrained strength. The
// criterion is not a pore pressure ratio.
// Used by SoilMap (soil_map.hpp) for NorSand in /transfer/liquefied; the reasons for criterion and
// strengths are in docs/verification/static_liquefaction.md, *To the runout*.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/exchange/mesh_snapshot.hpp"
#include "core/scene/scene.hpp"

namespace breach::liquefied {

using mechanics::Vec2;

/// eta / eta_L from which soil counts as past its instability line. Less than 1, as soil at its
/// critical state is on that line.
inline constexpr double instability = 0.98;

/// Whether the region's law has a state parameter and /transfer/liquefied names it: its points then
/// get strengths by state.
bool collapses(const scene::Scene& scene, std::size_t region);

/// Criteria used in the regions of /transfer/liquefied.
struct JudgedBy {
    bool state = false;     ///< by state parameter: collapses()
    bool pressure = false;  ///< others: r_u
};
JudgedBy judged_by(const scene::Scene& scene);

/// Strengths of these Gauss points by stress and state parameter.
class Collapse {
  public:
    Collapse() = default;
    /// regions: [regions of the mesh] index into the section's. Needs psi in the mesh if a region
    /// collapses.
    Collapse(const exchange::MeshSnapshot& mesh, const scene::Scene& scene,
             std::span<const std::size_t> regions);

    struct Soil {
        materials::UndrainedStrength strength;
        bool past_line, collapsed;
    };
    /// At the Gauss point nearest to xi. None if the soil has no strength by state, or is dry:
    /// above the water at the beginning of the motion and at the transfer.
    /// The nearest Gauss point and no mean: collapsed and sound soil have no state between them.
    std::optional<Soil> at(std::size_t element, const Vec2& xi) const;
    double strain() const { return strain_; }

  private:
    const exchange::MeshSnapshot* mesh_ = nullptr;
    double strain_ = 0.0;
    std::vector<std::optional<Soil>> soils_;  ///< [Gauss points]; empty: no such soil
};

}  // namespace breach::liquefied
