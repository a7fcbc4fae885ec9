#include "mpm_solver/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "mpm_solver/step.hpp"

namespace breach::mpm {

namespace {

double swing_of(const std::optional<GroundMotion>& ground) {
    return ground ? ground->largest_swing() : 0.0;
}

scene::Rest rest_on(const std::optional<GroundMotion>& ground, scene::Rest rest) {
    if (ground) rest.earliest = std::max(rest.earliest, ground->end());
    return rest;
}

}  // namespace

Simulation::Simulation(const scene::Scene& scene, Body body, double transfer_time,
                       std::optional<GroundMotion> ground)
    : Simulation(scene, std::move(body), Clock{.transfer_time = transfer_time}, Start{}, {},
                 std::move(ground)) {
    // The other constructor made the limits from an empty start, as if from a checkpoint.
    start_ = {energy_of(body_), volume_of(body_.points, view_.mobile),
              mean_x_of(body_.points, view_.mobile)};
    limits_ = limits_of(body_, mpm_, start_.energy, swing_of(ground_));
}

Simulation::Simulation(const scene::Scene& scene, Body body, Clock clock, Start start,
                       Records records, std::optional<GroundMotion> ground)
    : scene_(scene),
      mpm_(scene::mpm_of(scene)),
      body_(std::move(body)),
      clock_(clock),
      start_(start),
      records_(std::move(records)),
      ground_(std::move(ground)),
      rest_(rest_on(ground_, mpm_.rest)),
      view_(flow_view(scene, body_.grid)),
      overlap_(body_, scene.thickness),
      limits_(limits_of(body_, mpm_, start_.energy, swing_of(ground_))),
      last_good_(body_.points, clock.time, clock.step) {}

double Simulation::next_step() const {
    const double dt = mpm_.time_step ? *mpm_.time_step : courant_step(body_, mpm_.cfl);
    const double next_frame = static_cast<double>(clock_.frames) * mpm_.snapshot_interval;
    const double left = std::min(next_frame, mpm_.duration) - clock_.time;
    if (left <= 0.0 || dt < 0.5 * left) return dt;
    return dt < left ? 0.5 * left : left;  // two equal steps instead of a full one and a tiny one
}

void Simulation::advance() {
    if (mpm_.overlap_correction.rate > 0.0 && clock_.step % steps_between_marks == 0) {
        overlap_.mark(body_, mpm_.overlap_correction.tolerance);
    }
    if (mpm_.gap_closure && mpm_.gap_room && clock_.step % steps_between_marks == 0) {
        overlap_.hold_gaps_to_room(body_);
    }
    const double dt = next_step();
    if (ground_) body_.frame_acceleration = ground_->acceleration(clock_.time, dt);
    step(body_, dt);
    clock_.dt_min = clock_.step == 0 ? dt : std::min(clock_.dt_min, dt);
    clock_.dt_max = std::max(clock_.dt_max, dt);
    clock_.dt = dt;
    clock_.time += dt;
    ++clock_.step;
    // Summed time steps differ from round times by round-off; a frame's time is exact.
    const double next_frame = static_cast<double>(clock_.frames) * mpm_.snapshot_interval;
    if (std::abs(clock_.time - next_frame) < 1e-9 * dt) clock_.time = next_frame;
    // Before the samples, which take every point to be in the grid.
    if (const auto complaint = step_complaint(body_, limits_)) break_down(*complaint);
    if (clock_.step % steps_between_samples == 0) sample_envelope();
    if (clock_.step % steps_between_fluxes == 0) sample_momentum();
}

void Simulation::sample_envelope() {
    records_.envelope.see(clock_.time, without_grains(profile()), mpm_.arrival_depth);
}

void Simulation::sample_momentum() {
    sample_sections(mpm_.sections, body_, view_, clock_.time, records_.sections);
}

bool Simulation::frame_due() const {
    return clock_.time >= static_cast<double>(clock_.frames) * mpm_.snapshot_interval;
}

void Simulation::take_frame() {
    records_.profiles.add(clock_.time, profile());
    ++clock_.frames;
}

bool Simulation::look_due() const {
    return clock_.time >= static_cast<double>(clock_.looks) * mpm_.telemetry_interval;
}

const Row& Simulation::look() {
    const Energy now = energy_of(body_);
    const double toe_x = mpm_.runout.toe.x();
    const Runout runout = runout_of(body_.points, view_.mobile, toe_x);
    const double volume = volume_of(body_.points, view_.mobile);
    const double front = front_of(profile(), view_, mpm_.runout.front_depth);
    read_gauges(mpm_.gauges, body_.points, view_, records_.gauges);
    sample_envelope();
    sample_momentum();
    const double since = records_.history.empty() ? clock_.time : last_row().time;
    read_sections(mpm_.sections, body_.points, view_, clock_.time, since, records_.sections);
    const double numerical = numerical_loss(start_.energy, now);
    const double scale = scale_of_energy(now);
    records_.history.push_back(
        {.time = clock_.time,
         .step = static_cast<double>(clock_.step),
         .dt = clock_.dt,
         .runout = runout.all,
         .runout_beyond_toe = runout.beyond,
         .runout_beyond_toe_95 = runout.beyond_95,
         .runout_beyond_toe_50 = runout.beyond_50,
         .runout_largest = runout.largest,
         .runout_by_count = runout.all_by_count,
         .runout_front = front == nowhere ? nowhere : front - toe_x,
         .area_beyond_toe = runout.volume_beyond / scene_.thickness,
         .kinetic_energy = now.kinetic,
         .kinetic_mobile = kinetic_energy_of(body_.points, view_.mobile),
         .gravitational_energy = now.gravitational,
         .elastic_energy = now.elastic,
         .plastic_dissipation = now.plastic,
         .friction_dissipation = now.friction,
         .viscous_dissipation = now.viscous,
         .shaking_work = now.shaking,
         .energy_numerical = numerical,
         .energy_numerical_share = scale > 0.0 ? numerical / scale : 0.0,
         .volume_ratio = start_.mobile_volume > 0.0 ? volume / start_.mobile_volume : 1.0,
         .overlap = overlap_.measure(body_, view_.mobile),
         .overlap_energy = body_.tally.pushed_in,
         .fastest = body_.tally.fastest});
    const Row& row = last_row();
    if (const auto complaint = budget_complaint(limits_, start_.energy, now, row.volume_ratio)) {
        break_down(*complaint);
    }
    if (const auto complaint = ground_complaint(body_)) break_down(*complaint);
    moving_ = why_moving(records_.history, start_.energy, body_, view_.mobile, rest_);
    const double interval = mpm_.telemetry_interval;
    constexpr double most = 0x1p53;  // an interval of 1e-30 s would overflow the counter
    // From the time and not by adding one: a step longer than the interval skips measurements.
    const double looks = std::clamp(std::floor(clock_.time / interval) + 1.0, 0.0, most);
    clock_.looks = interval > 0.0 ? static_cast<std::int64_t>(looks) : 0;
    // Only now: a state that failed a check above is not good.
    last_good_.keep(body_.points, clock_.time, clock_.step);
    return row;
}

Course Simulation::course() const {
    // Rest first: a run that comes to rest in its last step has not run out of time.
    if (!moving_) return Course::rests;
    return clock_.time >= mpm_.duration ? Course::time_is_up : Course::goes_on;
}

double Simulation::scale_of_energy() const {
    const Energy now{.gravitational = last_row().gravitational_energy,
                     .shaking = last_row().shaking_work};
    return scale_of_energy(now);
}

double Simulation::scale_of_energy(const Energy& now) const {
    return energy_scale(rest_, released(start_.energy, now), mass_of(body_.points, view_.mobile));
}

exchange::ParticleState Simulation::stamped(const Points& points, double time,
                                            std::int64_t step) const {
    exchange::ParticleState state = particle_state(scene_, points);
    state.time = time;
    state.step = step;
    state.transfer_time = clock_.transfer_time;
    return state;
}

exchange::ParticleState Simulation::state() const {
    return stamped(body_.points, clock_.time, clock_.step);
}

exchange::ParticleState Simulation::last_good_state() const {
    return stamped(last_good_.restored(body_.points), last_good_.time(), last_good_.step());
}

void Simulation::break_down(const std::string& complaint) const {
    std::ostringstream text;
    text << "numerical breakdown at t = " << clock_.time << " s (step " << clock_.step
         << "): " << complaint;
    throw fault::Breakdown(text.str());
}

}  // namespace breach::mpm
