// The list of all constitutive laws and their common interface. Laws are pure functions
// (parameters, state, strain increment) -> (new state[, tangent]). Dispatch once per zone: visit
// the Law, make it `ready`, then loop over the zone's points with the concrete law.
#pragma once

#include <concepts>
#include <string>
#include <utility>
#include <variant>

#include "core/materials/drucker_prager/drucker_prager.hpp"
#include "core/materials/linear_elastic.hpp"
#include "core/materials/mohr_coulomb/mohr_coulomb.hpp"
#include "core/materials/norsand/law.hpp"
#include "core/materials/pm4sand/law.hpp"
#include "core/materials/state_parameter.hpp"
#include "core/materials/traits.hpp"

namespace breach::materials {

using Law = std::variant<LinearElastic, MohrCoulomb, DruckerPrager, PM4Sand, NorSand>;

template <class Each>
constexpr bool answers_all() {
    const bool for_memory = !Remembers<Each> || AnswersForMemory<Each>;
    const bool for_psi = !HasStateParameter<Each> || AnswersForStateParameter<Each>;
    return Answers<Each> && for_memory && for_psi;
}
template <class T>
inline constexpr bool is_law = false;
template <class... Each>
inline constexpr bool is_law<std::variant<Each...>> = (answers_all<Each>() && ...);
/// A variant of laws. Does not convert a single law implicitly.
template <class T>
concept IsLaw = is_law<T>;
static_assert(IsLaw<Law>,
              "a law does not answer all of traits.hpp, memory.hpp (if its points remember) and "
              "state_parameter.hpp (if it has one)");

/// The functions of traits.hpp for any law of the list.
template <IsLaw L>
Traits traits(const L& law) {
    return std::visit([](const auto& each) { return traits(each); }, law);
}
template <IsLaw L>
const mechanics::Elasticity& elasticity(const L& law) {
    return std::visit(
        [](const auto& each) -> const mechanics::Elasticity& { return each.elasticity; }, law);
}
template <IsLaw L>
std::optional<Strength> limit_strength(const L& law) {
    return std::visit([](const auto& each) { return limit_strength(each); }, law);
}
template <IsLaw L>
const Softening* softening(const L& law) {
    return std::visit([](const auto& each) { return softening(each); }, law);
}
template <IsLaw L>
Softening* softening(L& law) {
    return const_cast<Softening*>(softening(std::as_const(law)));
}
template <IsLaw L>
StrengthEntries strength_entries(L& law) {
    return std::visit([](auto& each) { return strength_entries(each); }, law);
}
template <IsLaw L>
double yield_excess(const L& law, const State& state) {
    return std::visit([&](const auto& each) { return yield_excess(each, state); }, law);
}
template <IsLaw L>
Voigt return_to_surface(const L& law, const State& state) {
    return std::visit([&](const auto& each) { return return_to_surface(each, state); }, law);
}
template <IsLaw L>
std::optional<LawLanes> for_particles(const L& law) {
    return std::visit([](const auto& each) { return for_particles(each); }, law);
}

/// The law with c = s_u [Pa] and phi = psi = 0; unchanged if it has no c and phi.
template <class Each>
Each undrained(Each law, double s_u) {
    const StrengthEntries entries = strength_entries(law);
    if (entries.c == nullptr) return law;
    *entries.c = s_u;
    *entries.phi = *entries.psi = 0.0;
    return law;
}

/// Whether material points of the MPM can have this law.
inline bool is_for_particles(const Law& law) { return for_particles(law).has_value(); }

inline bool has_c_and_phi(const Law& law) { return traits(law).c_and_phi; }

/// "mohr_coulomb or drucker_prager": the scene's words for the laws that satisfy `does`, for
/// messages. Calls `does` with laws whose parameters are all zero.
std::string types_of_laws_that(bool (*does)(const Law&));

template <class... Each>
std::variant<ZoneMemory<Each>...> memory_of(const std::variant<Each...>*);
/// Memory of the points of a zone besides State, for each law.
using LawMemory = decltype(memory_of(static_cast<const Law*>(nullptr)));

/// Whether the law's points have a memory besides State.
template <IsLaw L>
bool remembers(const L& law) {
    return std::visit([]<class Each>(const Each&) { return Remembers<Each>; }, law);
}

/// Calls visit(law) with the concrete law if its points have a memory.
template <IsLaw L, class Visit>
void if_remembers(const L& law, const Visit& visit) {
    const auto ask = [&]<class Each>(const Each& each) {
        if constexpr (Remembers<Each>) visit(each);
    };
    std::visit(ask, law);
}

/// Calls visit(law, points) with the concrete law and the memories of its zone, if it has them.
template <IsLaw L, class Memory, class Visit>
void with_memory(const L& law, Memory& memory, const Visit& visit) {
    if_remembers(law, [&]<class Each>(const Each& each) {
        visit(each, std::get<ZoneMemory<Each>>(memory).points);
    });
}

/// Calls visit(memory) for every point of a zone that has memories.
template <class Memory, class Visit>
void for_each_point(Memory& zone, const Visit& visit) {
    const auto go = [&](auto& memory) {
        if constexpr (requires { memory.points; })
            for (auto& each : memory.points) visit(each);
    };
    std::visit(go, zone);
}

template <IsLaw L>
auto memory_for(const L& law, std::size_t points) {
    using AnyMemory = decltype(memory_of(static_cast<const L*>(nullptr)));
    const auto made = [&]<class Each>(const Each&) -> AnyMemory {
        ZoneMemory<Each> memory;
        if constexpr (Remembers<Each>) memory.points.resize(points);
        return memory;
    };
    return std::visit(made, law);
}

/// Whether its points can have individual strengths.
inline bool has_strength_of_points(const Law& law) {
    const auto* mohr_coulomb = std::get_if<MohrCoulomb>(&law);
    return mohr_coulomb != nullptr && mohr_coulomb->strength_of == StrengthOf::point;
}
/// The law with the strength of one point, if its points can have individual strengths; else
/// unchanged.
Law with_strength(Law law, const StrengthOfPoint<double>& strength);

/// Calls visit(law) with the concrete law if it has a state parameter.
template <class L, class Visit>
requires IsLaw<std::remove_const_t<L>>
void if_state_parameter(L& law, const Visit& visit) {
    const auto ask = [&]<class Each>(Each& each) {
        if constexpr (HasStateParameter<Each>) visit(each);
    };
    std::visit(ask, law);
}
template <IsLaw L>
bool has_state_parameter(const L& law) {
    return std::visit([]<class Each>(const Each&) { return HasStateParameter<Each>; }, law);
}
/// Calls visit(law, points) with the concrete law and its zone's memories, if it has a state
/// parameter.
template <IsLaw L, class Memory, class Visit>
void with_state(const L& law, Memory& memory, const Visit& visit) {
    if_state_parameter(law, [&]<class Each>(const Each& each) {
        visit(each, std::get<ZoneMemory<Each>>(memory).points);
    });
}
/// Sets the additional softening S of a stage, if the law has a state parameter.
template <IsLaw L>
L with_S(L law, double S) {
    if_state_parameter(law, [&](auto& each) { set_s(each, S); });
    return law;
}

inline Law elastic_part(const Law& law) { return LinearElastic{elasticity(law)}; }
/// A strength without softening [Pa, rad]; psi: dilatancy angle.
struct Plastic {
    double c = 0.0, phi = 0.0, psi = 0.0, tension_cutoff = 0.0;
    StrengthOf strength_of = StrengthOf::law;
};
Law with_plasticity(const Law& law, const Plastic& strength);

/// Replaces the elasticity and multiplies the softening strains.
Law adapted(Law law, const mechanics::Elasticity& elasticity, double softening_strains);
/// Raises the tensile strength to this share of the unconfined compressive strength, if the law has
/// one.
Law with_tension_share(Law law, double share);

}  // namespace breach::materials
