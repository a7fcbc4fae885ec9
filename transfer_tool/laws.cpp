#include "transfer_tool/laws.hpp"

#include <algorithm>

namespace breach::transfer {
namespace {

constexpr double stress_round_off = 1e-9;  // over the stress

/// The law of a point, with its individual strength if it has one.
class LawOfPoint {
  public:
    LawOfPoint(std::span<const materials::Law> laws, const exchange::ParticleState& state)
        : laws_(laws), state_(state) {}

    /// Valid until the next call.
    const materials::Law& operator()(std::size_t p) {
        const materials::Law& law = laws_[state_.region[p]];
        if (!materials::has_strength_of_points(law)) return law;
        const exchange::StrengthOfPoints& s = state_.strength;
        own_ = materials::with_strength(
            law, {s.c[p], s.tan_phi[p], s.c_residual[p], s.tan_phi_residual[p]});
        return own_;
    }

  private:
    std::span<const materials::Law> laws_;
    const exchange::ParticleState& state_;
    materials::Law own_{};
};

}  // namespace

std::vector<materials::Law> laws_of(std::span<const SoilOfPoints> soils) {
    std::vector<materials::Law> laws;
    for (const SoilOfPoints& soil : soils) laws.push_back(soil.law);
    return laws;
}

void start_softening(std::span<const materials::Law> laws, exchange::ParticleState& state) {
    for (std::size_t p = 0; p < state.size(); ++p) {
        const auto* softening = materials::softening(laws[state.region[p]]);
        if (softening != nullptr && softening->driver == materials::SofteningDriver::total)
            state.epsilon_q_plastic[p] = state.epsilon_q[p];
    }
}

std::vector<SofteningShare> softening_of(std::span<const materials::Law> laws,
                                         const exchange::ParticleState& state) {
    std::vector<SofteningShare> shares(laws.size());
    std::vector<double> mass(laws.size(), 0.0);
    for (std::size_t p = 0; p < state.size(); ++p) {
        SofteningShare& share = shares[state.region[p]];
        share.mean += state.mass[p] * state.epsilon_q_plastic[p];
        share.largest = std::max(share.largest, state.epsilon_q_plastic[p]);
        mass[state.region[p]] += state.mass[p];
    }
    std::vector<SofteningShare> softening;
    for (std::size_t i = 0; i < laws.size(); ++i) {
        const auto* own = materials::softening(laws[i]);
        if (own == nullptr || mass[i] == 0.0) continue;
        softening.push_back({i, own->driver, shares[i].mean / mass[i], shares[i].largest});
    }
    return softening;
}

YieldReport return_to_yield_surface(std::span<const materials::Law> laws,
                                    exchange::ParticleState& state) {
    YieldReport report(laws.size());
    LawOfPoint law_of(laws, state);
    for (std::size_t p = 0; p < state.size(); ++p) {
        const materials::Law& law = law_of(p);
        const materials::State old{state.stress[p], state.epsilon_q_plastic[p]};
        const double excess = materials::yield_excess(law, old);
        if (excess <= 0.0) continue;
        // Stress on the surface leaves it by round-off at every point: returned, but not counted.
        if (excess > stress_round_off * old.sigma.norm()) {
            YieldShare& share = report[state.region[p]];
            ++share.returned;
            share.mass += state.mass[p];
            if (excess > share.largest_excess) share.place = state.position[p];
            share.largest_excess = std::max(share.largest_excess, excess);
        }
        state.stress[p] = materials::return_to_surface(law, old);
    }
    return report;
}

void find_reference_volumes(std::span<const materials::Law> laws, exchange::ParticleState& state) {
    for (std::size_t p = 0; p < state.size(); ++p) {
        // The scene's K. The MPM converts V_0 where it computes with a lower one
        // (/mpm/stiffness_scale).
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
