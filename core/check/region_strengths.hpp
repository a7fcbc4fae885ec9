// Inside core/check only: the strengths that the phases give to a region's soil, and which phases
// liquefy it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/ground.hpp"
#include "core/scene/scene.hpp"

namespace breach::check {

/// Range of the shear strength at a place [Pa], from residual to peak.
struct Shear {
    double low, high;
    bool undrained;
};

/// A strength of a region's soil for one phase, and its scene entry.
struct View {
    std::string phase;
    std::string pointer;
    std::function<std::optional<Shear>(const materials::Place&)> at;
};

Shear shear_of(const materials::Strength& strength, const materials::Place& place);

/// "/materials/NAME/below"
std::string at_material(const scene::Material& material, const std::string& below);

/// Points spread over a region's area.
std::vector<scene::Vec2> spread_over(const geometry::Polygon& polygon);

/// The scene must outlive it. Every region must have a polygon and a material.
class RegionStrengths {
  public:
    RegionStrengths(const scene::Scene& scene, const scene::Ground& ground, std::size_t region);

    const std::string& name() const { return at().name; }
    std::vector<View> peaks() const;
    std::vector<View> residuals() const;

    /// The strength that the LEM gives to unliquefied soil; none: it has none of its own, or that
    /// of a law with a state.
    std::optional<View> lem_peak() const;
    /// Whether water changes the strength in the LEM.
    bool lem_depends_on_water() const;

    /// The entry by which the runout liquefies soil that the LEM has drained; none: it does not.
    std::optional<std::string> liquefied_in_runout() const;
    /// Whether the runout has an undrained or a residual strength for it.
    bool is_weak_in_runout() const;
    bool is_liquefied_in_lem() const;
    /// Whether /lem/undrained names it.
    bool is_undrained_in_lem() const;

  private:
    const scene::Region& at() const { return scene_.section.regions[region_]; }
    bool may_liquefy_by_transfer() const;
    bool is_layered() const;
    bool is_layer(std::size_t material) const;
    std::vector<const scene::Material*> profiles() const;
    View layers_view() const;
    View points_view(const scene::Material& soil) const;

    const scene::Scene& scene_;
    std::size_t region_;
    const scene::Material& own_;
    double r_u_;                                  ///< at its base [-]
    std::vector<const scene::Material*> points_;  ///< materials of its unliquefied soil in the MPM
};

}  // namespace breach::check
