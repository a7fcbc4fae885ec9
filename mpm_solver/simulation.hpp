// A run as a sequence of time steps: when to measure, write and stop. A checkpoint stores one
// Simulation.
// run.cpp drives it: advance() until a measurement or a frame is due, look() or take_frame(), and
// course() for the end. Nothing here writes files.
#pragma once

#include "core/process/session.hpp"
#include "mpm_solver/body/body.hpp"
#include "mpm_solver/body/ground_motion.hpp"
#include "mpm_solver/last_good.hpp"
#include "mpm_solver/measure/energy.hpp"
#include "mpm_solver/measure/envelope.hpp"
#include "mpm_solver/measure/gauges.hpp"
#include "mpm_solver/measure/guard.hpp"
#include "mpm_solver/measure/history.hpp"
#include "mpm_solver/measure/overlap.hpp"
#include "mpm_solver/measure/rest.hpp"
#include "mpm_solver/measure/runout.hpp"
#include "mpm_solver/measure/sections.hpp"

namespace breach::mpm {

struct Clock {
    double time = 0.0;  ///< [s]
    double dt = 0.0;    ///< last step [s]
    double dt_min = 0.0;
    double dt_max = 0.0;
    std::int64_t step = 0;
    std::int64_t frames = 0;     ///< snapshots written so far
    std::int64_t looks = 0;      ///< telemetry lines so far
    double transfer_time = 0.0;  ///< on the FEM's clock [s]
};

/// Reference values at the start.
struct Start {
    Energy energy;
    double mobile_volume = 0.0;  ///< [m3]
    double mobile_x = 0.0;       ///< mean over the mobile mass [m]
};

/// Records of a run.
struct Records {
    History history;
    GaugeRecords gauges;
    Profiles profiles;  ///< one per snapshot
    Envelope envelope;
    SectionRecords sections;
};

/// look() alone decides on rests, so a run ends at a measurement; time_is_up follows from the clock
/// if the last measurement found soil in motion.
enum class Course { goes_on, rests, time_is_up };

class Simulation {
  public:
    /// `body` at time 0; its velocities are relative to the ground, moving or at rest.
    Simulation(const scene::Scene& scene, Body body, double transfer_time,
               std::optional<GroundMotion> ground = {});
    /// From a checkpoint.
    Simulation(const scene::Scene& scene, Body body, Clock clock, Start start, Records records,
               std::optional<GroundMotion> ground);

    /// One step; ends at most at the next snapshot or the end. Throws Breakdown.
    void advance();
    /// Whether a snapshot (or a measurement) is due.
    bool frame_due() const;
    bool look_due() const;
    /// Stores the profile of a snapshot.
    void take_frame();
    /// Measures, checks the budget (throws Breakdown) and adds a row to the history.
    const Row& look();
    Course course() const;
    /// Why the soil moved at the last measurement; empty: at rest.
    const std::optional<std::string>& moving() const { return moving_; }
    /// Reference energy at the end (energy_scale) [J].
    double scale_of_energy() const;

    const Body& body() const { return body_; }
    const Clock& clock() const { return clock_; }
    const Start& start() const { return start_; }
    /// None: the ground is at rest.
    const std::optional<GroundMotion>& ground() const { return ground_; }
    /// Conditions of rest; never fulfilled while the ground shakes.
    const scene::Rest& rest() const { return rest_; }
    const Records& records() const { return records_; }
    const Row& last_row() const { return records_.history.back(); }
    std::vector<Flow> profile() const { return flow_profile(body_.points, view_); }
    const FlowView& view() const { return view_; }
    const std::vector<scene::Gauge>& gauges() const { return mpm_.gauges; }
    const std::vector<scene::FlowSection>& sections() const { return mpm_.sections; }
    /// The points now, and at the last measurement without a fault.
    exchange::ParticleState state() const;
    exchange::ParticleState last_good_state() const;

  private:
    double scale_of_energy(const Energy& now) const;
    double next_step() const;
    void sample_envelope();
    void sample_momentum();
    exchange::ParticleState stamped(const Points& points, double time, std::int64_t step) const;
    [[noreturn]] void break_down(const std::string& complaint) const;

    const scene::Scene& scene_;
    const scene::Mpm& mpm_;
    Body body_;
    Clock clock_;
    Start start_;
    Records records_;
    std::optional<GroundMotion> ground_;
    scene::Rest rest_;
    FlowView view_;
    OverlapMeter overlap_;
    Limits limits_;
    LastGood last_good_;
    std::optional<std::string> moving_ = "not checked yet";
};

}  // namespace breach::mpm
