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
    const std::size_t gauss = mesh.gauss_positions.size();
    for (const std::size_t region : scene.transfer->liquefied->regions) {
        if (!collapses(scene, region)) continue;
        std::vector<std::size_t> own;
        std::vector<mechanics::Voigt> sigma;
        std::vector<double> psi, u;
        for (std::size_t i = 0; i < soils_.size(); ++i) {
            const std::size_t e = i / gauss;
            if (regions[mesh.region_of_element[e]] != region) continue;
            own.push_back(i);
            sigma.push_back(mesh.stress[i]);
            psi.push_back(mesh.psi[i]);
            u.push_back(pressure_at(mesh.pore_pressure, mesh, e, mesh.gauss_positions[i % gauss]));
        }
        std::vector<materials::UndrainedStrength> strengths;
        materials::if_state_parameter(scene.material_of(region).law, [&](const auto& law) {
            strengths = undrained_strengths(law, sigma, psi, u);
        });
        for (std::size_t k = 0; k < own.size(); ++k) {
            const std::size_t i = own[k];
            // The stress may have been reduced for the undrained path; the real one is a lower
            // bound of the peak.
            const double shear = std::hypot(0.5 * (sigma[k][0] - sigma[k][1]), sigma[k][3]);
            strengths[k].peak = std::max(strengths[k].peak, shear);
            // Stress alone is no collapse: 9 % of the saturated points were past the line when the
            // crest had moved 4 cm (docs/verification/static_liquefaction.md, `static_lift` at
            // 3 s).
            const bool past_line = mesh.instability_ratio[i] >= instability;
            soils_[i] = {strengths[k], past_line, past_line && mesh.epsilon_q[i] > strain_};
        }
    }
}

std::optional<Collapse::Soil> Collapse::at(std::size_t element, const Vec2& xi) const {
    if (soils_.empty()) return std::nullopt;
    // Also soil that was below the water when the motion began: its pressure may have fallen since.
    const bool wet = pressure_at(mesh_->pore_pressure, *mesh_, element, xi) > 0.0 ||
                     pressure_at(mesh_->pore_pressure_0, *mesh_, element, xi) > 0.0;
    if (!wet) return std::nullopt;
    const auto& places = mesh_->gauss_positions;
    return soils_[element * places.size() + nearest_gauss(places, xi)];
}

}  // namespace breach::liquefied
