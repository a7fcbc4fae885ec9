#include "mpm_solver/body/choose.hpp"

namespace breach::mpm {

Averages averages_of(const scene::Mpm& mpm, const materials::Law& law) {
    switch (mpm.anti_locking) {
        case scene::AntiLocking::on:
            return Averages::per_cell;
        case scene::AntiLocking::off:
            return Averages::none;
        case scene::AntiLocking::automatic:
            break;
    }
    const bool locks = materials::traits(law).yields || materials::elasticity(law).nu > locking_nu;
    return locks ? Averages::per_cell : Averages::none;
}

VolumeRule volume_rule_of(const scene::Mpm& mpm, const materials::Law& law) {
    return materials::traits(law).opens && mpm.gap_closure ? VolumeRule::from_stress
                                                           : VolumeRule::tracked;
}

KernelKind kernel_of(scene::Kernel kernel) {
    switch (kernel) {
        case scene::Kernel::gimp:
            return KernelKind::gimp;
        case scene::Kernel::b_spline:
            return KernelKind::b_spline;
        case scene::Kernel::linear:
            break;
    }
    return KernelKind::linear;
}

Order order_of(const scene::Mpm& mpm) {
    switch (mpm.order) {
        case scene::UpdateOrder::musl:
            return Order::musl;
        case scene::UpdateOrder::usf:
            return Order::usf;
        case scene::UpdateOrder::usl:
            break;
    }
    return Order::usl;
}

Choice choice_of(const scene::Mpm& mpm, const materials::Law& law, double viscosity) {
    return {.kernel = kernel_of(mpm.kernel),
            .order = order_of(mpm),
            .law = materials::for_particles(law).value().index(),
            .averages = averages_of(mpm, law),
            .overlap = mpm.overlap_correction.rate > 0.0 ? Overlap::corrected : Overlap::left_alone,
            .viscosity = viscosity > 0.0 ? Viscosity::newtonian : Viscosity::none,
            .volume_rule = volume_rule_of(mpm, law)};
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
        case InstructionSet::plain:
            break;
    }
    return plain_loops(choice);
}

}  // namespace breach::mpm
