// CPU time of a run: seconds by kind of work, and the table that --profile prints.
// Stopwatches are always on: result.json has the seconds of each run.
#pragma once

#include <cstdint>
#include <string>

namespace breach::fem {

/// Prints the table below on stdout, or to the log if stdout has JSON lines.
inline constexpr const char* profile_switch = "--profile";

using Clock = double (*)();  ///< [s], arbitrary origin
/// 0.1 us per call, also used without --profile.
double wall_clock();

/// Seconds spent per kind of work.
struct Seconds {
    double assembly = 0.0;  ///< strains, forces, residuals, matrices, mesh distortion
    double law = 0.0;
    double factor = 0.0;  ///< pattern and factors of the matrix
    double solve = 0.0;   ///< back substitution and acceleration
    double output = 0.0;  ///< monitors, snapshots, checkpoints
    Clock clock = wall_clock;

    double sum() const { return assembly + law + factor + solve + output; }
};

/// Adds its lifetime to one kind of work.
class Stopwatch {
  public:
    Stopwatch(Seconds& seconds, double Seconds::*kind)
        : clock_(seconds.clock), total_(seconds.*kind), began_(clock_()) {}
    ~Stopwatch() { total_ += clock_() - began_; }
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;

  private:
    Clock clock_;
    double& total_;
    double began_;
};

/// Work done in those seconds by this process; a resumed run counts from its checkpoint.
struct Work {
    std::int64_t steps = 0;  ///< tried, including rejected ones
    std::int64_t iterations = 0;
};

/// A table: CPU seconds and share by kind, the rest as "other" (reading, meshing, prediction), and
/// per step. whole: CPU seconds of the process.
std::string profile_text(const Seconds& seconds, double whole, const Work& work);

}  // namespace breach::fem
