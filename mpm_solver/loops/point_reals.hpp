// The real numbers of every material point: a member and a row each. Checkpoints, sorting, the last
// good state and the loops' arrays are generated from the rows. Included by the loops, so this file
// must not contain functions or containers.
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
    Array V;                   ///< volume that the force uses [m3]
    Array volume;              ///< volume followed through every strain increment [m3]
    Array sxx, syy, szz, sxy;  ///< effective stress [Pa], tension positive
    Array epsilon_q;           ///< total, accumulated sqrt(2/3 e:e) [-]
    Array epsilon_q_plastic;   ///< the strain that drives softening [-]
    /// The same when it was last averaged over neighbourhoods; where softening is nonlocal
    Array epsilon_q_shared;
    Array gap;  ///< volume strain to be closed after tension [-]
    /// Viscosity in force: the material's and, for soil that did not yield in the last step, its
    /// damping's; where there is either [Pa s]
    Array eta;
    /// Overlap beyond the tolerance, see OverlapMeter; where the body corrects it [-]
    Array excess;
    /// Strengths before and after softening, of soils whose material has a profile, 0 of others;
    /// where there is one [Pa, -]
    Array c, tan_phi, c_residual, tan_phi_residual;
    Array drift_x, drift_y;  ///< velocity that moves the points, of MUSL [m/s]
};

/// How long a number is kept.
enum class Life {
    step,    ///< computed and used within a step
    run,     ///< sorted with the points and in checkpoints
    output,  ///< that, and it changes and is in the outputs: in the last good state, too
};

template <class Array>
struct RealOfPoints {
    using Member = Array PointReals<Array>::*;
    const char* name;  ///< in checkpoints
    Member array;
    Life life;
    Member only_with = nullptr;  ///< is empty where this one is; null: every run has it
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
    {"excess", &P::excess, Life::run, &P::excess},
    {"c", &P::c, Life::run, &P::c},
    {"tan_phi", &P::tan_phi, Life::run, &P::c},
    {"c_residual", &P::c_residual, Life::run, &P::c},
    {"tan_phi_residual", &P::tan_phi_residual, Life::run, &P::c},
    {"drift_x", &P::drift_x, Life::step, &P::drift_x},
    {"drift_y", &P::drift_y, Life::step, &P::drift_y},
};

static_assert(
    [] {
        PointReals<int> rows{};
        for (const auto& real : reals_of_points<int>)
            if ((rows.*real.array)++ > 0) return false;
        return std::size(reals_of_points<int>) == sizeof rows / sizeof(int);
    }(),
    "every member has one row");

}  // namespace breach::mpm
