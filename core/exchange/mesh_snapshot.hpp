// The FEM's whole state at one time: mesh, nodal and Gauss fields. File: VTKHDF
// UnstructuredGrid 1.0 (nodes at their displaced places, cell data = Gauss averages) with the Gauss
// fields in the group /breachline beside it.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/exchange/base_motion.hpp"
#include "core/exchange/provenance.hpp"
#include "core/mechanics/tensor.hpp"

namespace breach::exchange {

struct MeshSnapshot {
    double time = 0.0;       ///< [s] since the first dynamic stage began
    std::int64_t step = 0;   ///< time step number
    double thickness = 1.0;  ///< [m]

    std::vector<std::string> regions;               ///< names, by region index
    std::vector<std::string> materials_of_regions;  ///< material name of each region

    // nodes [n_nodes]
    std::vector<mechanics::Vec2> position_0;    ///< undeformed [m]
    std::vector<mechanics::Vec2> displacement;  ///< since the first dynamic stage began [m]
    std::vector<mechanics::Vec2> velocity;      ///< [m/s]
    std::vector<mechanics::Vec2> acceleration;  ///< [m/s2]
    std::vector<double> nodal_mass;             ///< lumped, for the ledger [kg]
    std::vector<double> pore_pressure;          ///< u [Pa]; empty in a scene without water
    /// Vertical effective stress of the ground before the shaking, that is when the first dynamic
    /// stage begins, and the pore pressure then; compression positive [Pa]. Both or none; a FEM with
    /// water writes them, averaged from its Gauss points to the nodes, for r_u = (u - u_0) /
    /// sigma'_v0. Without them no soil counts as liquefied.
    std::vector<double> sigma_v0;
    std::vector<double> pore_pressure_0;
    /// Largest excess pressure of each node since then [Pa], from nodal_excess_pressure at each
    /// step. May be empty although there is u_0: then only the snapshot's own time is known.
    std::vector<double> excess_pressure_max;

    // elements [n_elements]
    std::vector<std::array<std::int32_t, 4>> quads;  ///< corners counter-clockwise
    std::vector<std::int32_t> region_of_element;
    std::vector<double> density;  ///< undeformed mass density [kg/m3]

    // Gauss points [n_elements * gauss_per_element], element by element, in the order of
    // gauss_positions
    int gauss_per_element = 4;
    /// Natural coordinates (xi, eta) of each, [gauss_per_element]
    std::vector<mechanics::Vec2> gauss_positions;
    std::vector<mechanics::Voigt> stress;   ///< effective [Pa], tension positive
    std::vector<mechanics::Voigt> strain;   ///< total, since the first dynamic stage began [-]
    std::vector<double> epsilon_q;          ///< sqrt(2/3 e:e) of that total strain [-]
    std::vector<double> epsilon_q_plastic;  ///< accumulated by the law [-]
    /// State parameter and stress ratio over the limiting one; 0 at points whose law has none. Both
    /// or none.
    std::vector<double> psi;
    std::vector<double> instability_ratio;

    BaseMotion base_motion;  ///< of the whole earthquake, after `time` too
};

void write_mesh_snapshot(const std::filesystem::path& path, const MeshSnapshot& snapshot,
                         const Provenance& provenance);

struct MeshSnapshotFile {
    MeshSnapshot snapshot;
    Provenance provenance;
};
/// Throws BadInput (truncated, wrong kind or version, missing or misshapen dataset, non-finite
/// value, checksum: each named by its dataset path) or IoError (the file is missing or cannot be
/// opened).
MeshSnapshotFile read_mesh_snapshot(const std::filesystem::path& path);

}  // namespace breach::exchange
