// Cost of a step: that of ten, operation by operation.
// Called for --plan --measure. It repeats the order of step() to time each operation: a change
// there belongs here, too.
#include "mpm_solver/begin.hpp"
#include "mpm_solver/run.hpp"
#include "mpm_solver/simulation.hpp"
#include "mpm_solver/step.hpp"

namespace breach::mpm {

namespace {

constexpr std::int64_t steps_of_trial = 10;

/// CPU seconds of each kind of work.
class Laps {
  public:
    template <class Work>
    void time(const char* kind, Work&& work) {
        const double began = process::Session::cpu_seconds();
        work();
        const double spent = process::Session::cpu_seconds() - began;
        for (auto& [known, seconds] : spent_) {
            if (known == kind) {
                seconds += spent;
                return;
            }
        }
        spent_.emplace_back(kind, spent);
    }
    const std::vector<std::pair<std::string, double>>& spent() const { return spent_; }

  private:
    std::vector<std::pair<std::string, double>> spent_;
};

/// What Simulation::advance does before the step, and the operations of step.cpp in their order.
void timed_step(Body& body, const scene::Mpm& mpm, OverlapMeter& overlap, std::int64_t number,
                Laps& laps) {
    if (number % steps_between_marks == 0) {
        if (mpm.overlap_correction.rate > 0.0)
            laps.time("overlap correction's marks",
                      [&] { overlap.mark(body, mpm.overlap_correction.tolerance); });
        if (mpm.gap_closure && mpm.gap_room)
            laps.time("gaps held to their room", [&] { overlap.hold_gaps_to_room(body); });
    }
    const double dt = mpm.time_step ? *mpm.time_step : courant_step(body, mpm.cfl);
    // dt is that of Simulation::next_step, but without its ends at snapshots.
    laps.time("sorting and clearing", [&] { keep_sorted(body), clear(body.grid); });
    laps.time("particle to grid", [&] { particle_to_grid(body, dt); });
    laps.time("momentum, floor and terrain", [&] { update_momentum(body, dt); });
    laps.time("grid to particle", [&] { grid_to_particle(body, dt); });
    laps.time("strain and law", [&] { update_stress(body, dt); });
}

template <class T>
double bytes(const std::vector<T>& values) {
    return static_cast<double>(values.capacity() * sizeof(T));
}

double bytes_of(const Points& points) {
    double sum = bytes(points.cell);
    for (const auto& real : reals_of_points<Reals>) sum += bytes(points.*real.array);
    for_each_integer(points, [&](const char*, const auto& values) { sum += bytes(values); });
    return sum;
}

double bytes_of(const Grid& grid) {
    return bytes(grid.conditions) + bytes(grid.contacts) + bytes(grid.contact_of) +
           bytes(grid.mass) + bytes(grid.motion) + bytes(grid.active);
}

}  // namespace

process::Cost measure(process::Session& session) {
    const scene::Scene& scene = session.scene();
    const scene::Mpm& mpm = scene::mpm_of(scene);
    Begun begun = begin(session);
    Body& body = begun.body;
    OverlapMeter overlap(body, scene.thickness);
    Laps laps;
    for (std::int64_t k = 0; k < steps_of_trial; ++k) timed_step(body, mpm, overlap, k, laps);
    process::Cost cost;
    cost.steps = steps_of_trial;
    cost.seconds = laps.spent();
    cost.counts = {{"points", static_cast<std::int64_t>(body.points.size())},
                   {"nodes of the grid", body.grid.nodes()},
                   {"nodes in use", static_cast<std::int64_t>(body.grid.active.size())}};
    double averages = 0.0;
    for (const std::vector<CellSum>& sums : body.averages) averages += bytes(sums);
    cost.memory = {{"points", bytes_of(body.points)},
                   {"grid", bytes_of(body.grid)},
                   {"anti-locking's cells", averages}};
    const double dt = mpm.time_step ? *mpm.time_step : courant_step(body, mpm.cfl);
    Simulation simulation(scene, std::move(body), begun.transfer_time, std::move(begun.ground));
    Laps looking;
    looking.time("telemetry", [&] { simulation.look(); });
    const double looks_per_step =
        mpm.telemetry_interval > 0.0 ? std::min(dt / mpm.telemetry_interval, 1.0) : 1.0;
    const auto steps = static_cast<double>(steps_of_trial);
    cost.seconds.emplace_back("telemetry and gauges",
                              looking.spent()[0].second * looks_per_step * steps);
    return cost;
}

}  // namespace breach::mpm
