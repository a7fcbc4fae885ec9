// All numbers of a NorSand state in one fixed order, for storing them.
#pragma once

#include "core/materials/norsand/norsand.hpp"

namespace breach::materials::norsand {

/// Calls visit(x) for every double of the state.
template <class AnyState, class Visit>
void for_each_real(AnyState& s, Visit visit) {
    visit(s.xx), visit(s.yy), visit(s.zz), visit(s.xy);
    visit(s.p_i), visit(s.e), visit(s.chi_i), visit(s.epsilon_q), visit(s.sub_step);
}

/// Calls visit(x) for every number of the state; on_floor and has_fallen come last, as 0 or 1.
template <class Visit>
void for_each_number(const State& s, Visit visit) {
    for_each_real(s, visit);
    for (const bool flag : {s.on_floor, s.has_fallen}) visit(flag ? 1.0 : 0.0);
}
template <class Visit>
void for_each_number(State& s, Visit visit) {
    for_each_real(s, visit);
    for (bool* flag : {&s.on_floor, &s.has_fallen}) {
        double number = *flag ? 1.0 : 0.0;
        visit(number);
        *flag = number != 0.0;
    }
}

}  // namespace breach::materials::norsand
