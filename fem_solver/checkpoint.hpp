// The complete state of an analysis, for an exact restart, and its file.
// Recorder writes it every 20 s, after a snapshot of /fem/snapshot_times and at a stop;
// Course::resume loads it. The assembled matrix is part of it: a factorisation is kept over many
// steps, and another one would change the last digits.
#pragma once

#include <cstdint>
#include <filesystem>

#include "core/fault/flag.hpp"
#include "fem_solver/monitors/monitors.hpp"
#include "fem_solver/solve/largest.hpp"
#include "fem_solver/solve/newton.hpp"

namespace breach::fem {

/// Progress of the analysis.
struct Position {
    std::int64_t stage = 0;
    double load = 0.0;            ///< static stage: applied share of gravity [-]
    double load_step = 1.0;       ///< static stage: share per step [-]
    double time = 0.0;            ///< since the beginning of the first dynamic stage [s]
    double dt = 0.0;              ///< present time step [s]; 0: the stage's
    std::int64_t easy_steps = 0;  ///< successive steps with fast convergence
    std::int64_t step = 0;
    std::int64_t cut_steps = 0;
    std::int64_t next_snapshot = 0;
    double next_telemetry = 0.0;       ///< [s]
    double external_work = 0.0;        ///< [J]
    double internal_work = 0.0;        ///< [J]
    double viscous_dissipation = 0.0;  ///< [J]
    std::int64_t telemetry_lines = 0;
    bool stage_begun = false;  ///< the stage's laws are in use
    bool moving = false;       ///< a dynamic stage has begun
    bool at_limit = false;     ///< static stage: an edge pressure has reached its limit state
};

/// Data besides the matrix that a resumed analysis needs.
/// Course is a Kept: a member that must survive a restart belongs here and into checkpoint.cpp.
struct Kept {
    Position position;
    Motion motion;
    Beginning beginning;
    Largest largest;
    /// static stage: internal force at its beginning; dynamic stage with a ramp: withheld force [N]
    Eigen::VectorXd stage_force;
    NewtonCounts counts;  ///< up to the last use of the matrix
    std::vector<Reading> history;
    /// Horizontal acceleration at the crest after each dynamic step.
    std::vector<double> crest_time, crest_acceleration;  ///< [s], [m/s2]
};

struct Checkpoint {
    Kept kept;
    NewtonMemory newton;
};

exchange::Archive checkpoint_archive(const Kept& kept, const NewtonMemory& newton,
                                     const scene::Scene& scene);
/// Position of the archived analysis. Throws BadInput if it belongs to another scene.
Position position_in(const exchange::Archive& archive, const scene::Scene& scene,
                     const std::string& file);
/// model: that of the position's stage. Throws BadInput if the archive belongs to another scene or
/// mesh, or is incomplete.
Checkpoint checkpoint_from(const exchange::Archive& archive, const scene::Scene& scene,
                           const Model& model, const std::string& file);

void put_flags(const std::vector<fault::Flag>& flags, exchange::Archive& archive);
/// Archives of older versions have none. Throws BadInput if the flags cannot be read.
std::vector<fault::Flag> flags_in(const exchange::Archive& archive, const std::string& file);

inline constexpr const char* checkpoint_kind = "fem_checkpoint";
/// Raise it when arrays are added, removed or reordered: older checkpoints are then refused.
inline constexpr int checkpoint_version = 9;

}  // namespace breach::fem
