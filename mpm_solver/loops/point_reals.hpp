// The real numbers of every material point: one member and one row each. Checkpoints, sorting, the
// last good state and the loops' arrays are generated from the rows. Included by the loops: this
// file must not contain functions or containers.
#pragma once

#include <iterator>

namespace breach::mpm {

/// Array: std::vector<double> in Points, double* in the loops.
template <class Array>
struct PointReals {
    Array x, y;                ///< [m]
    Array vx, vy;              ///< [m/s]
    Array Lxx, Lxy, Lyx, Lyy;  ///< velocity gradient, row = component [1/s]
    Array m;                   ///< [kg]
    Array V_0;                 ///< volume at zero mean stress [m3]
    Array V;                   ///< volume in the force [m3]
    Array volume;              ///< volume integrated from the strain increments [m3]
    Array sxx, syy, szz, sxy;  ///< effective stress [Pa], tension positive
    Array epsilon_q;           ///< total, accumulated sqrt(2/3 e:e) [-]
    Array epsilon_q_plastic;   ///< softening variable [-]
    /// The same at the last nonlocal averaging; only with nonlocal softening.
    Array epsilon_q_shared;
    Array gap;  ///< volumetric strain opened in tension, to be closed again [-]
    /// Present viscosity: that of the material plus, for soil that did not yield in the last step,
    /// that of damping; only with either [Pa s].
    Array eta;
    /// Volume that standing water pushes on, as at the start; only with such water [m3].
    Array displaced;
    /// Overlap beyond the tolerance, see OverlapMeter; only with the correction [-].
    Array excess;
    /// Peak and residual strengths of soils with a strength profile, 0 of others; only with such
    /// soils [Pa, -].
    Array c, tan_phi, c_residual, tan_phi_residual;
};

/// Lifetime of a number.
enum class Life {
    step,    ///< within a step
    run,     ///< sorted with the points and in checkpoints
    output,  ///< as run, and also in the outputs and the last good state
};

template <class Array>
struct RealOfPoints {
    using Member = Array PointReals<Array>::*;
    const char* name;  ///< in checkpoints
    Member array;
    Life life;
    Member only_with = nullptr;  ///< empty if this one is; null: always present
};

template <class Array, class P = PointReals<Array>>
inline constexpr RealOfPoints<Array> reals_of_points[] = {
    {"x", &P::x, Life::output},
    {"y", &P::y, Life::output},
    {"vx", &P::vx, Life::output},
    {"vy", &P::vy, Life::output},
    {"Lxx", &P::Lxx, Life::output},
    {"Lxy", &P::Lxy, Life::output},
    {"Lyx", &P::Lyx, Life::output},
    {"Lyy", &P::Lyy, Life::output},
    {"m", &P::m, Life::run},
    {"V_0", &P::V_0, Life::run},
    {"V", &P::V, Life::run},
    {"volume", &P::volume, Life::output},
    {"sxx", &P::sxx, Life::output},
    {"syy", &P::syy, Life::output},
    {"szz", &P::szz, Life::output},
    {"sxy", &P::sxy, Life::output},
    {"epsilon_q", &P::epsilon_q, Life::output},
    {"epsilon_q_plastic", &P::epsilon_q_plastic, Life::output},
    {"epsilon_q_shared", &P::epsilon_q_shared, Life::run, &P::epsilon_q_shared},
    {"gap", &P::gap, Life::output},
    {"eta", &P::eta, Life::run, &P::eta},
    {"displaced", &P::displaced, Life::run, &P::displaced},
    {"excess", &P::excess, Life::run, &P::excess},
    {"c", &P::c, Life::run, &P::c},
    {"tan_phi", &P::tan_phi, Life::run, &P::c},
    {"c_residual", &P::c_residual, Life::run, &P::c},
    {"tan_phi_residual", &P::tan_phi_residual, Life::run, &P::c},
};

// A member without a row would be neither sorted nor stored.
static_assert(
    [] {
        PointReals<int> rows{};
        for (const auto& real : reals_of_points<int>)
            if ((rows.*real.array)++ > 0) return false;
        return std::size(reals_of_points<int>) == sizeof rows / sizeof(int);
    }(),
    "every member has one row");

}  // namespace breach::mpm
