// Interface of laws whose points have a memory besides State. Such a law names the struct of a
// point's memory (`Memory`, with the stress) and the result of an integration (`Update`), and has
// the functions below besides those of traits.hpp. The FEM stores the memory zone by zone; State
// mirrors its stress.
#pragma once

#include <concepts>
#include <span>
#include <vector>

#include "core/materials/point.hpp"

namespace breach::materials {

template <class Law>
concept Remembers = requires {
    typename Law::Memory;
};

template <class Law>
concept AnswersForMemory = requires(const Law& law, const typename Law::Memory& memory,
                                    typename Law::Memory& own, const Voigt& sigma, double epsilon_v,
                                    std::span<const typename Law::Memory> old,
                                    std::span<const Voigt> d_epsilon,
                                    std::span<typename Law::Update> updates) {
    /// Initial memory of a point from the effective stress [Pa] and the compressive volumetric
    /// strain [-] of the elastic stages. Called exactly once per point and run.
    { first_memory(law, sigma, epsilon_v) } -> std::same_as<typename Law::Memory>;
    /// The effective stress in the memory [Pa, tension positive].
    { stress(law, memory) } -> std::same_as<Voigt>;
    /// All points of a zone: updates[i] from old[i] and d_epsilon[i].
    integrate(law, old, d_epsilon, updates);
    { updates[0].state } -> std::same_as<typename Law::Memory&>;
    /// Another outcome: the law could not integrate; cut the time step.
    { updates[0].outcome == decltype(updates[0].outcome)::done } -> std::same_as<bool>;
    { updates[0].counts.evaluations } -> std::same_as<int&>;
    /// d sigma / d epsilon of the elastic predictor [Pa]: symmetric positive definite.
    { elastic_tangent(law, memory) } -> std::same_as<Matrix4>;
    { shear_modulus(law, memory) } -> std::same_as<double>;
    /// Sine of the friction angle that the surfaces of an initial memory allow.
    { friction(law, memory) } -> std::same_as<double>;
    /// Largest component of the initial stress outside the surfaces, which the law keeps as a
    /// constant; 0 if it is round-off [Pa].
    { stress_outside(law, memory) } -> std::same_as<double>;
    /// The law could not integrate a strain of this point and moved it to its critical state.
    { has_fallen(law, memory) } -> std::same_as<bool>;
    /// Calls visit(x) for every number that a checkpoint stores, in one fixed order.
    for_each_number(own, [](double&) {});
    for_each_number(memory, [](double) {});
};

/// The law at the Place that place_of() returns: the same everywhere, unless a law overloads this.
template <class Law, class PlaceOf>
const Law& at_place(const Law& law, const PlaceOf&) {
    return law;
}

/// Memories of a zone's points, in their order; empty for a law without memory.
template <class Law>
struct ZoneMemory {};
template <Remembers Law>
struct ZoneMemory<Law> {
    std::vector<typename Law::Memory> points;
};

}  // namespace breach::materials
