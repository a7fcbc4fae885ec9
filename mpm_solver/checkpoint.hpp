// checkpoint.h5: the complete state of a run; a resumed run continues with the same bits.
// run.cpp writes it at intervals and when a stop is requested, --resume loads it, and a finished
// run removes it.
#pragma once

#include <filesystem>

#include "mpm_solver/simulation.hpp"

namespace breach::mpm {

/// Raise it when arrays are added, removed or change their meaning: older checkpoints are then
/// refused.
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
