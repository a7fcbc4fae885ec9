#include "fem_solver/analysis.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
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

namespace breach::fem {

using process::Outcome;
using scene::Stage;
using scene::StageKind;
using End = NewtonOutcome::End;
using words::text_of;

namespace {

constexpr double cut = 0.5;
constexpr double growth = 2.0;
constexpr int easy_steps_before_growth = 4;
constexpr double told_residual = 10.0;    // times force_tolerance, at the end of a static stage
constexpr double least_load_step = 1e-4;  // share of gravity

/// Static stages without plasticity, all dynamic ones (the mass keeps the symmetrised tangent
/// positive) and PM4Sand, whose tangent is symmetric, do best with LDL^T; Mohr-Coulomb statics near
/// collapse needs the true, unsymmetric tangent. Measured on the slope scene, 150 steps: LDL^T 886
/// iterations, 0.77 s; LU 822 iterations, 1.12 s.
Symmetry symmetry_for(const Stage& stage, const std::vector<materials::Law>& laws) {
    const bool symmetric = std::ranges::all_of(
        laws, [](const auto& law) { return materials::traits(law).symmetric_tangent; });
    const bool general =
        stage.kind == StageKind::static_equilibrium && stage.undrained.empty() && !symmetric;
    return general ? Symmetry::general : Symmetry::symmetric;
}

/// Loads and pore pressure, without the reactions of supports [N].
Eigen::VectorXd loads_of(const Model& model, const Motion& motion) {
    Eigen::VectorXd loads = model.external_force;
    add_pressure_force(model, motion.p, loads);
    return loads;
}

}  // namespace

Analysis::Analysis(process::Session& session, Model model)
    : session_(session),
      fem_(scene::fem_of(session.scene())),
      decided_(decide_run(session.scene())),
      model_(std::move(model)),
      motion_(at_rest(model_)),
      trial_(motion_),
      columns_(columns_of(session.scene())),
      watch_(fem_, model_),
      crest_node_(nearest_node(watch_.body(), fem_.crest)) {
    const auto& switches = session.settings().switches;
    if (switches.contains(profile_switch) || switches.contains(trial_switch))
        seconds_.clock = cpu_clock;
    for (const Stage& stage : fem_.stages) span_ += stage.duration;
    if (fem_.changes_the_body()) check_changes();
    prediction_ = prediction_for(model_);
    report_crest();
    const bool resumed = session.settings().start == process::Start::resume &&
                         std::filesystem::exists(session.output(phases::files::checkpoint));
    if (resumed) {
        resume();
    } else {
        session_.truncate_telemetry(0);
    }
}

/// Every stage once on a copy: what cannot be is refused before anything is computed.
void Analysis::check_changes() const {
    Model copy = model_;
    const ModelDecisions decided = decide_model(session_.scene());
    for (std::size_t s = 0; s < fem_.stages.size(); ++s)
        set_stage(session_.scene(), decided, s, copy);
}

double Analysis::stage_begin(std::int64_t stage) const {
    double begin = 0.0;
    for (std::int64_t s = 0; s < stage; ++s) begin += fem_.stages[s].duration;
    return begin;
}

Outcome Analysis::run() {
    const auto stages = static_cast<std::int64_t>(fem_.stages.size());
    for (; position_.stage < stages; ++position_.stage) {
        const Stage& stage = fem_.stages[position_.stage];
        begin_stage(stage);
        const StageEnd end = stage.kind == StageKind::static_equilibrium ? static_stage(stage)
                                                                         : dynamic_stage(stage);
        if (end == StageEnd::stopped) {
            write_checkpoint();
            print_profile();
            return Outcome::stopped;
        }
        counts_ = newton_->counts();
        newton_.reset();
        if (end == StageEnd::entangled) break;
        position_.stage_begun = false;
        position_.load = 0.0;
        if (stage.kind == StageKind::static_equilibrium) position_.dt = 0.0;  // it ends at rest
    }
    position_.stage = std::min(position_.stage, stages - 1);
    write_last_snapshot();
    write_history();
    report_facts();
    report_end();
    print_profile();
    session_.progress(1.0, "done");
    return Outcome::done;
}

/// Body, supports, loads and water of the stage that the position says.
void Analysis::place_stage() {
    if (!fem_.changes_the_body()) return;
    set_stage(session_.scene(), decide_model(session_.scene()),
              static_cast<std::size_t>(position_.stage), model_);
    watch_.look_at(model_);
    set_skeleton_modulus(beginning_, model_);
    prediction_ = prediction_for(model_);
}

void Analysis::make_newton(const Stage& stage, const NewtonCounts& counts) {
    const Solved solved = stage.kind == StageKind::dynamic ? Solved::motion_and_pressure
                          : stage.undrained.empty()        ? Solved::displacement
                                                           : Solved::displacement_and_pressure;
    place_stage();
    const Stopwatch watch(seconds_, &Seconds::factor);
    newton_.emplace(
        model_, solved,
        NewtonSettings{fem_.force_tolerance, fem_.largest_iterations, session_.settings().threads},
        symmetry_for(stage, laws_for(model_, stage.laws)), seconds_);
    newton_->set_counts(counts);
}

/// Puts the stage's laws in force. The first dynamic stage starts clocks, displacements and strains
/// at zero: gravity's settlement belongs to the past of the slope, not to its failure.
void Analysis::begin_stage(const Stage& stage) {
    laws_ = laws_for(model_, stage.laws);
    const bool is_static = stage.kind == StageKind::static_equilibrium;
    const Eigen::VectorXd loads_before = loads_of(model_, motion_);
    set_softening(stage, model_, laws_);
    if (!newton_) make_newton(stage, counts_);
    set_permeability(session_.scene(), stage.permeability, model_);
    const bool drains = stage.undrained.empty();
    if (position_.stage_begun) {
        if (!drains) close_to_flow(model_);
        if (stage.ramp > 0.0) withhold(stage, stage_force_);
        return;
    }
    position_.stage_begun = true;
    spdlog::info("stage {}", stage.name);
    if (is_static) set_steady_pressure();
    if (!drains) close_to_flow(model_);
    if (fem_.changes_the_body()) forget_absent(model_, motion_);
    if (stage.laws == scene::StageLaws::scene) begin_laws(stage);
    // What is gone holds nothing any more: the stage releases what it held, from these forces on.
    if (fem_.changes_the_body()) settle_stresses(*newton_, laws_, motion_, trial_);
    if (is_static) {
        position_.load_step = 1.0 / stage.load_steps;
        position_.at_limit = false;
        stage_force_ = motion_.force;
        // What a support gave an edge that now moves is part of the edge's own force from the start.
        if (position_.stage > 0)
            for (const Model::Driven& each : model_.driven)
                stage_force_[each.dof] = loads_before[each.dof];
        if (drains) return;
        Eigen::VectorXd of_water = Eigen::VectorXd::Zero(model_.dofs());
        add_pressure_force(model_, motion_.p, of_water);
        stage_force_ -= of_water;
        return;
    }
    // A motion that goes on does so with the step before: over a longer one the velocities at a
    // ramp's end would count as if they lasted.
    position_.dt = position_.dt > 0.0 ? std::min(position_.dt, stage.time_step) : stage.time_step;
    position_.easy_steps = 0;
    for (std::size_t i = 0; i < model_.water.is_unknown.size(); ++i)
        if (const auto n = static_cast<Eigen::Index>(i); !model_.water.is_unknown[i])
            motion_.p[n] = model_.water.prescribed[n];  // it drains again
    settle_stresses(*newton_, laws_, motion_, trial_);
    if (!position_.moving) begin_motion();
    model_.withheld.resize(0);
    if (stage.ramp > 0.0) {
        stage_force_ = unbalanced_force(*newton_, model_, beginning_, position_.time, motion_);
        withhold(stage, stage_force_);
    }
    set_acceleration(*newton_, model_, beginning_, position_.time, prediction_, motion_);
    // A step that cannot resolve this acceleration would throw the mesh: it starts without, and
    // what is suddenly unbalanced counts from its end.
    constexpr double resolved = 0.01;  // of the shortest edge
    const double thrown =
        0.5 * stage.time_step * stage.time_step * motion_.a.lpNorm<Eigen::Infinity>();
    if (thrown > resolved * quality_of(model_.mesh).shortest_edge) motion_.a.setZero();
    distortion_ = distortion_of(model_, motion_, fem_.strain_threshold);
    write_due_outputs(0.0, {End::converged, 0, 0.0});
}

/// That of steady seepage; where no water flows the pressure stays what it was.
void Analysis::set_steady_pressure() {
    Eigen::VectorXd p = model_.water.any() ? steady_pressure(model_) : model_.water.prescribed;
    for (std::size_t i = 0; i < model_.undrained.size(); ++i)
        if (model_.undrained[i])
            p[static_cast<Eigen::Index>(i)] = motion_.p[static_cast<Eigen::Index>(i)];
    motion_.p = std::move(p);
    motion_.p_rate = Eigen::VectorXd::Zero(motion_.p.size());
}

/// What is out of balance when the stage begins comes to bear along its ramp; a motion that there is
/// goes on.
void Analysis::withhold(const Stage& stage, const Eigen::VectorXd& force) {
    model_.withheld = force;
    model_.withheld_from = stage_begin(position_.stage);
    model_.withheld_for = stage.ramp;
}

void Analysis::begin_motion() {
    position_.moving = true;
    motion_.u.setZero();
    std::ranges::fill(motion_.strain, Voigt::Zero());
    for (Hourglass& each : motion_.hourglass) each.energy = 0.0;
    beginning_ = beginning_of(model_, motion_);
    set_skeleton_modulus(beginning_, model_);
    evaluate_pore_water(model_, motion_.u, model_.water);
    note_free_ground();
}

void Analysis::flag_no_base_motion(const std::string& why) {
    session_.flag({"no_base_motion", fault::Severity::warning,
                   "no runout can be shaken on after the transfer: " + why, "/fem/free_field"});
}

/// Now, and not at the end: every snapshot then knows how the ground will move after it.
void Analysis::note_free_ground() {
    if (session_.settings().switches.contains(trial_switch))
        return;  // ten steps want no earthquake
    if (!decided_.free_ground.value) {
        if (model_.base.any() && scene::fem_of(session_.scene()).motion)
            flag_no_base_motion("the scene has no free-field columns (/fem/free_field)");
        return;
    }
    const double began = seconds_.clock();
    FreeGround ground = free_ground(session_.scene(), model_, motion_);
    seconds_for_free_ground_ = seconds_.clock() - began;
    if (!ground.why_not.empty()) {
        flag_no_base_motion(ground.why_not);
        return;
    }
    beginning_.base_motion = std::move(ground.motion);
    const motion::Series velocity{beginning_.base_motion.time_step,
                                  beginning_.base_motion.velocity};
    std::ostringstream csv;
    motion::write_csv(csv, {motion::Quantity::velocity, velocity, {}},
                      "velocity of the base beneath the free-field columns alone");
    exchange::publish_text(session_.output(phases::files::base_motion), csv.str());
    spdlog::info("  the free ground's base moves with at most {:.3g} m/s until {:.4g} s",
                 motion::peak(velocity), velocity.duration());
}

/// The switch from elastic stages to the scene's laws. A static stage after another one brings the
/// stresses inside the surfaces of laws with memory first.
void Analysis::begin_laws(const Stage& stage) {
    if (position_.stage != decided_.memory.value) return;
    if (decided_.memory_start.value == MemoryStart::at_rest_with_friction) {
        Newton newton(model_, Solved::displacement,
                      {.tolerance = fem_.force_tolerance,
                       .largest_iterations = std::max(fem_.largest_iterations, iterations_to_rest),
                       .threads = session_.settings().threads,
                       .patience = patience_to_rest},
                      Symmetry::general, seconds_);
        const FrictionalRest rest =
            rest_with_friction(newton, model_, motion_, prediction_, trial_);
        if (rest.converged) {
            spdlog::info("  {}", in_words(rest));
        } else {
            session_.flag({"no_frictional_rest", fault::Severity::warning, in_words(rest),
                           "/fem/stages/" + std::to_string(position_.stage)});
        }
        session_.result()["geostatic"][stage.name]["friction"] = {
            {"converged", rest.converged},
            {"cohesion", rest.cohesion},
            {"iterations", rest.iterations},
            {"out_of_balance", rest.residual}};
    }
    const StressBias bias = begin_memory(model_, motion_);
    spdlog::info(
        "  {} begins at {} points; {} keep a stress outside their surfaces, at most {:.3g} kPa",
        names_of_laws_with_memory(model_), points_with_memory(model_, motion_), bias.points,
        bias.largest / 1e3);
    if (bias.cut_down == 0) return;
    session_.flag({"stress_cut_down", fault::Severity::warning,
                   std::to_string(bias.cut_down) +
                       " points began with a stress that their law cannot hold; its deviator was "
                       "cut down, by at most " +
                       text_of(bias.largest_cut / 1e3) +
                       " kPa, and what is missing is out of balance in this stage: look at K_0 and "
                       "psi_0",
                   "/fem/stages/" + std::to_string(position_.stage)});
    // A static stage makes up for it over its load, from these forces on.
    settle_stresses(*newton_, laws_, motion_, trial_);
}

Analysis::StageEnd Analysis::static_stage(const Stage& stage) {
    double start = position_.load;
    while (position_.load < 1.0) {
        if (session_.stop_requested()) return StageEnd::stopped;
        const double load = std::min(1.0, start + position_.load_step);
        drive(load - start);
        const NewtonOutcome outcome = static_balance(load);
        ++position_.step;
        if (outcome.end != End::converged) {
            position_.load_step *= cut;
            ++position_.cut_steps;
            if (position_.load_step < least_load_step) {
                if (stage.goes_on_at_limit) {
                    note_limit_point(stage);
                    return StageEnd::reached;
                }
                const std::string why =
                    outcome.end == End::degenerate
                        ? newton_->why_degenerate()
                        : "out of balance " + text_of(outcome.residual) + " of the weight";
                give_up("no equilibrium in stage '" + stage.name + "' beyond " +
                        text_of(position_.load) + " of its load: " + why);
            }
            continue;
        }
        std::swap(motion_, trial_);
        position_.load = start = load;
        if (!model_.driven.empty())
            position_.load_step = std::min(1.0 / stage.load_steps, growth * position_.load_step);
        note_reactions(stage);
        spdlog::info("  {:.4g} of gravity in {} iterations, out of balance {:.2e}", load,
                     outcome.iterations, outcome.residual);
        if (load >= 1.0) note_geostatic_state(stage, outcome);
        if (checkpoint_is_due()) write_checkpoint();
    }
    return StageEnd::reached;
}

/// Soil that an edge pushes yields everywhere at once when its limit state is reached exactly. Its
/// tangent is singular there: the step is tried again with a part of the elastic stiffness and a wider
/// tolerance, and so are the steps behind it until one fails. The residual enters the next step, so it
/// does not add up. Load steps keep their tolerance: beyond its limit a load has no equilibrium.
NewtonOutcome Analysis::static_balance(double load) {
    const auto step = [&] {
        return static_step(*newton_, model_, laws_, load, stage_force_, motion_, prediction_,
                           trial_);
    };
    if (!position_.at_limit) {
        const NewtonOutcome outcome = step();
        if (outcome.end == End::converged || model_.driven.empty()) return outcome;
    }
    newton_->take(Newton::Tangent::stiffened);
    const NewtonOutcome outcome = step();
    newton_->take(Newton::Tangent::of_the_laws);
    position_.at_limit = outcome.end == End::converged;
    return outcome;
}

/// Moves what the stage moves, and lets creep what creeps, by this share of its way.
void Analysis::drive(double share) {
    set_creep_step(share, motion_, model_);
    prediction_.driven.resize(0);
    if (model_.driven.empty()) return;
    prediction_.driven = Eigen::VectorXd::Zero(model_.dofs());
    for (const Model::Driven& each : model_.driven) prediction_.driven[each.dof] = share * each.by;
}

/// What pushes the edges that the stage moves, per metre of thickness, step by step.
void Analysis::note_reactions(const Stage& stage) {
    if (stage.displacements.empty()) return;
    Eigen::VectorXd applied = prediction_.external;
    if (!stage.undrained.empty()) add_pressure_force(model_, motion_.p, applied);
    auto& facts = session_.result()["geostatic"][stage.name]["displaced"];
    for (const scene::Displacement& each : stage.displacements) {
        Vec2 force = Vec2::Zero();
        for (const std::size_t i : nodes_on(model_.mesh, each.from, each.to)) {
            const auto d = static_cast<Eigen::Index>(2 * i);
            force += (motion_.force - applied).segment<2>(d) / model_.thickness;
        }
        facts[each.name].push_back({{"load", position_.load},
                                    {"force_x", each.x ? force.x() : 0.0},
                                    {"force_y", each.y ? force.y() : 0.0}});
    }
}

/// The load beyond which the body finds no equilibrium: `motion_` is the last one.
void Analysis::note_limit_point(const Stage& stage) {
    session_.result()["geostatic"][stage.name]["limit_point"] = position_.load;
    session_.flag({"limit_point", fault::Severity::warning,
                   "no equilibrium in stage '" + stage.name + "' beyond " +
                       text_of(position_.load) +
                       " of its load; the next stage goes on from the last one, in motion",
                   "/fem/stages/" + std::to_string(position_.stage)});
    spdlog::info("  limit point at {:.6g} of the load", position_.load);
}

void Analysis::note_geostatic_state(const Stage& stage, const NewtonOutcome& outcome) {
    const LateralStress K = lateral_stress(model_, motion_);
    spdlog::info("  sigma'_xx / sigma'_yy {:.3f} on average, {:.3f} to {:.3f}", K.average, K.least,
                 K.largest);
    session_.result()["geostatic"][stage.name].update({{"out_of_balance", outcome.residual},
                                                       {"K_average", K.average},
                                                       {"K_least", K.least},
                                                       {"K_largest", K.largest}});
    if (outcome.residual <= told_residual * fem_.force_tolerance) return;
    session_.flag({"out_of_balance", fault::Severity::warning,
                   "stage '" + stage.name + "' ends with " + text_of(outcome.residual) +
                       " of the weight out of balance, " +
                       text_of(outcome.residual / fem_.force_tolerance) +
                       " times the tolerance: its points jump between states, and the residual "
                       "falls no further; a finer mesh or smaller load steps may help",
                   "/fem/force_tolerance"});
}

Analysis::StageEnd Analysis::dynamic_stage(const Stage& stage) {
    const double stage_end = stage_begin(position_.stage) + stage.duration;
    const Newmark newmark{fem_.newmark_beta, fem_.newmark_gamma};
    const bool moves = model_.kinematics == scene::Kinematics::updated_lagrangian;
    while (position_.time < stage_end) {
        if (session_.stop_requested()) return StageEnd::stopped;
        const double dt = next_step_size(stage_end);
        if (moves && model_.water.any()) evaluate_pore_water(model_, motion_.u, model_.water);
        const NewtonOutcome outcome =
            dynamic_step(*newton_, model_, laws_, newmark, beginning_, dt, position_.time + dt,
                         motion_, prediction_, trial_);
        if (outcome.end != End::converged) {
            position_.dt = dt;
            cut_step(stage, outcome);
            continue;
        }
        if (step_is_too_coarse(stage, dt)) continue;
        const Distortion distortion = trial_distortion();
        if (distortion.least <= fem_.least_jacobian_ratio) {
            if (!entanglement_) note_entanglement(distortion, position_.time + dt);
            if (fem_.at_entanglement == scene::AtEntanglement::stop) return StageEnd::entangled;
        }
        distortion_ = distortion;
        accept(dt, next_stop(stage_end), outcome);
        if (checkpoint_is_due()) write_checkpoint();
    }
    return StageEnd::reached;
}

/// The first corner that folds: where, when and in what soil.
void Analysis::note_entanglement(const Distortion& folded, double time) {
    entanglement_ = entanglement_of(session_.scene().section, model_, watch_, motion_, folded, time,
                                    fem_.at_entanglement);
    if (position_.time == 0.0) refuse_the_mesh();
    if (fem_.at_entanglement == scene::AtEntanglement::go_on) {
        spdlog::warn("{}; the analysis goes on with the undeformed mesh", in_words(*entanglement_));
    }
}

/// What folds in the very first step was never in equilibrium: no failure, a fault of the scene.
void Analysis::refuse_the_mesh() {
    const Entanglement& what = *entanglement_;
    give_up("the mesh entangles in its first step, before anything has moved: element " +
            std::to_string(what.element) + " of '" + what.region_name + "' at (" +
            text_of(what.where.x()) + ", " + text_of(what.where.y()) +
            ") has a least corner Jacobian ratio of " + text_of(what.least_ratio) +
            "; look there for a gap between regions, a missing support or a mapped corner that is "
            "too sharp, or take a smaller time step");
}

Distortion Analysis::trial_distortion() {
    const Stopwatch watch(seconds_, &Seconds::assembly);
    return distortion_of(model_, trial_, fem_.strain_threshold);
}

/// Error of the step in displacement, |beta - 1/6| dt^2 times the largest change of acceleration
/// (Zienkiewicz & Xie 1991): where it is too large the step is halved and taken again, down to the
/// least one.
bool Analysis::step_is_too_coarse(const Stage& stage, double dt) {
    if (decided_.largest_step_error.value <= 0.0) return false;
    const double change = (trial_.a - motion_.a).lpNorm<Eigen::Infinity>();
    step_error_ = std::abs(fem_.newmark_beta - 1.0 / 6.0) * dt * dt * change;
    if (step_error_ <= decided_.largest_step_error.value || cut * dt < stage.least_time_step)
        return false;
    ++position_.cut_steps;
    position_.easy_steps = 0;
    position_.dt = cut * dt;
    newton_->forget_matrix();
    return true;
}

namespace {

/// The same number as somebody who asks for it writes: 1775 steps of 2 ms are 3.5500000000000003 s,
/// and where soil runs away the last digit decides after seconds what is left of it.
double as_written(double time) {
    const double written = std::round(1e9 * time) / 1e9;
    return std::abs(written - time) <= 1e-14 * std::abs(time) ? written : time;
}

}  // namespace

/// The next time that must be met exactly: a wanted snapshot, the end of the stage, or a multiple of
/// the stage's time step. The last lets snapshots at such multiples change nothing, whatever steps
/// were cut on the way.
double Analysis::next_stop(double stage_end) const {
    const auto& times = decided_.snapshot_times.value;
    const auto next = static_cast<std::size_t>(position_.next_snapshot);
    const double wanted = next < times.size() ? std::min(times[next], stage_end) : stage_end;
    const double near = 0.05 * position_.dt;  // no step for so little
    const double step = fem_.stages[position_.stage].time_step;
    const double begin = stage_begin(position_.stage);
    const double done = std::floor((position_.time - begin + near) / step);
    const double multiple = as_written(begin + step * (done + 1.0));
    return multiple < wanted - near ? multiple : wanted;
}

/// The wanted step, shortened to meet the next stop: the way there is divided evenly when less than
/// two steps are left.
double Analysis::next_step_size(double stage_end) const {
    const double left = next_stop(stage_end) - position_.time;
    const double dt = position_.dt;
    if (std::abs(left - dt) <= 1e-9 * dt)
        return dt;  // rounding of the clock must not cost a matrix
    if (left < dt) return left;
    return left < 2.0 * dt * (1.0 - 1e-9) ? 0.5 * left : dt;
}

void Analysis::accept(double dt, double stop, const NewtonOutcome& outcome) {
    const Eigen::VectorXd& d_u = prediction_.u = trial_.u - motion_.u;
    // Of the body: thick columns would drown it.
    const auto own = static_cast<Eigen::Index>(2 * model_.body.nodes);
    position_.external_work += model_.external_force.head(own).dot(d_u.head(own));
    position_.internal_work += 0.5 * (motion_.force + trial_.force).head(own).dot(d_u.head(own));
    if (newton_->internal_force().is_viscous()) {
        const Eigen::VectorXd& mean = prediction_.v = 0.5 * (motion_.v + trial_.v);
        position_.viscous_dissipation += newton_->internal_force().viscous_work(mean, d_u);
    }
    std::swap(motion_, trial_);
    const bool arrived = dt >= (stop - position_.time) * (1.0 - 1e-9);
    position_.time = arrived ? stop : position_.time + dt;
    ++position_.step;
    const Stage& stage = fem_.stages[position_.stage];
    // A step twice as long has about eight times the error.
    const bool easy = outcome.iterations <= fem_.largest_iterations / 2 &&
                      10.0 * step_error_ <= decided_.largest_step_error.value;
    position_.easy_steps = easy ? position_.easy_steps + 1 : 0;
    if (position_.dt < stage.time_step && position_.easy_steps >= easy_steps_before_growth) {
        position_.dt = std::min(stage.time_step, growth * position_.dt);
        position_.easy_steps = 0;
    }
    // A step cut short to meet a stop: its velocities may be those of an instant, too.
    if (growth * dt < (1.0 - 1e-9) * position_.dt) {
        position_.dt = growth * dt;
        position_.easy_steps = 0;
    }
    keep_largest_excess_pressure();
    write_due_outputs(dt, outcome);
    session_.progress(position_.time / span_,
                      "t = " + text_of(position_.time) + " s, crest moved " +
                          text_of(history_.empty() ? 0.0 : history_.back().crest_displacement) +
                          " m");
}

/// What has liquefied once does not regain its strength when its pore pressure dips.
void Analysis::keep_largest_excess_pressure() {
    if (beginning_.p.size() == 0) return;
    const std::vector<double> excess = watch_.excess_pressure(model_, motion_, beginning_);
    if (excess_pressure_max_.empty()) excess_pressure_max_ = excess;
    std::ranges::transform(excess, excess_pressure_max_, excess_pressure_max_.begin(),
                           [](double now, double before) { return std::max(now, before); });
}

void Analysis::cut_step(const Stage& stage, const NewtonOutcome& outcome) {
    ++position_.cut_steps;
    position_.easy_steps = 0;
    position_.dt *= cut;
    newton_->forget_matrix();
    if (position_.dt >= stage.least_time_step) return;
    const std::string why = outcome.end == End::degenerate
                                ? newton_->why_degenerate()
                                : "out of balance " + text_of(outcome.residual) + " after " +
                                      std::to_string(outcome.iterations) + " iterations";
    give_up("no convergence at " + text_of(position_.time) + " s with the least time step " +
            text_of(stage.least_time_step) + " s: " + why + "; most distorted is element " +
            std::to_string(distortion_.worst_element) + " (least Jacobian ratio " +
            text_of(distortion_.least) + ")");
}

}  // namespace breach::fem
