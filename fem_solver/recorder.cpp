#include "fem_solver/recorder.hpp"

#include <algorithm>
#include <cmath>

#include "core/phases/files.hpp"
#include "fem_solver/facts.hpp"
#include "fem_solver/monitors/strength.hpp"
#include "fem_solver/monitors/viscous_share.hpp"
#include "fem_solver/snapshot.hpp"
#include "fem_solver/snapshot_request.hpp"

namespace breach::fem {

namespace {

constexpr double checkpoint_interval = 20.0;  // wall clock [s]

/// Whole intervals up to a time, with tolerance for round-off.
double intervals_until(double time, double interval) { return std::floor(time / interval + 1e-9); }

}  // namespace

Recorder::Recorder(Course& course) : course_(course), columns_(columns_of(course.session.scene())) {
    // A resumed run continues with the peak of its history.
    for (const Reading& each : course.history)
        peak_energy_ = std::max(peak_energy_, each.kinetic_energy);
}

void Recorder::take_step(double dt, const NewtonOutcome& outcome) {
    const Position& position = course_.position;
    if (position.moving) {
        course_.crest_time.push_back(position.time);
        course_.crest_acceleration.push_back(
            course_.motion.a[2 * static_cast<Eigen::Index>(course_.crest_node)]);
    }
    const double slack = 1e-9 * std::max(course_.fem.telemetry_interval, course_.span);
    if (position.time >= position.next_telemetry - slack) write_telemetry(dt, outcome, slack);
    // Telemetry first: a program that waits for the snapshot finds its row.
    if (!snapshot_is_due(dt)) return;
    write_snapshot();
    answer_request(course_.session.settings().output);
}

void Recorder::write_telemetry(double dt, const NewtonOutcome& outcome, double slack) {
    const Stopwatch watch(course_.seconds, &Seconds::output);
    Position& position = course_.position;
    course_.history.push_back(read(dt, outcome));
    course_.session.telemetry(telemetry_line(course_.history.back(), columns_));
    position.telemetry_lines = course_.session.telemetry_lines();
    const double interval = course_.fem.telemetry_interval;
    // A multiple of the interval and not the last row's time plus it: rows do not drift.
    position.next_telemetry =
        interval > 0.0 ? interval * (std::floor((position.time + slack) / interval) + 1.0)
                       : position.time;
}

Reading Recorder::read(double dt, const NewtonOutcome& outcome) {
    const Position& position = course_.position;
    Reading reading = read_monitors(course_.model, course_.motion, course_.distortion,
                                    course_.crest_node, course_.fem.strain_threshold);
    course_.watch.read(course_.model, course_.motion, course_.beginning, reading);
    reading.step = static_cast<double>(position.step);
    reading.time = position.time;
    reading.dt = dt;
    reading.iterations = outcome.iterations;
    reading.residual = outcome.residual;
    reading.external_work = position.external_work;
    reading.internal_work = position.internal_work;
    reading.viscous_dissipation = position.viscous_dissipation;
    read_strength(reading);
    reading.viscous_share =
        viscous_share(course_.model, course_.motion, course_.fem.failure_strain);
    peak_energy_ = std::max(peak_energy_, reading.kinetic_energy);
    reading.kinetic_energy_over_peak =  // 1 before any motion
        peak_energy_ > 0.0 ? reading.kinetic_energy / peak_energy_ : 1.0;
    return reading;
}

/// Computed at the first row at or after each multiple of its interval; in between the last value.
void Recorder::read_strength(Reading& reading) const {
    const std::optional<double>& interval = course_.fem.strength_interval;
    if (!interval) return;
    if (!course_.history.empty()) {
        const Reading& last = course_.history.back();
        if (intervals_until(reading.time, *interval) == intervals_until(last.time, *interval)) {
            reading.strength_ratio_avg = last.strength_ratio_avg;
            reading.strength_ratio_min = last.strength_ratio_min;
            return;
        }
    }
    const StrengthRatio ratio = strength_ratio(course_.model, course_.motion, course_.beginning);
    reading.strength_ratio_avg = ratio.average;
    reading.strength_ratio_min = ratio.least;
}

/// Due if a requested time is reached, the step contains a multiple of the interval, or another
/// program requests one. The last two do not change the step.
bool Recorder::snapshot_is_due(double dt) {
    Position& position = course_.position;
    const auto& times = course_.decided.snapshot_times.value;
    const auto next = static_cast<std::size_t>(position.next_snapshot);
    const bool wanted = next < times.size() && position.time >= times[next];
    if (wanted) ++position.next_snapshot;
    checkpoint_wanted_ = checkpoint_wanted_ || wanted;
    const double interval = course_.decided.snapshot_interval.value;
    const bool regular = interval > 0.0 && intervals_until(position.time, interval) >
                                               intervals_until(position.time - dt, interval);
    // Also when another snapshot is due: that one answers the request.
    const bool asked = dt > 0.0 && request_is_taken(course_.session.settings().output);
    return wanted || regular || asked;
}

void Recorder::write_snapshot() {
    const Stopwatch watch(course_.seconds, &Seconds::output);
    process::Session& session = course_.session;
    const double time = course_.position.time;
    const std::string name = snapshot_name(time);
    exchange::write_mesh_snapshot(
        session.output(name),
        snapshot_of(session.scene(), course_.model, course_.motion, course_.beginning,
                    course_.largest, time, course_.position.step),
        session.provenance());
    session.announce_frame(name, phases::files::snapshot_prefix, time);
    last_snapshot_ = time;
}

void Recorder::checkpoint() {
    course_.write_checkpoint();
    checkpoint_written_ = course_.session.wall_seconds();
    checkpoint_wanted_ = false;
}

void Recorder::checkpoint_when_due() {
    if (checkpoint_wanted_ ||
        course_.session.wall_seconds() - checkpoint_written_ >= checkpoint_interval)
        checkpoint();
}

void Recorder::finish() {
    process::Session& session = course_.session;
    // The last state is always there: a transfer may want it, and it shows where a breakdown began.
    if (last_snapshot_ != course_.position.time) write_snapshot();
    // A request after the last step would wait without end: the last snapshot answers it.
    if (request_is_taken(session.settings().output)) answer_request(session.settings().output);
    const Stopwatch watch(course_.seconds, &Seconds::output);
    exchange::write_archive(session.output(phases::files::history),
                            history_archive(course_.history, columns_), session.provenance());
}

void Recorder::give_up(const std::string& cause) {
    finish();
    checkpoint();
    print_profile(course_);
    const double time = course_.position.time;
    throw fault::Breakdown(cause + "; the last good state is at " + std::to_string(time) +
                           " s in " + snapshot_name(time));
}

}  // namespace breach::fem
