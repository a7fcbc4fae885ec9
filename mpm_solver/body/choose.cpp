#include "mpm_solver/body/choose.hpp"

#include "core/words/number.hpp"

namespace breach::mpm {

namespace {

using process::Decided;
using process::Use;
using words::text_of;

/// Isochoric plastic flow locks like nearly incompressible elasticity.
Decided<Averages> averages_of(const scene::Mpm& mpm, const SoilOfZone& soil) {
    const std::string pointer = "/mpm/anti_locking";
    const std::string what = "anti-locking of " + soil.material;
    switch (mpm.anti_locking) {
        case scene::AntiLocking::on:
            return {
                Averages::per_cell,
                {what, Use::on,
                 "volumetric increment and mean stress averaged per cell and material", pointer}};
        case scene::AntiLocking::off:
            return {Averages::none, {what, Use::left_out, "switched off", pointer}};
        case scene::AntiLocking::automatic:
            break;
    }
    // Strain and stress are averaged together: with averaged strains alone and gap closure,
    // prototypes blew up.
    if (materials::traits(soil.law).yields)
        return {Averages::per_cell, {what, Use::on, "plastic flow keeps its volume", pointer}};
    if (materials::elasticity(soil.law).nu > locking_nu)
        return {Averages::per_cell, {what, Use::on, "nearly incompressible", pointer}};
    return {Averages::none,
            {what, Use::left_out,
             "elastic and compressible: it does not lock, averaging would take energy", pointer}};
}

Decided<VolumeRule> volume_rule_of(const scene::Mpm& mpm, const SoilOfZone& soil) {
    const std::string what = "gap closure after tension", pointer = "/mpm/gap_closure";
    // Without closure each pull on a point adds volume that no compression takes back: in the
    // prototype, debris grew to more than 1.6 times its volume.
    if (!materials::traits(soil.law).opens)
        return {VolumeRule::tracked, {what, Use::left_out, "no law opens in tension", pointer}};
    if (!mpm.gap_closure)
        return {VolumeRule::tracked, {what, Use::left_out, "switched off", pointer}};
    return {VolumeRule::from_stress,
            {what, Use::on, "opened volume closes before pressure builds again", pointer}};
}

Decided<Viscosity> viscosity_of(const scene::Mpm& mpm, const SoilOfZone& soil) {
    const std::string what = "viscosity of " + soil.material;
    const std::string pointer = "/materials/" + soil.material + "/viscosity";
    if (soil.viscosity > 0.0)
        return {
            Viscosity::newtonian,
            {what, Use::on, text_of(soil.viscosity) + " Pa s beside the law's stress", pointer}};
    return {mpm.damping_ratio > 0.0 ? Viscosity::newtonian : Viscosity::none,
            {what, Use::left_out, "0: what yields dissipates by its law and the scheme alone",
             pointer}};
}

Decided<Overlap> overlap_of(const scene::OverlapCorrection& correction) {
    const std::string what = "overlap correction", pointer = "/mpm/overlap_correction/rate";
    if (correction.rate > 0.0)
        return {
            Overlap::corrected,
            {what, Use::on,
             "rate " + text_of(correction.rate) + " 1/s beyond " + text_of(correction.tolerance),
             pointer}};
    return {Overlap::left_alone,
            {what, Use::left_out, "rate 0: overlap is measured only", pointer}};
}

Decided<scene::Shaking> shaking_of(scene::Shaking asked) {
    const std::string what = "shaking after the transfer", pointer = "/mpm/shaking";
    if (asked == scene::Shaking::goes_on)
        return {asked,
                {what, Use::on,
                 "the grid moves with the base of the FEM's free-field columns, exactly for any "
                 "step; approximate: one rigid ground (without the dam's reaction on its base and "
                 "waves radiated into the rock), walls at rest on it, no further liquefaction",
                 pointer}};
    return {asked,
            {what, Use::left_out, "the ground is at rest: an earthquake ends with the transfer",
             pointer}};
}

}  // namespace

SoilDecisions decide(const scene::Mpm& mpm, const SoilOfZone& soil) {
    return {averages_of(mpm, soil), volume_rule_of(mpm, soil), viscosity_of(mpm, soil)};
}

SchemeDecisions decide(const scene::Mpm& mpm) {
    return {overlap_of(mpm.overlap_correction), shaking_of(mpm.shaking)};
}

Choice choice_of(const scene::Mpm& mpm, const SoilOfZone& soil) {
    const SchemeDecisions scheme = decide(mpm);
    const SoilDecisions decided = decide(mpm, soil);
    return {.law = materials::for_particles(soil.law).value().index(),
            .averages = decided.averages.value,
            .overlap = scheme.overlap.value,
            .viscosity = decided.viscosity.value,
            .medium = mpm.water ? Medium::water : Medium::air,
            .volume_rule = decided.volume_rule.value};
}

InstructionSet best_instruction_set() {
    // The extensions that CMakeLists.txt compiles the loops with. A virtual machine may offer
    // AVX-512 and hide AVX2 or FMA.
    if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma"))
        return InstructionSet::plain;
    const bool wide = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                      __builtin_cpu_supports("avx512vl");
    return wide ? InstructionSet::avx512 : InstructionSet::avx2;
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
