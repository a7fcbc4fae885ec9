// A static stage goes from the forces it finds to its own load in shares. A share without
// equilibrium is halved. Below a share of 1e-4 the stage ends: as a breakdown, or at its limit
// point if the scene says so ("at_limit": "go_on").
#include <spdlog/spdlog.h>

#include <algorithm>

#include "core/words/number.hpp"
#include "fem_solver/model/ground_water.hpp"
#include "fem_solver/model/pore_water.hpp"
#include "fem_solver/model/stages.hpp"
#include "fem_solver/stage.hpp"

namespace breach::fem {

namespace {

using words::text_of;
using End = NewtonOutcome::End;

constexpr double cut_of_load = 0.5;
constexpr double growth_of_load = 2.0;
// times force_tolerance: a larger residual at the end of a static stage is flagged
constexpr double told_residual = 10.0;
constexpr double least_load_step = 1e-4;  // share of gravity

nlohmann::json& facts_of_stage(Course& course) {
    return course.session.result()["geostatic"][course.stage().name];
}

/// Applies this share of the stage's displacements.
void drive(double share, Course& course) {
    const Model& model = course.model;
    Eigen::VectorXd& driven = course.prediction.driven;
    driven.resize(0);
    if (model.driven.empty()) return;
    driven = Eigen::VectorXd::Zero(model.dofs());
    for (const Model::Driven& each : model.driven) driven[each.dof] = share * each.by;
}

/// Soil pushed by an edge yields everywhere when the limit state is reached, and its tangent is
/// singular. The step is repeated with a part of the elastic stiffness and a wider tolerance, and
/// so are the following ones until one fails. The residual enters the next step; it does not
/// accumulate. Load steps keep their tolerance: beyond its limit a load has no equilibrium.
NewtonOutcome balance(double load, Course& course) {
    const auto step = [&] {
        return static_step(*course.newton, course.model, course.laws, load, course.stage_force,
                           course.motion, course.prediction, course.trial);
    };
    if (!course.position.at_limit) {
        const NewtonOutcome outcome = step();
        if (outcome.end == End::converged || course.model.driven.empty()) return outcome;
    }
    course.newton->take(Newton::Tangent::stiffened);
    const NewtonOutcome outcome = step();
    // The next step decides anew, by at_limit.
    course.newton->take(Newton::Tangent::of_the_laws);
    course.position.at_limit = outcome.end == End::converged;
    return outcome;
}

/// Records the force on edges that the stage moves, per metre of thickness and step.
void note_reactions(Course& course) {
    const scene::Stage& stage = course.stage();
    if (stage.displacements.empty()) return;
    const Model& model = course.model;
    Eigen::VectorXd applied = course.prediction.external;
    if (!stage.undrained.empty()) add_pressure_force(model, course.motion.p, applied);
    auto& facts = facts_of_stage(course)["displaced"];
    for (const scene::Displacement& each : stage.displacements) {
        Vec2 force = Vec2::Zero();
        for (const std::size_t i : nodes_on(model.mesh, each.from, each.to)) {
            const auto d = static_cast<Eigen::Index>(2 * i);
            force += (course.motion.force - applied).segment<2>(d) / model.thickness;
        }
        // A component that is not prescribed has no support force: 0, not the round-off of its
        // balance.
        facts[each.name].push_back({{"load", course.position.load},
                                    {"force_x", each.x ? force.x() : 0.0},
                                    {"force_y", each.y ? force.y() : 0.0}});
    }
}

/// Records the limit load; the motion is the last equilibrium.
void note_limit_point(Course& course) {
    const double load = course.position.load;
    facts_of_stage(course)["limit_point"] = load;
    course.session.flag({"limit_point", fault::Severity::warning,
                         "no equilibrium in stage '" + course.stage().name + "' beyond " +
                             text_of(load) +
                             " of its load; the next stage goes on from the last one, in motion",
                         course.pointer_of_stage()});
    spdlog::info("  limit point at {:.6g} of the load", load);
}

void note_geostatic_state(Course& course, double residual) {
    const LateralStress K = lateral_stress(course.model, course.motion);
    spdlog::info("  sigma'_xx / sigma'_yy {:.3f} on average, {:.3f} to {:.3f}", K.average, K.least,
                 K.largest);
    facts_of_stage(course).update({{"out_of_balance", residual},
                                   {"K_average", K.average},
                                   {"K_least", K.least},
                                   {"K_largest", K.largest}});
    const double tolerance = course.fem.force_tolerance;
    if (residual <= told_residual * tolerance) return;
    course.session.flag(
        {"out_of_balance", fault::Severity::warning,
         "stage '" + course.stage().name + "' ends with " + text_of(residual) +
             " of the weight out of balance, " + text_of(residual / tolerance) +
             " times the tolerance: its points jump between states, and the residual falls no "
             "further; a finer mesh or smaller load steps may help",
         "/fem/force_tolerance"});
}

[[noreturn]] void give_up_load(const NewtonOutcome& outcome, const Course& course,
                               Recorder& recorder) {
    const std::string why = outcome.end == End::degenerate
                                ? course.newton->why_degenerate()
                                : "out of balance " + text_of(outcome.residual) + " of the weight";
    recorder.give_up(
        "no equilibrium in stage '" + course.stage().name + "' beyond " +
        text_of(course.position.load) + " of its load: " + why +
        seepage_remedy(course.session.scene(), static_cast<std::size_t>(course.position.stage)));
}

}  // namespace

StageEnd run_static(Course& course, Recorder& recorder) {
    const scene::Stage& stage = course.stage();
    Position& position = course.position;
    while (position.load < 1.0) {
        if (course.session.stop_requested()) return StageEnd::stopped;
        const double load = std::min(1.0, position.load + position.load_step);
        // Displacements are increments of the step; loads are shares of the whole.
        drive(load - position.load, course);
        const NewtonOutcome outcome = balance(load, course);
        ++position.step;
        if (outcome.end != End::converged) {
            position.load_step *= cut_of_load;
            ++position.cut_steps;
            if (position.load_step >= least_load_step) continue;
            if (!stage.goes_on_at_limit) give_up_load(outcome, course, recorder);
            note_limit_point(course);
            return StageEnd::reached;
        }
        std::swap(course.motion, course.trial);
        position.load = load;
        // Only moved edges: a load that needed small steps near its limit needs them to the end.
        if (!course.model.driven.empty())
            position.load_step =
                std::min(1.0 / stage.load_steps, growth_of_load * position.load_step);
        note_reactions(course);
        spdlog::info("  {:.4g} of gravity in {} iterations, out of balance {:.2e}", load,
                     outcome.iterations, outcome.residual);
        if (load >= 1.0) note_geostatic_state(course, outcome.residual);
        recorder.checkpoint_when_due();
    }
    return StageEnd::reached;
}

}  // namespace breach::fem
