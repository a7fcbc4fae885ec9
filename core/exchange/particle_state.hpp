// All material points at one time, as structure of arrays. File: VTKHDF UnstructuredGrid 1.0 of
// vertices.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/exchange/ledger.hpp"
#include "core/exchange/provenance.hpp"
#include "core/mechanics/tensor.hpp"

namespace breach::exchange {

struct ParticleState {
    double time = 0.0;           ///< [s] on the MPM's clock; 0 at the transfer
    double transfer_time = 0.0;  ///< t_T [s] on the FEM's clock
    std::int64_t step = 0;
    double thickness = 1.0;  ///< [m]

    std::vector<std::string> regions;               ///< names, by region index
    std::vector<std::string> materials_of_regions;  ///< material name of each region

    // [n_particles]
    std::vector<mechanics::Vec2> position;  ///< [m]
    std::vector<mechanics::Vec2> velocity;  ///< [m/s]
    std::vector<mechanics::Matrix2>
        velocity_gradient;                  ///< rows: component, columns: direction [1/s]
    std::vector<double> mass;               ///< [kg] for `thickness`
    std::vector<double> volume_0;           ///< at zero mean stress, the law's reference [m3]
    std::vector<double> volume;             ///< [m3]
    std::vector<mechanics::Voigt> stress;   ///< effective [Pa], tension positive
    std::vector<double> epsilon_q;          ///< total, sqrt(2/3 e:e) accumulated [-]
    std::vector<double> epsilon_q_plastic;  ///< what drives softening [-]
    std::vector<double> gap;                ///< volume strain still to be closed after tension [-]
    std::vector<std::int32_t> region;

    std::size_t size() const { return position.size(); }
};

/// `ledger`: what the transfer kept and lost; only the transfer gives one.
void write_particle_state(const std::filesystem::path& path, const ParticleState& state,
                          const Provenance& provenance, const Ledger& ledger = {});

struct ParticleStateFile {
    ParticleState state;
    Provenance provenance;
    Ledger ledger;  ///< empty unless the transfer wrote the file
};
/// Throws BadInput or IoError as read_mesh_snapshot does.
ParticleStateFile read_particle_state(const std::filesystem::path& path);

}  // namespace breach::exchange
