// Number of points per element and direction, so that each cell of the MPM grid gets enough: an
// element is divided into panels, and every panel gets the scene's Gauss points.
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

/// The MPM's cells and the number of points that they need.
struct CellDemand {
    double cell_size;      ///< [m]
    Vec2 origin;           ///< of any node [m]
    int points_per_cell;   ///< required
    int points_per_panel;  ///< Gauss points per direction of a panel, n
    Shift shift = {};      ///< of the points within their panels
};

/// Result for the cells. A cell is filled by the share of its area that elements cover; one with
/// share f needs floor(f * points_per_cell) points.
struct CellSupply {
    std::size_t occupied = 0;         ///< cells that any element touches with more than round-off
    std::size_t filled = 0;           ///< of them, covered completely
    std::size_t least_in_filled = 0;  ///< fewest points in such a cell
    std::size_t short_cells = 0;      ///< cells with fewer than they need
};

struct Sampling {
    std::vector<Panels> panels;  ///< [n_elements]
    std::optional<CellSupply> supply;
};

/// Every element one panel.
Sampling one_panel_each(std::size_t elements);

/// First as many panels as the mean distance of points requires, then more wherever a cell still
/// has too few points, in the direction in which the element's points lie farther apart. Throws
/// BadInput when that would take more than fifty million points.
Sampling sampling_for_cells(const std::vector<Corners>& elements, const CellDemand& demand);

}  // namespace breach::transfer
