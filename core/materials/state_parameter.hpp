// Laws with an undrained strength that follows from stress and density, by the state parameter psi =
// e - e_c(p') (Been & Jefferies 1985). Such a law declares `has_state_parameter = true` and has the
// functions listed here, beside memory.hpp. Other laws have none of them: no psi, no limiting stress
// ratio, no strength by state and no additional softening S.
#pragma once

#include <concepts>
#include <functional>
#include <span>
#include <vector>

#include "core/materials/memory.hpp"
#include "core/materials/strength/profile.hpp"

namespace breach::materials {

/// Nearness of a point to flow failure.
struct Instability {
    double psi;      ///< state parameter [-]
    double ratio;    ///< eta over eta_L, the limiting stress ratio [-]
    bool past_peak;  ///< sheared on in the plane without drainage, q would fall; with the law's S
};

/// Of undrained shear [Pa]: equivalent to a Mohr-Coulomb soil with phi = 0 and this c.
struct UndrainedStrength {
    double peak;      ///< the largest on the way, the present one included
    double critical;  ///< at the critical state of the void ratio; never above the peak
};

/// The largest shear stress of an undrained path, or that of the critical state.
enum class OnPath { peak, residual };
/// Shear stress [Pa] at a place of level ground with the pore pressure u [Pa].
using UndrainedByPlace = std::function<double(const Place&, double u)>;

template <class Law>
concept HasStateParameter = requires {
    requires Law::has_state_parameter;
};

/// The interface of such a law. No strength relies on suction.
template <class Law>
concept AnswersForStateParameter = Remembers<Law> &&
    requires(const Law& law, Law& own, const typename Law::Memory& memory,
             std::span<const typename Law::Memory> memories, std::span<const double> bounds,
             const Voigt& sigma, double number, const Place& place, OnPath part) {
    /// psi of level ground consolidated under sigma'_v0 [-].
    { psi_at(law, place) } -> std::same_as<double>;
    { instability(law, memory) } -> std::same_as<Instability>;
    /// Mean effective stress below which the law does not go [Pa].
    { least_mean_stress(law) } -> std::same_as<double>;
    /// In the plane, from each memory on; at most the critical strength at its bound of p' [Pa].
    { undrained_strengths(law, memories, bounds) } -> std::same_as<std::vector<UndrainedStrength>>;
    /// In the plane, of a point with the stress sigma, this psi and the pore pressure u.
    { undrained_strength(law, sigma, number, number) } -> std::same_as<UndrainedStrength>;
    /// In simple shear, of level ground.
    { undrained_by_place(law, part) } -> std::same_as<UndrainedByPlace>;
    /// Changes S, the additional softening of undrained soil [-].
    set_s(own, number);
};

}  // namespace breach::materials
