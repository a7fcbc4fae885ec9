// Called at the start of a run and by --plan --measure. A resumed run does not come here: its
// points have the ground's reference already, and checkpoint.cpp makes their body.
#include "mpm_solver/begin.hpp"

#include <spdlog/spdlog.h>

#include <numeric>

#include "mpm_solver/body/fill.hpp"

namespace breach::mpm {

namespace {

void log_sampling(const std::vector<SampledRegion>& regions) {
    for (const SampledRegion& region : regions) {
        spdlog::log(
            is_faithful(region) ? spdlog::level::info : spdlog::level::warn,
            "region {}: {} points hold {:.6f} m2 of the polygon's {:.6f} m2, their centroid "
            "lies at {:.4f} m, the polygon's at {:.4f} m",
            region.name, region.points, region.sampled_area, region.polygon_area,
            region.sampled_level, region.polygon_level);
    }
}

Body fresh_body(const scene::Scene& scene, const exchange::ParticleState& state,
                const std::string& source, const Computing& computing) {
    Body body = make_body(scene, zoned_points(scene, state, source), source, computing,
                          state.steady_pressure);
    refuse_buried_points(body, source);
    return body;
}

GroundMotion ground_beneath(const exchange::ParticleState& state, const std::string& source) {
    // Resting ground would be no fallback: FEM velocities are absolute, so the soil would start to
    // slide with the velocity that the ground had at the transfer.
    if (!state.base_motion.any()) {
        throw fault::BadInput(
            source, {{"/breachline/base_motion",
                      "is missing, and /mpm/shaking is on: the motion of the ground after the "
                      "transfer is unknown",
                      "give the points of a transfer from a FEM with /fem/base, /fem/motion and "
                      "/fem/free_field (run again where an earlier version did), or set "
                      "/mpm/shaking to off"}});
    }
    return {state.base_motion, state.transfer_time};
}

void say(const GroundMotion& ground, const scene::Mpm& mpm) {
    // No fault: a transfer after the motion's end is a valid scene, to which /mpm/shaking adds no
    // force.
    if (ground.end() <= 0.0) {
        spdlog::warn(
            "the earthquake is over {:.2f} s before the transfer: nothing shakes the runout",
            -ground.end());
        return;
    }
    spdlog::info("the ground shakes on with up to {:.3g} m/s2 until {:.2f} s, and rests after that",
                 ground.peak_acceleration(), ground.end());
    if (!mpm.until_rest && mpm.duration < ground.end()) {
        spdlog::warn("the runout ends at {:.2f} s, before the earthquake does", mpm.duration);
    }
}

}  // namespace

void stand_on_ground(const GroundMotion& ground, exchange::ParticleState& state) {
    const double v_ground = ground.velocity(0.0);
    const double u_ground = ground.displacement(0.0);
    for (Vec2& v : state.velocity) v.x() -= v_ground;
    for (Vec2& x : state.position) x.x() -= u_ground;
    for (Vec2& x : state.steady_pressure.position) x.x() -= u_ground;
    // Both momenta are logged, so that the change of reference can be checked against the
    // transfer's ledger, which is relative to far rock.
    const double mass = std::accumulate(state.mass.begin(), state.mass.end(), 0.0);
    double momentum = 0.0;
    for (std::size_t p = 0; p < state.size(); ++p)
        momentum += state.mass[p] * state.velocity[p].x();
    spdlog::info(
        "horizontal momentum {:.6g} N s against far rock is {:.6g} N s on the ground, which moves "
        "with {:.4g} m/s and has moved {:.4g} m",
        momentum + mass * v_ground, momentum, v_ground, u_ground);
}

Computing computing_of(const process::Session& session) {
    return {.threads = session.settings().threads};
}

Begun begin(const process::Session& session) {
    const scene::Scene& scene = session.scene();
    if (session.settings().inputs.empty()) {
        if (scene::mpm_of(scene).shaking == scene::Shaking::goes_on) {
            throw fault::BadInput(scene.name,
                                  {{"/mpm/shaking",
                                    "is on, and a section filled with points has no FEM behind it "
                                    "that says how the ground moves",
                                    "give a transfer's points with --input, or set it to off"}});
        }
        const FilledSection filled = fill_section(scene);
        log_sampling(filled.regions);
        const std::string source = scene.name + " (section filled with points)";
        // Without a FEM there is no clock that the runout continues: its own time starts at the
        // transfer.
        return {fresh_body(scene, filled.state, source, computing_of(session)), 0.0};
    }
    exchange::ParticleState state = exchange::read_particle_state(session.input()).state;
    const std::string source = session.input().string();
    // Before the ground's frame: only areas and heights are compared, which it does not change.
    log_sampling(sampling_of(scene, state));
    std::optional<GroundMotion> ground;
    if (scene::mpm_of(scene).shaking == scene::Shaking::goes_on) {
        ground = ground_beneath(state, source);
        say(*ground, scene::mpm_of(scene));
        // Before the body is made: the grid, whose ends and terrain the body's points are checked
        // against, rests on the ground.
        stand_on_ground(*ground, state);
    }
    return {fresh_body(scene, state, source, computing_of(session)), state.transfer_time,
            std::move(ground)};
}

}  // namespace breach::mpm
