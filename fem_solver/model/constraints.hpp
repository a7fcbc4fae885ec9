// The unknown displacements and pressures: nodes held by supports, nodes tied to each other, nodes
// with a prescribed pressure.
#pragma once

#include <vector>

#include "fem_solver/mesh/mesh.hpp"

namespace breach::fem {

/// Numbers of the unknowns, -1 where there is none: displacements first, then pressures. Nodes that
/// are tied share a number.
struct Unknowns {
    std::vector<std::int32_t> of_dof;       ///< [2 per node, x then y]
    std::vector<std::int32_t> of_pressure;  ///< [nodes]; empty when no pressure is unknown
    std::int32_t displacements = 0;
    std::int32_t count = 0;

    std::int32_t pressures() const { return count - displacements; }
};

/// Two tied nodes: the second moves with the first.
struct Tie {
    std::int32_t master;
    std::int32_t slave;
};

/// Supports and ties of the nodes. Ties may be chained; all of a chain end at one master.
struct Constraints {
    std::vector<bool> held;                     ///< [dofs] by a support
    std::vector<std::int32_t> master;           ///< [dofs] itself where nothing is tied
    std::vector<std::int32_t> pressure_master;  ///< [nodes]
    std::vector<bool> is_base;                  ///< [nodes] on an elastic base; empty: no base
};

/// The unknowns of a stage.
enum class Solved {
    displacement,               ///< statics: the base is held, pressures are known
    displacement_and_pressure,  ///< statics without drainage: the base is held
    motion_and_pressure,        ///< dynamics: the base is free in x
};

/// ties: in both directions of u. pressure_ties: in p. Throws BadInput when a support holds no
/// node, when nothing holds the body in x or y, or when a support and a tie claim the same node
/// above the base.
Constraints constraints_of(const scene::Fem& fem, const std::optional<scene::ElasticBase>& base,
                           const Mesh& mesh, const std::vector<Tie>& ties,
                           const std::vector<Tie>& pressure_ties);

/// Marks in `held` [dofs] what a support holds; returns how many of its nodes are not lonely.
std::size_t hold_nodes(const scene::Support& support, const Mesh& mesh,
                       const std::vector<bool>& lonely, std::vector<bool>& held);

/// Nodes on a segment, within a millionth of the shortest edge.
std::vector<std::size_t> nodes_on(const Mesh& mesh, const Vec2& from, const Vec2& to);

/// No support and no tie: every displacement of these nodes is its own.
Constraints unconstrained(std::size_t nodes);

/// The dof or node at the end of the chain of `i`.
std::int32_t root_of(const std::vector<std::int32_t>& masters, std::int32_t i);

/// Ties dof `slave`, and the dofs tied to it, to `master`.
void tie(std::vector<std::int32_t>& masters, std::int32_t master, std::int32_t slave);

/// pressure_is_unknown: [nodes], empty in dry soil.
Unknowns number_unknowns(const Constraints& constraints,
                         const std::vector<bool>& pressure_is_unknown, Solved solved);

}  // namespace breach::fem
