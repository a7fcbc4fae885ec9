#include "transfer_tool/laws.hpp"

#include <algorithm>

namespace breach::transfer {
namespace {

constexpr double round_off = 1e-9;  // of the stress itself

}  // namespace

std::vector<materials::Law> laws_of_regions(const exchange::MeshSnapshot& mesh,
                                            const scene::Scene& scene, const std::string& file) {
    std::vector<materials::Law> laws;
    std::vector<fault::Fault> faults;
    const std::string remedy = "use the scene that the snapshot was made with";
    for (std::size_t r = 0; r < mesh.regions.size(); ++r) {
        const std::string& name = mesh.regions[r];
        const auto region = std::ranges::find(scene.section.regions, name, &scene::Region::name);
        if (region == scene.section.regions.end()) {
            faults.push_back({"/section/regions",
                              "the snapshot's region \"" + name + "\" is not in the scene",
                              remedy});
            continue;
        }
        const scene::Material& material = scene.materials[region->material];
        if (material.name != mesh.materials_of_regions[r])
            faults.push_back(
                {"/section/regions/" + std::to_string(region - scene.section.regions.begin()) +
                     "/material",
                 "\"" + name + "\" is of \"" + material.name + "\" in the scene and of \"" +
                     mesh.materials_of_regions[r] + "\" in the snapshot",
                 remedy});
        laws.push_back(material.law);
    }
    if (!faults.empty()) throw fault::BadInput(file, faults);
    return laws;
}

void start_softening(scene::SofteningStart start, exchange::ParticleState& state) {
    if (start == scene::SofteningStart::zero) std::ranges::fill(state.epsilon_q_plastic, 0.0);
}

YieldReport return_to_yield_surface(std::span<const materials::Law> laws,
                                    exchange::ParticleState& state) {
    YieldReport report;
    for (std::size_t p = 0; p < state.size(); ++p) {
        const auto* law = std::get_if<materials::MohrCoulomb>(&laws[state.region[p]]);
        if (law == nullptr) continue;
        const materials::State old{state.stress[p], state.epsilon_q_plastic[p]};
        const double excess = materials::yield_excess(*law, old);
        if (excess <= 0.0) continue;
        if (excess > round_off * old.sigma.norm()) {
            ++report.returned;
            report.largest_excess = std::max(report.largest_excess, excess);
        }
        state.stress[p] = materials::integrate(*law, old, mechanics::Voigt::Zero()).state.sigma;
    }
    return report;
}

void find_reference_volumes(std::span<const materials::Law> laws, exchange::ParticleState& state) {
    state.volume_0.resize(state.size());
    for (std::size_t p = 0; p < state.size(); ++p) {
        const double K = materials::elasticity(laws[state.region[p]]).bulk_modulus();
        const double ratio = 1.0 + mechanics::mean_stress(state.stress[p]) / K;
        if (ratio <= 0.0)
            throw fault::Breakdown("point " + std::to_string(p) + " of region \"" +
                                   state.regions[state.region[p]] + "\": its mean stress of " +
                                   std::to_string(mechanics::mean_stress(state.stress[p]) / 1e6) +
                                   " MPa exceeds the bulk modulus of its law (" +
                                   std::to_string(K / 1e6) + " MPa)");
        state.volume_0[p] = state.volume[p] / ratio;
    }
}

}  // namespace breach::transfer
