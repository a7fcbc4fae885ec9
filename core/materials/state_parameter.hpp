// Interface of laws whose undrained strength follows from stress and density by the state parameter
// psi = e - e_c(p') (Been & Jefferies 1985). Such a law declares `has_state_parameter = true` and
// has the functions listed here besides those of memory.hpp.
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
    bool past_peak;  ///< q would fall in further undrained in-plane shear, with the law's S
};

/// Undrained shear strength [Pa]: c of an equivalent Mohr-Coulomb soil with phi = 0.
struct UndrainedStrength {
    double peak;      ///< largest on the path, its start included
    double residual;  ///< at the path's minimum or at the critical state; at most the peak
};

/// Which strength of an undrained path.
enum class OnPath { peak, residual };
/// Undrained strength [Pa] at a place of level ground with the pore pressure u [Pa].
using UndrainedByPlace = std::function<double(const Place&, double u)>;

template <class Law>
concept HasStateParameter = requires {
    requires Law::has_state_parameter;
};

/// No strength relies on suction.
template <class Law>
concept AnswersForStateParameter = Remembers<Law> &&
    requires(const Law& law, Law& own, const typename Law::Memory& memory,
             std::span<const typename Law::Memory> memories, std::span<const double> bounds,
             std::span<const Voigt> sigmas, double number, const Place& place, OnPath part) {
    /// psi of level ground consolidated under sigma'_v0 [-].
    { psi_at(law, place) } -> std::same_as<double>;
    { instability(law, memory) } -> std::same_as<Instability>;
    /// Least mean effective stress of the law [Pa].
    { least_mean_stress(law) } -> std::same_as<double>;
    /// In plane strain, from each memory; at most the critical strength at the bound of p' [Pa].
    { undrained_strengths(law, memories, bounds) } -> std::same_as<std::vector<UndrainedStrength>>;
    /// In plane strain, for points with stresses, state parameters and pore pressures.
    {
        undrained_strengths(law, sigmas, bounds, bounds)
        } -> std::same_as<std::vector<UndrainedStrength>>;
    /// In simple shear, for level ground.
    { undrained_by_place(law, part) } -> std::same_as<UndrainedByPlace>;
    /// Sets S, the additional softening of undrained soil [-].
    set_s(own, number);
};

}  // namespace breach::materials
