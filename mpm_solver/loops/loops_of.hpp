// Selects a zone's loops for one instruction set. Included by one source per set, compiled with its
// flags; the parameter `Isa` makes all functions distinct.
#pragma once

#include "core/materials/law_lanes.hpp"
#include "mpm_solver/loops/gather_loop.hpp"
#include "mpm_solver/loops/scatter_loop.hpp"
#include "mpm_solver/loops/stress_loop.hpp"

namespace breach::mpm {

template <class Isa, class Law, Averages averages, VolumeRule rule>
void choose_stress(const Choice& choice, Loops& loops) {
    loops.stress = choice.overlap == Overlap::corrected
                       ? stress<Isa, Law, averages, Overlap::corrected, rule>
                       : stress<Isa, Law, averages, Overlap::left_alone, rule>;
}

/// Law and decisions are template parameters: what a zone does not use costs no branch per point.
template <class Isa, Averages averages, VolumeRule rule, class... Laws>
void choose_law(const Choice& choice, Loops& loops, materials::LawList<Laws...>) {
    std::size_t place = 0;
    ((place++ == choice.law ? choose_stress<Isa, Laws, averages, rule>(choice, loops) : void()),
     ...);
}

template <class Isa, Viscosity viscosity>
Loop scatter_in(Medium medium) {
    return medium == Medium::water ? scatter<Isa, viscosity, Medium::water>
                                   : scatter<Isa, viscosity, Medium::air>;
}

template <class Isa, Averages averages>
void choose_all(const Choice& choice, Loops& loops) {
    loops.scatter = choice.viscosity == Viscosity::newtonian
                        ? scatter_in<Isa, Viscosity::newtonian>(choice.medium)
                        : scatter_in<Isa, Viscosity::none>(choice.medium);
    loops.gather = gather<Isa, averages>;
    if (choice.volume_rule == VolumeRule::from_stress) {
        choose_law<Isa, averages, VolumeRule::from_stress>(choice, loops, materials::LaneLaws{});
        loops.settle = settle<Isa, averages, VolumeRule::from_stress>;
    } else {
        choose_law<Isa, averages, VolumeRule::tracked>(choice, loops, materials::LaneLaws{});
        loops.settle = settle<Isa, averages, VolumeRule::tracked>;
    }
}

template <class Isa>
Loops loops_of(const Choice& choice) {
    Loops loops;
    if (choice.averages == Averages::per_cell) {
        choose_all<Isa, Averages::per_cell>(choice, loops);
    } else {
        choose_all<Isa, Averages::none>(choice, loops);
    }
    if (choice.viscosity == Viscosity::newtonian) loops.dissipate = dissipate<Isa>;
    return loops;
}

}  // namespace breach::mpm
