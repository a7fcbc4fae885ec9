// The complete state of an analysis, from which it can be resumed exactly, and its file.
#pragma once

#include <cstdint>
#include <filesystem>

#include "core/fault/flag.hpp"
#include "fem_solver/monitors/monitors.hpp"
#include "fem_solver/solve/beginning.hpp"
#include "fem_solver/solve/newton.hpp"

namespace breach::fem {

/// Progress of the analysis.
struct Position {
    std::int64_t stage = 0;
    double load = 0.0;            ///< static stage: share of gravity in place [-]
    double load_step = 1.0;       ///< static stage: share applied per step [-]
    double time = 0.0;            ///< since the first dynamic stage began [s]
    double dt = 0.0;              ///< wanted time step now [s]; 0: the stage's own
    std::int64_t easy_steps = 0;  ///< in a row
    std::int64_t step = 0;
    std::int64_t cut_steps = 0;
    std::int64_t next_snapshot = 0;
    double next_telemetry = 0.0;       ///< [s]
    double external_work = 0.0;        ///< [J]
    double internal_work = 0.0;        ///< [J]
    double viscous_dissipation = 0.0;  ///< [J]
    std::int64_t telemetry_lines = 0;
    bool stage_begun = false;  ///< the stage's laws are in force
    bool moving = false;       ///< a dynamic stage has begun
    bool at_limit = false;     ///< static stage: the pressure on an edge is at its limit state
};

/// The data beside the matrix that a resumed analysis needs.
struct Kept {
    Position position;
    Motion motion;
    Beginning beginning;
    std::vector<double> excess_pressure_max;  ///< since the first dynamic stage began, per node of
                                              ///< the body; empty when dry [Pa]
    Eigen::VectorXd stage_force;  ///< internal force when the static stage began; of a dynamic one
                                  ///< with a ramp what it withholds [N]
    NewtonCounts counts;          ///< until the matrix was last needed
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
/// Progress of the archived analysis. Throws BadInput when it belongs to another scene.
Position position_in(const exchange::Archive& archive, const scene::Scene& scene,
                     const std::string& file);
/// model: for the stage of that position. Throws BadInput when the archive belongs to another scene or mesh, or is incomplete.
Checkpoint checkpoint_from(const exchange::Archive& archive, const scene::Scene& scene,
                           const Model& model, const std::string& file);

/// The flags that the run has raised so far.
void put_flags(const std::vector<fault::Flag>& flags, exchange::Archive& archive);
/// An archive from before there were flags has none. Throws BadInput when they cannot be read.
std::vector<fault::Flag> flags_in(const exchange::Archive& archive, const std::string& file);

inline constexpr const char* checkpoint_kind = "fem_checkpoint";
inline constexpr int checkpoint_version = 8;

}  // namespace breach::fem
