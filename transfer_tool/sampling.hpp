// Numbers of points along xi and eta of each element such that the cells of the MPM grid get enough.
// Without /transfer/points_per_cell all elements have the same: large ones then leave cells of the
// MPM empty inside the soil (2 x 2 points in 10 m, cells of 2.5 m).
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/geometry/quad.hpp"

namespace breach::transfer {

using geometry::Corners;
using geometry::gauss_legendre;
using geometry::GaussRule;
using geometry::shape_functions;
using mechanics::Vec2;

/// Of points along xi and along eta.
using Numbers = std::array<int, 2>;
/// Along xi and along eta, as defined by shifted_rule [-].
using Shift = std::array<double, 2>;

/// The MPM's cells and their required number of points.
struct CellDemand {
    double cell_size;         ///< [m]
    Vec2 origin;              ///< of any node [m]
    int points_per_cell;      ///< on the mean; half of it in each
    int least_per_direction;  ///< of an element
    Shift shift = {};
};

/// Points in the cells. Elements cover a share f of a cell's area; the cell needs floor(f *
/// points_per_cell / 2) points.
struct CellSupply {
    std::size_t occupied = 0;         ///< cells that elements cover by more than round-off
    std::size_t filled = 0;           ///< completely covered cells
    std::size_t least_in_filled = 0;  ///< fewest points in a filled cell
    std::size_t short_cells = 0;      ///< cells with too few points
};

struct Sampling {
    std::vector<Numbers> numbers;  ///< [n_elements]
    GaussRule (*rule)(int n, double shift);
    std::optional<CellSupply> supply;
};

/// Gauss points.
Sampling equal_numbers(std::size_t elements, int per_direction);

/// Nearly even points. The fewest points that give each element its share of the mean, then more where a cell has too
/// few, in the direction with the larger distance. To ask for the full number in each cell takes up
/// to twice as many, because elements do not fit the cells. Throws BadInput above fifty million.
Sampling sampling_for_cells(const std::vector<Corners>& elements, const CellDemand& demand);

}  // namespace breach::transfer
