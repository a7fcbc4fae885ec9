// The FEM's whole state at one time: mesh, nodal and Gauss fields. File: VTKHDF UnstructuredGrid
// 1.0 (displaced nodes, cell data = averages over Gauss points) and the Gauss fields in the group
// /breachline.
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
    /// Before the shaking, when the first dynamic stage begins: vertical effective stress and pore
    /// pressure at the nodes, averaged from Gauss points; compression positive [Pa]. For r_u = (u -
    /// u_0) / sigma'_v0. A FEM with water writes both, any other none; without them no soil counts
    /// as liquefied.
    std::vector<double> sigma_v0;
    std::vector<double> pore_pressure_0;
    /// Largest excess pressure of each node since the shaking began [Pa], from
    /// nodal_excess_pressure in every step. May be empty although pore_pressure_0 is not; then use
    /// the present value.
    std::vector<double> excess_pressure_max;

    // elements [n_elements]
    std::vector<std::array<std::int32_t, 4>> quads;  ///< corners counter-clockwise
    std::vector<std::int32_t> region_of_element;
    std::vector<double> density;  ///< undeformed mass density [kg/m3]

    // Gauss points [n_elements * gauss_per_element], element by element, in the order of
    // gauss_positions
    int gauss_per_element = 4;
    /// Natural coordinates (xi, eta), [gauss_per_element].
    std::vector<mechanics::Vec2> gauss_positions;
    std::vector<mechanics::Voigt> stress;   ///< effective [Pa], tension positive
    std::vector<mechanics::Voigt> strain;   ///< total, since the first dynamic stage began [-]
    std::vector<double> epsilon_q;          ///< sqrt(2/3 e:e) of that total strain [-]
    std::vector<double> epsilon_q_plastic;  ///< accumulated by the law [-]
    /// State parameter psi, and eta / eta_L; 0 at points whose law has none. Both or neither.
    std::vector<double> psi;
    std::vector<double> instability_ratio;

    /// Largest r_u and largest engineering shear strain in the plane since the shaking began; with
    /// excess_pressure_max, both or neither [-].
    std::vector<double> r_u_max;
    std::vector<double> shear_strain_max;

    BaseMotion base_motion;  ///< of the whole earthquake, also after `time`
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
