// The unknown displacements and pressures: supported nodes, tied nodes, nodes with prescribed
// pressure.
#pragma once

#include <vector>

#include "fem_solver/mesh/mesh.hpp"

namespace breach::fem {

/// Numbers of the unknowns, -1 if not unknown: displacements first, then pressures. Tied nodes
/// share a number.
/// Static stages, undrained ones and dynamic ones number differently (Solved); each stage's Newton
/// has its own.
struct Unknowns {
    std::vector<std::int32_t> of_dof;       ///< [2 per node, x then y]
    std::vector<std::int32_t> of_pressure;  ///< [nodes]; empty if no pressure is unknown
    std::int32_t displacements = 0;
    std::int32_t count = 0;

    std::int32_t pressures() const { return count - displacements; }
};

/// Two tied nodes: the second follows the first.
struct Tie {
    std::int32_t master;
    std::int32_t slave;
};

/// Supports and ties of the nodes. All nodes of a chain of ties have the same master.
/// Of the whole mesh with its columns. set_stage changes `held` when soil or supports change; ties
/// stay.
struct Constraints {
    std::vector<bool> held;                     ///< [dofs] by a support
    std::vector<std::int32_t> master;           ///< [dofs] itself if not tied
    std::vector<std::int32_t> pressure_master;  ///< [nodes]
    std::vector<bool> is_base;                  ///< [nodes] on an elastic base; empty: no base
};

/// Unknowns of a stage.
enum class Solved {
    displacement,               ///< statics: base fixed, pressures known
    displacement_and_pressure,  ///< undrained statics: base fixed
    motion_and_pressure,        ///< dynamics: the base is free in x
};

/// ties: of both displacements; pressure_ties: of pressures. Throws BadInput if a support contains
/// no node, nothing supports an unchanging body in x or y, or a node above the base is both
/// supported and tied.
Constraints constraints_of(const scene::Fem& fem, const std::optional<scene::ElasticBase>& base,
                           const Mesh& mesh, const std::vector<Tie>& ties,
                           const std::vector<Tie>& pressure_ties);

/// Marks the supported dofs in `held`; returns the number of its nodes that are not lonely.
std::size_t hold_nodes(const scene::Support& support, const Mesh& mesh,
                       const std::vector<bool>& lonely, std::vector<bool>& held);

/// Nodes on a segment, within a millionth of the shortest edge.
std::vector<std::size_t> nodes_on(const Mesh& mesh, const Vec2& from, const Vec2& to);

/// No supports and no ties.
Constraints unconstrained(std::size_t nodes);

/// The master of `i`.
std::int32_t root_of(const std::vector<std::int32_t>& masters, std::int32_t i);

/// Ties dof `slave`, and those tied to it, to `master`.
void tie(std::vector<std::int32_t>& masters, std::int32_t master, std::int32_t slave);

/// pressure_is_unknown: [nodes], empty if dry.
Unknowns number_unknowns(const Constraints& constraints,
                         const std::vector<bool>& pressure_is_unknown, Solved solved);

}  // namespace breach::fem
