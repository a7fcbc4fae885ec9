#include "core/liquefied/collapse.hpp"

#include <algorithm>

#include "core/liquefied/elements.hpp"

namespace breach::liquefied {
namespace {

using exchange::MeshSnapshot;

/// Present or initial pore pressure at xi [Pa]; 0 in a dry snapshot.
double pressure_at(const std::vector<double>& pressure, const MeshSnapshot& mesh,
                   std::size_t element, const Vec2& xi) {
    return pressure.empty() ? 0.0
                            : corner_values(pressure, mesh.quads[element]).dot(shape_functions(xi));
}

}  // namespace

bool collapses(const scene::Scene& scene, std::size_t region) {
    return scene.transfer && scene.transfer->liquefied &&
           std::ranges::count(scene.transfer->liquefied->regions, region) > 0 &&
           materials::has_state_parameter(scene.material_of(region).law);
}

JudgedBy judged_by(const scene::Scene& scene) {
    JudgedBy found;
    if (!scene.transfer || !scene.transfer->liquefied) return found;
    for (const std::size_t region : scene.transfer->liquefied->regions)
        (collapses(scene, region) ? found.state : found.pressure) = true;
    return found;
}

Collapse::Collapse(const MeshSnapshot& mesh, const scene::Scene& scene,
                   std::span<const std::size_t> regions)
    : mesh_(&mesh) {
    const auto any = [&](std::size_t region) { return collapses(scene, region); };
    if (std::ranges::none_of(regions, any)) return;
    strain_ = scene::fem_of(scene).failure_strain;
    soils_.resize(mesh.stress.size());
    for (std::size_t i = 0; i < soils_.size(); ++i) {
        const std::size_t gauss = mesh.gauss_positions.size(), e = i / gauss;
        const std::size_t region = regions[mesh.region_of_element[e]];
        if (!collapses(scene, region)) continue;
        const mechanics::Voigt& sigma = mesh.stress[i];
        const double u = pressure_at(mesh.pore_pressure, mesh, e, mesh.gauss_positions[i % gauss]);
        materials::UndrainedStrength strength{};
        materials::if_state_parameter(scene.material_of(region).law, [&](const auto& law) {
            strength = undrained_strength(law, sigma, mesh.psi[i], u);
        });
        // The stress may have been reduced for the undrained path; the real one is a lower bound of
        // the peak.
        strength.peak = std::max(strength.peak, std::hypot(0.5 * (sigma[0] - sigma[1]), sigma[3]));
        // Stress alone is no collapse: 9 % of the saturated points were past the line when the
        // crest had moved 4 cm (docs/verification/static_liquefaction.md, `static_lift` at 3 s).
        const bool past_line = mesh.instability_ratio[i] >= instability;
        soils_[i] = {strength, past_line, past_line && mesh.epsilon_q[i] > strain_};
    }
}

std::optional<Collapse::Soil> Collapse::at(std::size_t element, const Vec2& xi) const {
    if (soils_.empty()) return std::nullopt;
    // Also soil that was below the water when the motion began: its pressure may have fallen since.
    const bool wet = pressure_at(mesh_->pore_pressure, *mesh_, element, xi) > 0.0 ||
                     pressure_at(mesh_->pore_pressure_0, *mesh_, element, xi) > 0.0;
    if (!wet) return std::nullopt;
    const auto& places = mesh_->gauss_positions;
    const auto nearest = std::ranges::min_element(
        places, {}, [&](const Vec2& place) { return (place - xi).squaredNorm(); });
    return soils_[element * places.size() + static_cast<std::size_t>(nearest - places.begin())];
}

}  // namespace breach::liquefied
