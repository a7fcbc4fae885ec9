// Values at the nodes of a mesh of quads, carried from one phase to the next.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/mechanics/tensor.hpp"

namespace breach::mechanics {

struct NodalField {
    std::vector<Vec2> position;                      ///< [n_nodes] [m]
    std::vector<std::array<std::int32_t, 4>> quads;  ///< corners counter-clockwise
    std::vector<double> value;                       ///< [n_nodes]

    bool any() const { return !value.empty(); }
};

}  // namespace breach::mechanics
