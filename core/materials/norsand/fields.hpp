// All numbers of a NorSand state in one fixed order, for whoever stores it.
#pragma once

#include "core/materials/norsand/norsand.hpp"

namespace breach::materials::norsand {

/// Calls visit(x) for every double of the state, all but on_floor.
template <class AnyState, class Visit>
void for_each_real(AnyState& s, Visit visit) {
    visit(s.xx), visit(s.yy), visit(s.zz), visit(s.xy);
    visit(s.p_i), visit(s.e), visit(s.chi_i), visit(s.epsilon_q), visit(s.sub_step);
}

/// Calls visit(x) for every number of the state: on_floor is the last of them, as 0 or 1.
template <class Visit>
void for_each_number(const State& s, Visit visit) {
    for_each_real(s, visit);
    visit(s.on_floor ? 1.0 : 0.0);
}
template <class Visit>
void for_each_number(State& s, Visit visit) {
    for_each_real(s, visit);
    double floored = s.on_floor ? 1.0 : 0.0;
    visit(floored);
    s.on_floor = floored != 0.0;
}

}  // namespace breach::materials::norsand
