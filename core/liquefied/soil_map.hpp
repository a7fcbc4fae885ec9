// The soil at every place of the mesh: mapped materials, saturated and unsaturated parts, liquefied
// layers.
// What the runout begins with, and the factor of safety after the shaking. On the undeformed mesh.
#pragma once

#include <span>

#include "core/exchange/mesh_snapshot.hpp"
#include "core/exchange/particle_state.hpp"
#include "core/geometry/polyline.hpp"
#include "core/liquefied/collapse.hpp"
#include "core/liquefied/elements.hpp"
#include "core/liquefied/liquefied_points.hpp"
#include "core/liquefied/liquefied_zone.hpp"
#include "core/scene/ground.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/standing_water.hpp"

namespace breach::liquefied {

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
    /// c and tan phi there in limit equilibrium, by the same soils as the runout's: residual where
    /// the soil has liquefied or collapsed, else the peak; none: it cannot fail.
    std::optional<materials::Strength> limit_strength_at(std::size_t element, const Vec2& xi) const;
    /// State of the soil there, if its strength depends on it.
    std::optional<Collapse::Soil> state_at(std::size_t element, const Vec2& xi) const;
    /// Whether soil that can liquefy by pore pressure has, at xi of an element; none: it cannot.
    std::optional<bool> liquefied_at(std::size_t element, const Vec2& xi) const;
    /// None: no soil can liquefy by pore pressure, or points decide.
    const std::optional<LiquefiedZone>& columns() const { return columns_; }
    /// Soil with a state parameter in /transfer/liquefied.
    const Collapse& collapse() const { return collapse_; }
    /// Whether the element's soil has strengths by state.
    bool collapses_in(std::size_t element) const {
        return rules_[mesh_.region_of_element[element]].collapses;
    }
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

}  // namespace breach::liquefied
