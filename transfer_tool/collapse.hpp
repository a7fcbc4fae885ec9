// Soil with a state parameter at the transfer: which of it has collapsed, and its undrained
// strength. The criterion is not a pore pressure ratio.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/exchange/mesh_snapshot.hpp"
#include "core/scene/scene.hpp"

namespace breach::transfer {

using mechanics::Vec2;

/// Stress ratio over the limiting one from which soil is past its instability line: less than 1, as
/// soil at its critical state lies on it.
inline constexpr double instability = 0.98;

/// Whether the region's law has a state parameter, and /transfer/liquefied names it: then its points
/// get strengths by state.
bool collapses(const scene::Scene& scene, std::size_t region);

/// Criteria for the regions of /transfer/liquefied.
struct JudgedBy {
    bool state = false;     ///< by state parameter: collapses()
    bool pressure = false;  ///< the others: r_u
};
JudgedBy judged_by(const scene::Scene& scene);

/// Counts of points, for result.json and people.
struct CollapseReport {
    double epsilon_q;           ///< strain from which soil counts as strained
    std::size_t points = 0;     ///< of these regions
    std::size_t saturated = 0;  ///< of these, with strengths by state
    std::size_t past_line = 0;  ///< of these, past the instability line
    std::size_t collapsed = 0;  ///< of these, strained as well: residual strength from the start
    double mass = 0.0;          ///< collapsed [kg]
};

/// Strengths of such Gauss points, from their stress and state parameter.
class Collapse {
  public:
    Collapse() = default;
    /// regions: [regions of the mesh] index into the section's. Computes nothing if none collapses.
    /// The mesh has psi there.
    Collapse(const exchange::MeshSnapshot& mesh, const scene::Scene& scene,
             std::span<const std::size_t> regions);

    struct Soil {
        materials::UndrainedStrength strength;
        bool past_line, collapsed;
    };
    /// Of the Gauss point nearest to xi; nothing if the soil has no strength by state, or is dry:
    /// above the water at the beginning of the motion, and now.
    std::optional<Soil> at(std::size_t element, const Vec2& xi) const;
    double strain() const { return strain_; }

  private:
    const exchange::MeshSnapshot* mesh_ = nullptr;
    double strain_ = 0.0;
    std::vector<std::optional<Soil>> soils_;  ///< [Gauss points]; empty: no such soil
};

}  // namespace breach::transfer
