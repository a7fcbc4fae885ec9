// What changes once, when a stage begins. The order is that of dependence: soil, supports and loads
// (make_newton), water, the laws' memories, then the forces that the new state leaves unbalanced. A
// static stage applies those over its load, a dynamic one as acceleration or along its ramp.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <sstream>

#include "core/exchange/publish.hpp"
#include "core/motion/read_motion.hpp"
#include "core/phases/files.hpp"
#include "core/words/number.hpp"
#include "fem_solver/model/ground_water.hpp"
#include "fem_solver/model/pore_water.hpp"
#include "fem_solver/model/stages.hpp"
#include "fem_solver/solve/base_motion.hpp"
#include "fem_solver/solve/plastic_gravity.hpp"
#include "fem_solver/solve/trial.hpp"
#include "fem_solver/stage.hpp"

namespace breach::fem {

namespace {

/// Loads and pore pressure, without the reactions of supports [N].
Eigen::VectorXd loads_on(const Model& model, const Motion& motion) {
    Eigen::VectorXd loads = model.external_force;
    add_pressure_force(model, motion.p, loads);
    return loads;
}

/// Steady seepage; without flow the pressure stays.
void set_steady_pressure(const Model& model, Motion& motion) {
    Eigen::VectorXd p = model.water.any() ? steady_pressure(model) : model.water.prescribed;
    for (std::size_t i = 0; i < model.undrained.size(); ++i)
        if (model.undrained[i])
            // Undrained soil keeps its pressure; the stage changes it together with the
            // displacements.
            p[static_cast<Eigen::Index>(i)] = motion.p[static_cast<Eigen::Index>(i)];
    motion.p = std::move(p);
    motion.p_rate = Eigen::VectorXd::Zero(motion.p.size());
}

/// A force that is unbalanced at the beginning of the stage is applied along its ramp; existing
/// motion continues.
void withhold_along_ramp(Course& course) {
    course.model.withheld = course.stage_force;
    course.model.withheld_from = course.stage_begin();
    course.model.withheld_for = course.stage().ramp;
}

/// A warning and no fault: only a runout with "shaking": "on" needs the motion.
void flag_no_base_motion(Course& course, const std::string& why) {
    course.session.flag({"no_base_motion", fault::Severity::warning,
                         "no runout can be shaken on after the transfer: " + why,
                         "/fem/free_field"});
}

/// At the beginning, so that every snapshot contains the ground's later motion.
void note_free_ground(Course& course) {
    process::Session& session = course.session;
    // a trial of ten steps needs no earthquake
    if (session.settings().switches.contains(trial_switch)) return;
    if (!course.decided.free_ground.value) {
        if (course.model.base.any() && course.fem.motion)
            flag_no_base_motion(course, "the scene has no free-field columns (/fem/free_field)");
        return;
    }
    const double began = course.seconds.clock();
    FreeGround ground = free_ground(session.scene(), course.model, course.motion);
    course.seconds_for_free_ground = course.seconds.clock() - began;
    if (!ground.why_not.empty()) {
        flag_no_base_motion(course, ground.why_not);
        return;
    }
    course.beginning.base_motion = std::move(ground.motion);
    const motion::Series velocity{course.beginning.base_motion.time_step,
                                  course.beginning.base_motion.velocity};
    std::ostringstream csv;
    motion::write_csv(csv, {motion::Quantity::velocity, velocity, {}},
                      "velocity of the base beneath the free-field columns alone");
    // For people; the transfer takes the motion from its snapshot.
    exchange::publish_text(session.output(phases::files::base_motion), csv.str());
    spdlog::info("  the free ground's base moves with at most {:.3g} m/s until {:.4g} s",
                 motion::peak(velocity), velocity.duration());
}

/// The flag of stresses that a law could not hold when it began.
void flag_cut_down(Course& course, std::size_t points, double largest, const std::string& remedy) {
    course.session.flag(
        {"stress_cut_down", fault::Severity::warning,
         std::to_string(points) +
             " points began with a stress that their law cannot hold; its deviator was cut down, "
             "by at most " +
             words::text_of(largest / 1e3) +
             " kPa, and what is missing is out of balance in this stage: " + remedy,
         course.pointer_of_stage()});
}

/// Brings the stresses of the drained law inside the undrained strength.
void begin_undrained(Course& course) {
    if (course.model.s_u.empty()) return;
    const std::vector<State> drained = course.motion.points;
    settle_stresses(*course.newton, course.laws, course.motion, course.trial);
    std::size_t points = 0;
    double largest = 0.0;
    for (std::size_t p = 0; p < drained.size(); ++p) {
        const Voigt cut = course.motion.points[p].sigma - drained[p].sigma;
        const double size = cut.cwiseAbs().maxCoeff();
        // round-off of a stress on the surface
        if (size <= 1e-9 * drained[p].sigma.cwiseAbs().maxCoeff()) continue;
        ++points;
        largest = std::max(largest, size);
    }
    if (points > 0)
        flag_cut_down(course, points, largest,
                      "the shear stress at rest is above the undrained strength; compare with a "
                      "higher /materials/*/dynamic_strength/ratio, and give the stage a ramp");
}

/// Clocks, displacements and strains start at zero: settlement due to gravity is not part of the
/// failure.
void begin_motion(Course& course) {
    course.position.moving = true;
    // Stress and pressure stay. The mesh keeps its drawn shape: the settlement of gravity is
    // dropped, not added to it.
    course.motion.u.setZero();
    std::ranges::fill(course.motion.strain, Voigt::Zero());
    for (Hourglass& each : course.motion.hourglass) each.energy = 0.0;
    course.beginning = beginning_of(course.model, course.motion);
    apply_to_model(course.beginning, course.model);
    // The stabilisation of pressures depends on the modulus that was just set.
    evaluate_pore_water(course.model, course.model.water);
    begin_undrained(course);
    note_free_ground(course);
}

/// Brings the stresses inside the surfaces of laws with memory.
void find_frictional_rest(Course& course) {
    // A solver of its own: a level may take more iterations than a step, and it gives up without
    // progress.
    Newton newton(
        course.model, Solved::displacement,
        {.tolerance = course.fem.force_tolerance,
         .largest_iterations = std::max(course.fem.largest_iterations, iterations_to_rest),
         .threads = course.session.settings().threads,
         .patience = patience_to_rest},
        Symmetry::general, course.seconds);
    const FrictionalRest rest =
        rest_with_friction(newton, course.model, course.motion, course.prediction, course.trial);
    if (rest.converged) {
        spdlog::info("  {}", in_words(rest));
    } else {
        course.session.flag(
            {"no_frictional_rest", fault::Severity::warning,
             in_words(rest) + seepage_remedy(course.session.scene(),
                                             static_cast<std::size_t>(course.position.stage)),
             course.pointer_of_stage()});
    }
    course.session.result()["geostatic"][course.stage().name]["friction"] = {
        {"converged", rest.converged},
        {"cohesion", rest.cohesion},
        {"iterations", rest.iterations},
        {"out_of_balance", rest.residual}};
}

/// The switch from elastic stages to the scene's laws.
void begin_laws(Course& course) {
    if (course.position.stage != course.decided.memory.value) return;
    if (course.decided.memory_start.value == MemoryStart::at_rest_with_friction)
        find_frictional_rest(course);
    // From here on the memories have the stress, and State mirrors it.
    const StressBias bias = begin_memory(course.model, course.motion);
    spdlog::info(
        "  {} begins at {} points; {} keep a stress outside their surfaces, at most {:.3g} kPa",
        names_of_laws_with_memory(course.model), points_with_memory(course.model, course.motion),
        bias.points, bias.largest / 1e3);
    if (bias.cut_down == 0) return;
    flag_cut_down(course, bias.cut_down, bias.largest_cut, "look at K_0 and psi_0");
    // A static stage corrects the change over its load, starting with these forces.
    settle_stresses(*course.newton, course.laws, course.motion, course.trial);
}

void begin_static(Course& course, const Eigen::VectorXd& loads_before) {
    const Model& model = course.model;
    course.position.load_step = 1.0 / course.stage().load_steps;
    course.position.at_limit = false;
    // The load goes from these forces to the stage's: at share 0 nothing is out of balance.
    course.stage_force = course.motion.force;
    // The former support force of an edge that now moves is its own force from the start.
    if (course.position.stage > 0)
        for (const Model::Driven& each : model.driven)
            course.stage_force[each.dof] = loads_before[each.dof];
    // With unknown pressures the load without water is shared out, as static_step adds none.
    if (course.stage().undrained.empty()) return;
    Eigen::VectorXd of_water = Eigen::VectorXd::Zero(model.dofs());
    add_pressure_force(model, course.motion.p, of_water);
    course.stage_force -= of_water;
}

void begin_dynamic(Course& course) {
    const scene::Stage& stage = course.stage();
    Position& position = course.position;
    Model& model = course.model;
    Motion& motion = course.motion;
    // Continued motion keeps its time step: a longer one would extrapolate the velocities at a
    // ramp's end.
    position.dt = position.dt > 0.0 ? std::min(position.dt, stage.time_step) : stage.time_step;
    position.easy_steps = 0;
    for (std::size_t i = 0; i < model.water.is_unknown.size(); ++i)
        if (const auto n = static_cast<Eigen::Index>(i); !model.water.is_unknown[i])
            motion.p[n] = model.water.prescribed[n];  // drained again
    settle_stresses(*course.newton, course.laws, motion, course.trial);
    // Once per run: r_u, displacements and strains of all dynamic stages refer to the first one.
    if (!position.moving) begin_motion(course);
    model.withheld.resize(0);
    if (stage.ramp > 0.0) {
        course.stage_force =
            unbalanced_force(*course.newton, model, course.beginning, position.time, motion);
        withhold_along_ramp(course);
    }
    set_acceleration(*course.newton, model, course.beginning, position.time, course.prediction,
                     motion);
    // If a step cannot resolve this acceleration, start without it; the unbalanced force then acts
    // from the end of the step.
    constexpr double resolved = 0.01;  // of the shortest edge
    const double thrown =
        0.5 * stage.time_step * stage.time_step * motion.a.lpNorm<Eigen::Infinity>();
    if (thrown > resolved * quality_of(model.mesh).shortest_edge) motion.a.setZero();
    course.distortion = distortion_of(model, motion, course.fem.strain_threshold);
}

}  // namespace

void begin_stage(Course& course) {
    const scene::Stage& stage = course.stage();
    Model& model = course.model;
    const bool is_static = stage.kind == scene::StageKind::static_equilibrium;
    const bool drains = stage.undrained.empty();
    const bool changes = course.fem.changes_the_body();
    course.laws = laws_for(model, stage.laws);
    // Before make_newton, which sets the stage's supports and loads.
    const Eigen::VectorXd loads_before = loads_on(model, course.motion);
    set_softening(stage, model, course.laws);
    if (!course.newton) course.make_newton();
    set_permeability(course.session.scene(), stage.permeability, model);
    // Resumed: motion, memories and forces are the checkpoint's. Only what it does not contain is
    // set.
    if (course.position.stage_begun) {
        if (!drains) close_to_flow(model);
        if (stage.ramp > 0.0) withhold_along_ramp(course);
        return;
    }
    course.position.stage_begun = true;
    spdlog::info("stage {}", stage.name);
    if (is_static) set_steady_pressure(model, course.motion);
    if (!drains) close_to_flow(model);
    // Before the laws begin: absent soil must not start with a stress.
    if (changes) forget_absent(model, course.motion);
    if (stage.laws == scene::StageLaws::scene) begin_laws(course);
    // Removed soil supports nothing: the stage releases that force, starting with these forces.
    if (changes) settle_stresses(*course.newton, course.laws, course.motion, course.trial);
    if (is_static)
        begin_static(course, loads_before);
    else
        begin_dynamic(course);
}

}  // namespace breach::fem
