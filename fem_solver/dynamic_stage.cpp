// A step is accepted after three questions: did it converge, is it fine enough, is the mesh sound?
// Until then only `trial` changes, so that a rejected step leaves no trace but a smaller step size.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>

#include "core/words/number.hpp"
#include "fem_solver/model/pore_water.hpp"
#include "fem_solver/stage.hpp"

namespace breach::fem {

namespace {

using words::text_of;

constexpr double cut_of_step = 0.5;
constexpr double growth_of_step = 2.0;
// A new step size costs a new factorisation.
constexpr int easy_steps_before_growth = 4;

/// The double that a user writes for this time: 1775 steps of 2 ms sum up to 3.5500000000000003 s,
/// and in a failure the last digit grows within seconds.
double as_written(double time) {
    const double written = std::round(1e9 * time) / 1e9;
    return std::abs(written - time) <= 1e-14 * std::abs(time) ? written : time;
}

/// Step sizes of a stage: reduced if steps fail or are too coarse, increased if they converge fast,
/// adjusted to end on given times.
class StepControl {
  public:
    explicit StepControl(Course& course)
        : course_(course),
          position_(course.position),
          stage_(course.stage()),
          begin_(course.stage_begin()),
          end_(begin_ + stage_.duration) {}

    bool at_end() const { return position_.time >= end_; }

    /// The wanted step, shortened to reach the next stop; less than two remaining steps are divided
    /// evenly [s].
    double next_size() const {
        const double left = next_stop() - position_.time;
        const double dt = position_.dt;
        if (std::abs(left - dt) <= 1e-9 * dt)
            return dt;  // round-off of the clock must not cause a new matrix
        if (left < dt) return left;
        return left < 2.0 * dt * (1.0 - 1e-9) ? 0.5 * left : dt;
    }

    /// After a failed step of this length. False: the smallest step failed.
    bool cut_after(double dt) {
        halve(dt);
        return position_.dt >= stage_.least_time_step;
    }

    /// Error of the trial's step in displacement, |beta - 1/6| dt^2 times the largest change of
    /// acceleration (Zienkiewicz & Xie 1991). Too large: the step is halved and repeated, down to
    /// the smallest one.
    bool is_too_coarse(double dt) {
        const double largest = course_.decided.largest_step_error.value;
        if (largest <= 0.0) return false;
        const double change = (course_.trial.a - course_.motion.a).lpNorm<Eigen::Infinity>();
        error_ = std::abs(course_.fem.newmark_beta - 1.0 / 6.0) * dt * dt * change;
        if (error_ <= largest || cut_of_step * dt < stage_.least_time_step) return false;
        halve(dt);
        return true;
    }

    /// Advances the clock by an accepted step.
    void accept(double dt, const NewtonOutcome& outcome) {
        const double stop = next_stop();
        // The clock takes the stop's own number: sums of steps would miss it in the last digits.
        const bool arrived = dt >= (stop - position_.time) * (1.0 - 1e-9);
        position_.time = arrived ? stop : position_.time + dt;
        ++position_.step;
        // A step of twice the length has about eight times the error.
        const bool easy = outcome.iterations <= course_.fem.largest_iterations / 2 &&
                          10.0 * error_ <= course_.decided.largest_step_error.value;
        position_.easy_steps = easy ? position_.easy_steps + 1 : 0;
        if (position_.dt < stage_.time_step && position_.easy_steps >= easy_steps_before_growth)
            want(std::min(stage_.time_step, growth_of_step * position_.dt));
        // After a shortened step, grow gradually: its velocities may be momentary.
        if (growth_of_step * dt < (1.0 - 1e-9) * position_.dt) want(growth_of_step * dt);
    }

  private:
    /// The next time to end a step on: a snapshot, the end of the stage, or a multiple of its time
    /// step. Snapshots at such multiples do not change results, even if steps were cut.
    double next_stop() const {
        const auto& times = course_.decided.snapshot_times.value;
        const auto next = static_cast<std::size_t>(position_.next_snapshot);
        const double wanted = next < times.size() ? std::min(times[next], end_) : end_;
        const double near = 0.05 * position_.dt;  // too short for a step
        const double done = std::floor((position_.time - begin_ + near) / stage_.time_step);
        const double multiple = as_written(begin_ + stage_.time_step * (done + 1.0));
        return multiple < wanted - near ? multiple : wanted;
    }

    void halve(double dt) {
        ++position_.cut_steps;
        want(cut_of_step * dt);
        // It was assembled for the longer step, and perhaps for a state that diverged.
        course_.newton->forget_matrix();
    }

    void want(double dt) {
        position_.dt = dt;
        position_.easy_steps = 0;
    }

