// The scene's soil at every place of the mesh: mapped materials, saturated and unsaturated parts,
// and liquefied layers.
#pragma once

#include <span>

#include "core/exchange/mesh_snapshot.hpp"
#include "core/exchange/particle_state.hpp"
#include "core/geometry/polyline.hpp"
#include "core/scene/ground.hpp"
#include "core/scene/scene.hpp"
#include "transfer_tool/collapse.hpp"
#include "transfer_tool/liquefied_zone.hpp"
#include "transfer_tool/points.hpp"

namespace breach::transfer {

using geometry::level_at;

/// One soil of the points. Index: as in scene::soils_of.
struct SoilOfPoints {
    std::string region;
    std::string material;
    materials::Law law;
    exchange::StressMeasure stress;
    /// For points with strengths of their own
    std::optional<materials::StrengthProfile> strength{};
};

class SoilMap {
  public:
    /// Regions are matched by name. Throws BadInput, every fault at once, when the scene lacks a
    /// region of the snapshot or gives it another material, when points would get a law that
    /// particles cannot have, or when liquefied layers are requested and the snapshot has no stress
    /// before the shaking.
    SoilMap(const exchange::MeshSnapshot& mesh, const scene::Scene& scene, const std::string& file);

    const std::vector<SoilOfPoints>& soils() const { return soils_; }
    /// Index into soils() at natural coordinates xi of an element. Columns and the phreatic line
    /// are those of the undeformed mesh: soil keeps its origin.
    std::int32_t at(std::size_t element, const Vec2& xi) const;
    /// Strength of such a point: by its soil's profile and its place in the undeformed section;
    /// zero where the soil has none. A liquefied one has its residual strength. Wet soil with a
    /// state parameter has the strengths of its state, and its residual one where it has collapsed.
    materials::PointStrength strength_at(std::size_t element, const Vec2& xi) const;
    /// The soil's state at such a point, if its strengths depend on it.
    std::optional<Collapse::Soil> state_at(std::size_t element, const Vec2& xi) const;
    /// Nothing: no soil of the scene can liquefy by its pore pressure.
    const std::optional<LiquefiedZone>& liquefied() const { return liquefied_; }
    /// Of soil with a state parameter that /transfer/liquefied names.
    const Collapse& collapse() const { return collapse_; }
    /// Report on that soil; nothing where there is none.
    std::optional<CollapseReport> collapse_report(const Points& points) const;

  private:
    struct RegionRule {
        std::int32_t soil;                        ///< of soil neither saturated nor liquefied
        std::optional<std::int32_t> saturated{};  ///< below the phreatic line
        std::vector<std::int32_t> layers{};       ///< of liquefied soil; empty: it keeps its own
        bool liquefies = false;                   ///< by its pore pressure
        bool collapses = false;                   ///< by its state
        std::size_t region = 0;                   ///< of the section
    };
    void add_rule(const scene::Scene& scene, const std::vector<scene::Soil>& soils,
                  std::size_t region);

    const exchange::MeshSnapshot& mesh_;
    std::vector<SoilOfPoints> soils_;
    std::vector<RegionRule> rules_;  ///< by region of the mesh
    std::vector<Vec2> phreatic_line_;
    std::vector<double> layer_ends_;  ///< [Pa]
    std::optional<LiquefiedZone> liquefied_;
    Collapse collapse_;
    scene::Ground ground_;
};

/// Stress measure for points of such a soil. Only a law with friction distinguishes an effective
/// stress from a total one.
exchange::StressMeasure measure_for(const materials::Law& law, scene::TransferredStress wanted);

/// Assigns a soil to every point: state.region, and the lists of regions that it refers to.
void assign_soils(const SoilMap& map, Points& points);

/// A peak strength from the present state is that of soil at its present strain: until it has
/// collapsed it softens with the strain from here on. Call after start_softening.
void start_at_state(const SoilMap& map, Points& points);

/// Effective to total stress, sigma' - u I, if the soil's points have the total one.
mechanics::Voigt stress_of(const SoilOfPoints& soil, const mechanics::Voigt& sigma_effective,
                           double u);
/// The same for all points.
void settle_stress(const SoilMap& map, Points& points);

/// Points of one soil, for result.json and messages.
struct SoilShare {
    std::size_t soil;
    std::size_t points = 0;
    double mass = 0.0;  ///< [kg]
};
/// Soils without points are left out.
std::vector<SoilShare> shares_of_soils(const SoilMap& map, const exchange::ParticleState& state);

}  // namespace breach::transfer
