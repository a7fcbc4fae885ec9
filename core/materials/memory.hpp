// Laws whose points remember more than State. Such a law names the struct that a point remembers
// (`Memory`, which includes the stress) and the result of its integration (`Update`), and has the
// functions below as every law has those of traits.hpp. The FEM keeps the memory zone by zone beside
// State, which mirrors the stress, and needs nothing else.
#pragma once

#include <concepts>
#include <span>
#include <vector>

#include "core/materials/point.hpp"

namespace breach::materials {

/// The law's points remember a Law::Memory.
template <class Law>
concept Remembers = requires {
    typename Law::Memory;
};

/// The interface of such a law.
template <class Law>
concept AnswersForMemory = requires(const Law& law, const typename Law::Memory& memory,
                                    typename Law::Memory& own, const Voigt& sigma, double epsilon_v,
                                    std::span<const typename Law::Memory> old,
                                    std::span<const Voigt> d_epsilon,
                                    std::span<typename Law::Update> updates) {
    /// The first memory of a point, from the effective stress and the compressive volumetric
    /// strain that elastic stages left [Pa, -]. Exactly one call per point in a run.
    { first_memory(law, sigma, epsilon_v) } -> std::same_as<typename Law::Memory>;
    /// The effective stress in the memory [Pa, tension positive].
    { stress(law, memory) } -> std::same_as<Voigt>;
    /// All points of a zone: updates[i] from old[i] and d_epsilon[i].
    integrate(law, old, d_epsilon, updates);
    { updates[0].state } -> std::same_as<typename Law::Memory&>;
    /// Another outcome: the law refused, and the step must be cut.
    { updates[0].outcome == decltype(updates[0].outcome)::done } -> std::same_as<bool>;
    { updates[0].counts.evaluations } -> std::same_as<int&>;
    /// d sigma / d epsilon of the elastic predictor [Pa]: symmetric positive definite.
    { elastic_tangent(law, memory) } -> std::same_as<Matrix4>;
    { shear_modulus(law, memory) } -> std::same_as<double>;
    /// Sine of the friction angle that a first memory's surfaces allow.
    { friction(law, memory) } -> std::same_as<double>;
    /// Largest component of the first stress that lay outside the surfaces and is kept separately
    /// as a constant; 0 where it is round-off [Pa].
    { stress_outside(law, memory) } -> std::same_as<double>;
    /// The strain of a point could not be followed, and the law moved it to its critical state.
    { has_fallen(law, memory) } -> std::same_as<bool>;
    /// Calls visit(x) for every number that a checkpoint keeps, in one fixed order.
    for_each_number(own, [](double&) {});
    for_each_number(memory, [](double) {});
};

/// The law at place_of(), a Place: the same everywhere, unless the law has an overload.
template <class Law, class PlaceOf>
const Law& at_place(const Law& law, const PlaceOf&) {
    return law;
}

/// The memory of a zone's points, in their order; empty for a law without memory.
template <class Law>
struct ZoneMemory {};
template <Remembers Law>
struct ZoneMemory<Law> {
    std::vector<typename Law::Memory> points;
};

}  // namespace breach::materials
