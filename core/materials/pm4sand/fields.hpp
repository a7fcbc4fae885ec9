// All numbers of a PM4Sand state in one fixed order, for storing them.
#pragma once

#include "core/materials/pm4sand/pm4sand.hpp"

namespace breach::materials::pm4sand {

/// Calls visit(x) for every double of the state, without p_zp_unset.
template <class AnyState, class Visit>
void for_each_real(AnyState& s, Visit visit) {
    const auto plane = [&](auto& a) { visit(a.d), visit(a.x); };
    const auto in_plane = [&](auto& a) { visit(a.xx), visit(a.yy), visit(a.xy); };
    visit(s.p), plane(s.s), in_plane(s.sigma_b), plane(s.alpha), plane(s.z);
    in_plane(s.alpha_app), plane(s.alpha_true), plane(s.alpha_prev), visit(s.alpha_prev_xy);
    plane(s.z_in), in_plane(s.alpha_max), in_plane(s.alpha_min);
    visit(s.z_cum), visit(s.z_peak), visit(s.p_zp), visit(s.zp_max);
    visit(s.G), visit(s.M_b), visit(s.M_cur), visit(s.epsilon_v);
    visit(s.A_do), visit(s.z_max), visit(s.p_min), visit(s.p_min2), visit(s.sub_step);
}

/// Calls visit(x) for every number of the state; p_zp_unset comes last, as 0 or 1.
template <class Visit>
void for_each_number(const State& s, Visit visit) {
    for_each_real(s, visit);
    visit(s.p_zp_unset ? 1.0 : 0.0);
}
template <class Visit>
void for_each_number(State& s, Visit visit) {
    for_each_real(s, visit);
    double unset = s.p_zp_unset ? 1.0 : 0.0;
    visit(unset);
    s.p_zp_unset = unset != 0.0;
}

}  // namespace breach::materials::pm4sand
