// checkpoint.h5: the complete state of a run; a resumed run continues with the same bits.
#pragma once

#include <filesystem>

#include "mpm_solver/simulation.hpp"

namespace breach::mpm {

inline constexpr int checkpoint_version = 9;

void save_checkpoint(const std::filesystem::path& file, const Simulation& simulation,
                     std::int64_t telemetry_lines, const exchange::Provenance& provenance);

struct Resumed {
    Simulation simulation;
    std::int64_t telemetry_lines;
    exchange::Spent spent;
};

/// Throws BadInput if the checkpoint belongs to another scene or input, or is damaged.
Resumed load_checkpoint(const std::filesystem::path& file, const scene::Scene& scene,
                        const exchange::Provenance& provenance, const Computing& computing = {});

}  // namespace breach::mpm
