// Writes the outputs of an analysis when due: telemetry, history, snapshots, checkpoints.
// Made by analyse() and called by the stages after each accepted step. Telemetry, snapshots and
// checkpoints are written here alone.
#pragma once

#include "fem_solver/course.hpp"

namespace breach::fem {

class Recorder {
  public:
    explicit Recorder(Course& course);

    /// Writes telemetry and snapshots due after a step.
    void take_step(double dt, const NewtonOutcome& outcome);
    void checkpoint();
    void checkpoint_when_due();
    /// Writes the history and the last snapshot, which also answers open requests.
    void finish();
    /// Saves the last accepted state and throws Breakdown.
    [[noreturn]] void give_up(const std::string& cause);

  private:
    Reading read(double dt, const NewtonOutcome& outcome);
    void read_strength(Reading& reading) const;
    void write_telemetry(double dt, const NewtonOutcome& outcome, double slack);
    bool snapshot_is_due(double dt);
    void write_snapshot();

    Course& course_;
    const std::vector<Column> columns_;  ///< of telemetry and history
    double peak_energy_ = 0.0;           ///< maximum so far [J]
    double checkpoint_written_ = 0.0;    ///< wall clock [s]
    /// a requested snapshot was written since the last checkpoint
    bool checkpoint_wanted_ = false;
    double last_snapshot_ = -1.0;  ///< time [s]
};

}  // namespace breach::fem
