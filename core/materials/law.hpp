// The list of all constitutive laws and the one way to ask them. Laws are pure: (parameters, state,
// strain increment) -> (new state[, tangent]); no I/O, nothing hidden. Dispatch is per zone: visit
// the Law once, make it `ready`, then loop over the zone's points with the concrete law.
#pragma once

#include <concepts>
#include <string>
#include <utility>
#include <variant>

#include "core/materials/drucker_prager/drucker_prager.hpp"
#include "core/materials/linear_elastic.hpp"
#include "core/materials/mohr_coulomb/mohr_coulomb.hpp"
#include "core/materials/pm4sand/law.hpp"
#include "core/materials/traits.hpp"

namespace breach::materials {

using Law = std::variant<LinearElastic, MohrCoulomb, DruckerPrager, PM4Sand>;

template <class... Each>
constexpr bool each_answers(const std::variant<Each...>*) {
    return (Answers<Each> && ...);
}
static_assert(each_answers(static_cast<const Law*>(nullptr)),
              "a law does not answer everything that traits.hpp lists");

/// The same answers of whichever law it is. (`IsLaw`: never by conversion from one of them.)
template <class T>
concept IsLaw = std::same_as<T, Law>;

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

/// Particles can have it.
inline bool is_for_particles(const Law& law) { return for_particles(law).has_value(); }

/// Its strength stands in two entries.
inline bool has_c_and_phi(const Law& law) { return traits(law).c_and_phi; }

/// "mohr_coulomb or drucker_prager": the scene's words for the laws that do what is asked, for
/// whoever must name one. Asked of laws whose numbers are all zero.
std::string types_of_laws_that(bool (*does)(const Law&));

/// The law whose points remember a pm4sand::State, or null.
inline const PM4Sand* sand_in(const Law& law) { return std::get_if<PM4Sand>(&law); }

/// E and, where given, the strains of softening multiplied.
Law scaled(Law law, double stiffness, double softening_strains);

}  // namespace breach::materials