    Course& course_;
    Position& position_;
    const scene::Stage& stage_;
    double begin_, end_;  ///< of the stage [s]
    double error_ = 0.0;  ///< of the last step [m]
};

Distortion distortion_of_trial(Course& course) {
    const Stopwatch watch(course.seconds, &Seconds::assembly);
    return distortion_of(course.model, course.trial, course.fem.strain_threshold);
}

/// A mesh that folds in the first step was never in equilibrium: a fault of the scene, no failure.
[[noreturn]] void refuse_the_mesh(const Entanglement& what, Recorder& recorder) {
    recorder.give_up(
        "the mesh entangles in its first step, before anything has moved: element " +
        std::to_string(what.element) + " of '" + what.region_name + "' at (" +
        text_of(what.where.x()) + ", " + text_of(what.where.y()) +
        ") has a least corner Jacobian ratio of " + text_of(what.least_ratio) +
        "; look there for a gap between regions, a missing support or a mapped corner that is too "
        "sharp, or take a smaller time step");
}

/// Records the folded corner: where, when and in which soil.
void note_entanglement(const Distortion& folded, double time, Course& course, Recorder& recorder) {
    course.entanglement = entanglement_of(course.session.scene().section, course.model,
                                          course.watch, course.motion, folded, time);
    if (course.position.time == 0.0) refuse_the_mesh(*course.entanglement, recorder);
}

/// Adds the work of the step; the trial becomes the motion.
void take_trial(Course& course) {
    Motion& motion = course.motion;
    Motion& trial = course.trial;
    Position& position = course.position;
    const Eigen::VectorXd& d_u = course.prediction.u = trial.u - motion.u;
    // Only of the body: thick columns would dominate.
    const auto own = static_cast<Eigen::Index>(2 * course.model.body.nodes);
    // This force is constant within a stage; internal forces change, hence their mean over the
    // step.
    position.external_work += course.model.external_force.head(own).dot(d_u.head(own));
    position.internal_work += 0.5 * (motion.force + trial.force).head(own).dot(d_u.head(own));
    if (const InternalForce& force = course.newton->internal_force(); force.is_viscous()) {
        const Eigen::VectorXd& mean = course.prediction.v = 0.5 * (motion.v + trial.v);
        position.viscous_dissipation += force.viscous_work(mean, d_u);
    }
    std::swap(motion, trial);
    if (course.beginning.p.size() > 0)
        keep_largest(course.model, motion, course.beginning,
                     course.watch.excess_pressure(course.model, motion, course.beginning),
                     course.largest);
}

[[noreturn]] void give_up_step(const NewtonOutcome& outcome, const Course& course,
                               Recorder& recorder) {
    const std::string why = outcome.end == NewtonOutcome::End::degenerate
                                ? course.newton->why_degenerate()
                                : "out of balance " + text_of(outcome.residual) + " after " +
                                      std::to_string(outcome.iterations) + " iterations";
    recorder.give_up("no convergence at " + text_of(course.position.time) +
                     " s with the least time step " + text_of(course.stage().least_time_step) +
                     " s: " + why + "; most distorted is element " +
                     std::to_string(course.distortion.worst_element) + " (least Jacobian ratio " +
                     text_of(course.distortion.least) + ")");
}

void tell_progress(const Course& course) {
    const double moved = course.history.empty() ? 0.0 : course.history.back().crest_displacement;
    course.session.progress(
        course.position.time / course.span,
        "t = " + text_of(course.position.time) + " s, crest moved " + text_of(moved) + " m");
}

}  // namespace

StageEnd run_dynamic(Course& course, Recorder& recorder) {
    const Newmark newmark{course.fem.newmark_beta, course.fem.newmark_gamma};
    StepControl control(course);
    while (!control.at_end()) {
        if (course.session.stop_requested()) return StageEnd::stopped;
        // The clock and the step size belong to `control`; a cut or a coarse step changes only its
        // next size.
        const double dt = control.next_size();
        const double time = course.position.time + dt;
        const NewtonOutcome outcome =
            dynamic_step(*course.newton, course.model, course.laws, newmark, course.beginning, dt,
                         time, course.motion, course.prediction, course.trial);
        if (outcome.end != NewtonOutcome::End::converged) {
            if (!control.cut_after(dt)) give_up_step(outcome, course, recorder);
            continue;
        }
        if (control.is_too_coarse(dt)) continue;
        const Distortion distortion = distortion_of_trial(course);
        if (distortion.least <= course.fem.least_jacobian_ratio) {
            note_entanglement(distortion, time, course, recorder);
            return StageEnd::entangled;
        }
        course.distortion = distortion;
        take_trial(course);
        control.accept(dt, outcome);
        recorder.take_step(dt, outcome);
        tell_progress(course);
        recorder.checkpoint_when_due();
    }
    return StageEnd::reached;
}

}  // namespace breach::fem
