// Number of points per element and direction such that each cell of the MPM grid gets enough:
// elements are divided into panels, each with the scene's Gauss points.
// Without /transfer/points_per_cell each element is one panel: large elements then leave cells of
// the MPM empty inside the soil (2 x 2 points in 10 m, cells of 2.5 m).
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

/// Panels along xi and along eta.
using Panels = std::array<int, 2>;
/// Along xi and along eta, as defined by shifted_rule [-].
using Shift = std::array<double, 2>;

/// The MPM's cells and their required number of points.
struct CellDemand {
    double cell_size;      ///< [m]
    Vec2 origin;           ///< of any node [m]
    int points_per_cell;   ///< required
    int points_per_panel;  ///< Gauss points per direction of a panel, n
    Shift shift = {};      ///< of the points within their panels
};

/// Points in the cells. Elements cover a share f of a cell's area; the cell needs floor(f *
/// points_per_cell) points.
struct CellSupply {
    std::size_t occupied = 0;         ///< cells that elements cover by more than round-off
    std::size_t filled = 0;           ///< completely covered cells
    std::size_t least_in_filled = 0;  ///< fewest points in a filled cell
    std::size_t short_cells = 0;      ///< cells with too few points
};

struct Sampling {
    std::vector<Panels> panels;  ///< [n_elements]
    std::optional<CellSupply> supply;
};

Sampling one_panel_each(std::size_t elements);

/// Starts with the number of panels for the mean distance of points, then adds panels where a cell
/// has too few points, in the direction with the larger distance. Throws BadInput above fifty
/// million points.
Sampling sampling_for_cells(const std::vector<Corners>& elements, const CellDemand& demand);

}  // namespace breach::transfer
