// Writes the outputs of an analysis when they are due: telemetry, history, snapshots, checkpoints.
#pragma once

#include "fem_solver/course.hpp"

namespace breach::fem {

class Recorder {
  public:
    explicit Recorder(Course& course);

    /// Writes telemetry and snapshots that are due after a step.
    void take_step(double dt, const NewtonOutcome& outcome);
    void checkpoint();
    void checkpoint_when_due();
    /// Writes the last snapshot, which answers every open request, and the history.
    void finish();
    /// Saves the last good state (the accepted one, not the trial) and ends the run.
    [[noreturn]] void give_up(const std::string& cause);

  private:
    Reading read(double dt, const NewtonOutcome& outcome);
    void read_strength(Reading& reading) const;
    void write_telemetry(double dt, const NewtonOutcome& outcome, double slack);
    bool snapshot_is_due(double dt);
    void write_snapshot();

    Course& course_;
    const std::vector<Column> columns_;  ///< of telemetry and history
    double peak_energy_ = 0.0;           ///< largest kinetic energy of the history [J]
    double checkpoint_written_ = 0.0;    ///< wall clock [s]
    bool checkpoint_wanted_ = false;     ///< a requested snapshot was written since the last one
    double last_snapshot_ = -1.0;        ///< its time [s]
};

}  // namespace breach::fem
