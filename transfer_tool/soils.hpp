// Which soil of the scene every place of the mesh becomes: mapped materials, saturated and
// unsaturated parts, and liquefied layers.
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

/// One soil as points get it. Index: as scene::soils_of.
struct SoilOfPoints {
    std::string region;
    std::string material;
    materials::Law law;
    exchange::StressMeasure stress;
    /// Where its points have strengths of their own
    std::optional<materials::StrengthProfile> strength{};
};

class SoilMap {
  public:
    /// Regions are matched by name. Throws BadInput, every fault at once, when the scene lacks a
    /// region of the snapshot or gives it another material than the snapshot has, when points would
    /// get a law that particles cannot have, or when liquefied layers are asked for and the
    /// snapshot has no stress before the shaking.
    SoilMap(const exchange::MeshSnapshot& mesh, const scene::Scene& scene, const std::string& file);

    const std::vector<SoilOfPoints>& soils() const { return soils_; }
    /// Index into soils() at natural coordinates xi of an element. Columns and the phreatic line
    /// are those of the undeformed mesh: soil takes its past along.
    std::int32_t at(std::size_t element, const Vec2& xi) const;
    /// Of such a point: by its soil's profile and where it lay in the undeformed section; zero
    /// where the soil has none. A liquefied one has its residual strength. Wet soil with a
    /// state parameter has the strengths of its state, and its residual one where it has collapsed.
    materials::PointStrength strength_at(std::size_t element, const Vec2& xi) const;
    /// The soil's state at such a point, where its strengths come from that.
    std::optional<Collapse::Soil> state_at(std::size_t element, const Vec2& xi) const;
    /// Nothing when the scene names no soil that liquefies by its pore pressure.
    const std::optional<LiquefiedZone>& liquefied() const { return liquefied_; }
    /// Of soil with a state parameter that /transfer/liquefied names.
    const Collapse& collapse() const { return collapse_; }
    /// What became of that soil; nothing where there is none.
    std::optional<CollapseReport> collapse_report(const Points& points) const;

  private:
    struct RegionRule {
        std::int32_t soil;                        ///< of what is neither saturated nor liquefied
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

/// What the points of such a soil get. Only a law with friction can tell an effective stress from a
/// total one.
exchange::StressMeasure measure_for(const materials::Law& law, scene::TransferredStress wanted);

/// Gives every point its soil: state.region, and the lists of regions that it refers to.
void assign_soils(const SoilMap& map, Points& points);

/// A peak that comes from the present state is the strength of soil strained as far as it is:
/// until it has collapsed it softens by the strain from here on. After start_softening.
void start_at_state(const SoilMap& map, Points& points);

/// Effective to total stress, sigma' - u I, where the soil's points carry the total one.
mechanics::Voigt stress_of(const SoilOfPoints& soil, const mechanics::Voigt& sigma_effective,
                           double u);
/// The same for all points.
void settle_stress(const SoilMap& map, Points& points);

/// What one soil got, for result.json and people.
struct SoilShare {
    std::size_t soil;
    std::size_t points = 0;
    double mass = 0.0;  ///< [kg]
};
/// Soils without points are left out.
std::vector<SoilShare> shares_of_soils(const SoilMap& map, const exchange::ParticleState& state);

}  // namespace breach::transfer
