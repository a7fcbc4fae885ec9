// The square background grid: positions, walls, nodal arrays, active nodes.
// Made once per run. step() resets and refills mass and motion of the active nodes; Strips decides
// at each sort which nodes are active, so that empty cells cost nothing.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/grid/kernel.hpp"
#include "core/scene/scene.hpp"
#include "mpm_solver/body/terrain.hpp"

namespace breach::mpm {

using grid::WallRows;

/// Four values of a node, scattered and gathered together.
using Lane = Eigen::Array4d;

/// Boundary conditions of a node; 0 inside.
namespace condition {
constexpr std::uint8_t hold_x = 1;
constexpr std::uint8_t hold_y = 2;
constexpr std::uint8_t floor = 4;    ///< unilateral in y, Coulomb friction in x
constexpr std::uint8_t terrain = 8;  ///< a Contact
}  // namespace condition

/// Row of the floor's nodes; one ghost row is below it.
constexpr std::int32_t floor_row = 1;

/// Nodes are stored column by column (y fastest), with one ghost row around the domain.
struct Grid {
    double h;      ///< edge of a cell [m]
    double per_h;  ///< 1 / h [1/m]
    Vec2 origin;   ///< of the first ghost node [m]
    std::int32_t columns;
    std::int32_t rows;
    Vec2 low;  ///< walls and floor; a point outside [low, high] has left the grid [m]
    Vec2 high;
    WallRows walls_x;
    WallRows walls_y;
    std::vector<std::uint8_t> conditions;  ///< per node
    std::vector<double> friction;          ///< coefficient of the floor per column [-]
    std::optional<Terrain> terrain;
    std::vector<Contact> contacts;         ///< of nodes near the terrain
    std::vector<std::int32_t> contact_of;  ///< [nodes] index into contacts; empty without terrain

    // Scattered by particle_to_grid.
    std::vector<double> mass;  ///< [kg]
    /// After particle_to_grid: momentum [kg m/s] and internal force [N]. After update_momentum:
    /// velocity at the end of the step [m/s] and its change over the step [m/s].
    std::vector<Lane> motion;

    /// Nodes that points can reach before the next sort, ascending.
    std::vector<std::int32_t> active;

    std::int32_t nodes() const { return columns * rows; }
    // Coordinates in cells from the first ghost node: positive for every point of the grid, so that
    // truncation in cell() rounds down.
    double xi(double x) const { return (x - origin.x()) * per_h; }
    double eta(double y) const { return (y - origin.y()) * per_h; }
    /// Cell that contains (xi, eta): index of its lower left node.
    std::int32_t cell(double xi, double eta) const {
        return static_cast<std::int32_t>(xi) * rows + static_cast<std::int32_t>(eta);
    }
    /// The middle one of the 3 x 3 nodes of a point there.
    std::int32_t nearest_node(double xi, double eta) const {
        return cell(grid::nearest_whole(xi), grid::nearest_whole(eta));
    }
    bool holds(double x, double y) const {
        return x >= low.x() && x <= high.x() && y >= low.y() && y <= high.y();
    }
};

Grid make_grid(const scene::Mpm& mpm);

/// Resets the active nodes to zero for the next step.
void clear(Grid& grid);

}  // namespace breach::mpm
