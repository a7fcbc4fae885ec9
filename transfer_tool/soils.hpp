// The soil at every place of the mesh: mapped materials, saturated and unsaturated parts, liquefied
// layers.
// Built first in transfer.cpp, so that a scene that does not match its snapshot is refused before
// the costly interpolation. Asked for every point, and by the ledger for every Gauss point.
#pragma once

#include <span>

#include "core/exchange/mesh_snapshot.hpp"
#include "core/exchange/particle_state.hpp"
#include "core/geometry/polyline.hpp"
#include "core/scene/ground.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/standing_water.hpp"
#include "transfer_tool/collapse.hpp"
#include "transfer_tool/liquefied_points.hpp"
#include "transfer_tool/liquefied_zone.hpp"
#include "transfer_tool/points.hpp"

namespace breach::transfer {

using geometry::level_at;

/// One soil of the points; indexed as scene::soils_of.
struct SoilOfPoints {
    std::string region;
    std::string material;
    materials::Law law;
    exchange::StressMeasure stress;
    /// for points with individual strengths
    std::optional<materials::StrengthProfile> strength{};
};

class SoilMap {
  public:
    /// Matches regions by name. Throws BadInput with every fault: the scene lacks a region of the
    /// snapshot or gives it another material, a law is not for material points, or liquefied layers
    /// are requested and the snapshot has no stress before the shaking.
    SoilMap(const exchange::MeshSnapshot& mesh, const scene::Scene& scene, const std::string& file);

    const std::vector<SoilOfPoints>& soils() const { return soils_; }
    /// Index into soils() at the natural coordinates xi of an element. Columns and phreatic line
    /// refer to the undeformed mesh.
    /// Undeformed, because the lines of a scene are drawn on the section as it was.
    std::int32_t at(std::size_t element, const Vec2& xi) const;
    /// Strength of a point there: from its soil's profile at the undeformed place, zero without
    /// profile; residual if liquefied. Wet soil with a state parameter has the strength of its
    /// state; residual if collapsed.
    materials::PointStrength strength_at(std::size_t element, const Vec2& xi) const;
    /// State of the soil there, if its strength depends on it.
    std::optional<Collapse::Soil> state_at(std::size_t element, const Vec2& xi) const;
    /// Whether soil that can liquefy by pore pressure has, at xi of an element; none: it cannot.
    std::optional<bool> liquefied_at(std::size_t element, const Vec2& xi) const;
    /// None: no soil can liquefy by pore pressure, or points decide.
    const std::optional<LiquefiedZone>& columns() const { return columns_; }
    /// Soil with a state parameter in /transfer/liquefied.
    const Collapse& collapse() const { return collapse_; }
    /// Report on that soil; none if there is none.
    std::optional<CollapseReport> collapse_report(const Points& points) const;
    /// Standing water of the runout, none without /mpm/water.
    const scene::StandingWater& water() const { return water_; }
    /// Its pressure at a place of the displaced mesh, and the pressure's gradient [Pa, Pa/m].
    double still_pressure(const Vec2& place) const {
        return water_.is_there() ? water_.pressure(place - offset_) : 0.0;
    }
    Vec2 still_gradient(const Vec2& place) const {
        return water_.is_there() ? water_.gradient(place - offset_) : Vec2(0.0, 0.0);
    }
    /// The FEM's pore pressure before the shaking, in the runout's coordinates; only with water.
    const mechanics::NodalField& steady_pressure() const { return steady_; }

  private:
    struct RegionRule {
        std::int32_t soil;                        ///< neither saturated nor liquefied
        std::optional<std::int32_t> saturated{};  ///< below the phreatic line
        std::vector<std::int32_t> layers{};       ///< if liquefied; empty: unchanged
        bool liquefies = false;                   ///< by pore pressure
        bool collapses = false;                   ///< by state
        std::size_t region = 0;                   ///< index into the section's
    };
    void set_water(const scene::Scene& scene);
    void add_rule(const scene::Scene& scene, const std::vector<scene::Soil>& soils,
                  std::size_t region);

    const exchange::MeshSnapshot& mesh_;
    std::vector<SoilOfPoints> soils_;
    std::vector<RegionRule> rules_;  ///< [regions of the mesh]
    std::vector<Vec2> phreatic_line_;
    std::vector<double> layer_ends_;  ///< [Pa]
    bool is_liquefied(std::size_t element, const Vec2& xi, const Vec2& place) const;

    std::optional<LiquefiedZone> columns_;
    std::optional<LiquefiedPoints> points_;
    Collapse collapse_;
    scene::Ground ground_;
    mechanics::NodalField steady_;
    scene::StandingWater water_;
    Vec2 offset_{0.0, 0.0};
};

/// Stress measure for points of a soil: buoyant with standing water; else total, or effective where
/// that is wanted and the law has friction.
exchange::StressMeasure measure_for(const materials::Law& law, const scene::Scene& scene);

/// Assigns a soil to every point: state.region and the lists it refers to.
void assign_soils(const SoilMap& map, Points& points);

/// Resets the softening variable of soil with a peak strength from its present state: until it has
/// collapsed, it softens with further strain only. Call after start_softening.
void start_at_state(const SoilMap& map, Points& points);

/// From the effective stress: sigma' - u I for points with total stress, sigma' + (p - u) I for
/// buoyant ones at the pressure p of the standing water there.
mechanics::Voigt stress_of(const SoilOfPoints& soil, const mechanics::Voigt& sigma_effective,
                           double u, double p);
void settle_stress(const SoilMap& map, Points& points);

/// Points of one soil, for result.json and messages.
struct SoilShare {
    std::size_t soil;
    std::size_t points = 0;
    double mass = 0.0;  ///< [kg]
};
/// Only soils with points.
std::vector<SoilShare> shares_of_soils(const SoilMap& map, const exchange::ParticleState& state);

}  // namespace breach::transfer
