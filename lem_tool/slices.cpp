#include "lem_tool/slices.hpp"

#include <algorithm>

namespace breach::lem {

void Slices::reserve(std::size_t slices, std::size_t most_crossings) {
    for (auto* array : {&left, &width, &base, &sin_a, &cos_a, &length, &weight, &soil_weight, &push,
                        &u, &driving, &shaking, &lever, &force, &c, &tan_phi}) {
        array->assign(slices, 0.0);
    }
    stands_on.assign(slices, Base::arc);
    crossings.reserve(most_crossings);
}

Slices make_slices(const Strata& strata, int wanted) {
    std::size_t most_layers = 0;
    for (const Strip& strip : strata.strips) {
        most_layers = std::max(most_layers, strip.last - strip.first);
    }
    // Each boundary, water line and floor cuts a strip at most twice; each piece may round up by
    // one slice.
    Slices slices;
    // An upper bound for any arc, because cut() writes by index and never grows the arrays.
    slices.reserve(static_cast<std::size_t>(wanted) + 2 * strata.layers.size() +
                       (3 + 2 * strata.lines) * strata.strips.size() + 1,
                   2 * (most_layers + strata.lines) + 4);
    return slices;
}

}  // namespace breach::lem
