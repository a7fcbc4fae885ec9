#include "mpm_solver/body/choose.hpp"

#include <algorithm>

namespace breach::mpm {

namespace {

bool averages(scene::AntiLocking anti_locking, const Zone& zone) {
    if (anti_locking != scene::AntiLocking::automatic) {
        return anti_locking == scene::AntiLocking::on;
    }
    return zone.elasticity.nu > locking_nu ||
           std::holds_alternative<materials::ReadyMohrCoulomb>(zone.law);
}

LawKind law_of(const ReadyLaw& law) {
    const auto* mohr_coulomb = std::get_if<materials::ReadyMohrCoulomb>(&law);
    if (!mohr_coulomb) return LawKind::elastic;
    if (!mohr_coulomb->law.softening) return LawKind::mohr_coulomb;
    return mohr_coulomb->law.softening->driver == materials::SofteningDriver::total
               ? LawKind::softens_with_total_strain
               : LawKind::softens_with_plastic_strain;
}

}  // namespace

KernelKind kernel_of(scene::Kernel kernel) {
    switch (kernel) {
        case scene::Kernel::gimp:
            return KernelKind::gimp;
        case scene::Kernel::b_spline:
            return KernelKind::b_spline;
        default:
            return KernelKind::linear;
    }
}

Order order_of(const scene::Mpm& mpm) {
    switch (mpm.order) {
        case scene::UpdateOrder::musl:
            return Order::musl;
        case scene::UpdateOrder::usf:
            return Order::usf;
        default:
            return Order::usl;
    }
}

Choice choice_of(const scene::Mpm& mpm, const Zone& zone) {
    return {.kernel = kernel_of(mpm.kernel),
            .order = order_of(mpm),
            .law = law_of(zone.law),
            .averages = averages(mpm.anti_locking, zone) ? Averages::per_cell : Averages::none,
            .overlap = mpm.overlap_correction.rate > 0.0 ? Overlap::corrected : Overlap::left_alone,
            .viscosity = zone.viscosity > 0.0 ? Viscosity::newtonian : Viscosity::none,
            .volume_rule = zone.volume_rule};
}

InstructionSet best_instruction_set() {
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl")) {
        return InstructionSet::avx512;
    }
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
        return InstructionSet::avx2;
    }
    return InstructionSet::plain;
}

Loops choose_loops(const Choice& choice, InstructionSet instructions) {
    switch (instructions) {
        case InstructionSet::avx512:
            return avx512_loops(choice);
        case InstructionSet::avx2:
            return avx2_loops(choice);
        default:
            return plain_loops(choice);
    }
}

materials::MohrCoulombNumbers numbers_of(const Zone& zone) {
    const materials::Moduli moduli = materials::make_moduli(zone.elasticity);
    materials::MohrCoulombNumbers numbers{};
    numbers.G = moduli.G;
    numbers.K = moduli.K;
    numbers.lambda = moduli.lambda;
    const auto* ready = std::get_if<materials::ReadyMohrCoulomb>(&zone.law);
    if (!ready) return numbers;
    numbers.c = ready->law.c;
    numbers.tan_phi = ready->tan_phi;
    numbers.tan_psi = std::min(ready->tan_psi, ready->tan_phi);
    numbers.tension_cutoff = ready->law.tension_cutoff;
    if (const auto& softening = ready->law.softening) {
        numbers.epsilon_q_start = softening->epsilon_q_start;
        numbers.epsilon_q_end = softening->epsilon_q_end;
        numbers.c_residual = softening->c_residual;
        numbers.tan_phi_residual = softening->tan_phi_residual;
    }
    return numbers;
}

}  // namespace breach::mpm
