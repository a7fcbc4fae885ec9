#include "fem_solver/solve/base_motion.hpp"

#include <algorithm>
#include <cmath>

#include "core/words/number.hpp"
#include "fem_solver/model/columns_alone.hpp"
#include "fem_solver/model/ground_water.hpp"
#include "fem_solver/model/pore_water.hpp"
#include "fem_solver/model/stages.hpp"
#include "fem_solver/solve/step.hpp"

namespace breach::fem {
namespace {

using End = NewtonOutcome::End;
using scene::Stage;
using scene::StageKind;

std::vector<Stage> dynamic_stages(const scene::Fem& fem) {
    std::vector<Stage> stages;
    for (const Stage& each : fem.stages) {
        if (each.kind == StageKind::dynamic) stages.push_back(each);
    }
    return stages;
}

/// The columns during the stages.
/// The dynamic stage of the columns, in short: no monitors, no error control, no plastic gravity.
class Columns {
  public:
    Columns(const scene::Scene& scene, const Model& whole, const Motion& start)
        : scene_(scene),
          fem_(scene::fem_of(scene)),
          model_(columns_alone(whole)),
          motion_(columns_alone(whole, start)),
          trial_(motion_),
          prediction_(prediction_for(model_)) {
        // Equilibrium with the forces of the mesh: nothing moves before the ground does.
        model_.external_force = Eigen::VectorXd::Zero(model_.dofs());
        add_pressure_force(model_, motion_.p, model_.external_force);
        model_.external_force = motion_.force - model_.external_force;
        for (std::size_t i = 0; i < model_.mesh.nodes.size(); ++i) {
            if (!model_.constraints.is_base[i]) continue;
            if (base_ < 0 || model_.mesh.nodes[i].x() > model_.mesh.nodes[base_].x())
                base_ = static_cast<std::int32_t>(i);
        }
    }

    void begin(const Stage& stage) {
        stage_ = &stage;
        laws_ = laws_for(model_, stage.laws);
        set_softening(stage, model_, laws_);
        set_permeability(scene_, stage.permeability, model_);
        if (stage.laws == scene::StageLaws::scene) begin_memory(model_, motion_);
        newton_.emplace(model_, Solved::motion_and_pressure,
                        NewtonSettings{fem_.force_tolerance, fem_.largest_iterations},
                        Symmetry::symmetric, seconds_);
        settle_stresses(*newton_, laws_, motion_, trial_);
        set_acceleration(*newton_, model_, rest_, time_, prediction_, motion_);
    }

    /// Advances to this time with steps of the stage or shorter. False: the smallest does not
    /// converge.
    bool advance_to(double end) {
        // A cut lasts until the next sample: each begins with the stage's step again.
        double dt = stage_->time_step;
        const Newmark newmark{fem_.newmark_beta, fem_.newmark_gamma};
        while (time_ < end) {
            const double left = end - time_;
            const bool arrives = dt >= left * (1.0 - 1e-9);
            const double taken = arrives ? left : dt;
            const NewtonOutcome outcome =
                dynamic_step(*newton_, model_, laws_, newmark, rest_, taken, time_ + taken, motion_,
                             prediction_, trial_);
            if (outcome.end == End::converged) {
                std::swap(motion_, trial_);
                time_ = arrives ? end : time_ + taken;
                continue;
            }
            dt = 0.5 * taken;
            newton_->forget_matrix();
            if (dt < stage_->least_time_step) return false;
        }
        return true;
    }

    double time() const { return time_; }
    double velocity_of_base() const { return motion_.v[2 * static_cast<Eigen::Index>(base_)]; }

  private:
    const scene::Scene& scene_;
    const scene::Fem& fem_;
    Model model_;
    Motion motion_, trial_;
    const Beginning rest_{};  ///< no reaction: it is in external_force
    Prediction prediction_;
    Seconds seconds_;
    std::vector<materials::Law> laws_;
    std::optional<Newton> newton_;
    const Stage* stage_ = nullptr;
    std::int32_t base_ = -1;  ///< the rightmost node of the base, downstream
    double time_ = 0.0;       ///< [s]
};

}  // namespace

FreeGround free_ground(const scene::Scene& scene, const Model& whole, const Motion& start) {
    const scene::Fem& fem = scene::fem_of(scene);
    const std::vector<Stage> stages = dynamic_stages(fem);
    FreeGround ground;
    exchange::BaseMotion& base = ground.motion;
    base.time_step = std::ranges::min(stages, {}, &Stage::time_step).time_step;
    const double duration = std::max(fem.duration(), whole.base.outcrop.duration());
    const auto samples = static_cast<std::int64_t>(std::ceil(duration / base.time_step - 1e-9));

    Columns columns(scene, whole, start);
    base.velocity.push_back(columns.velocity_of_base());
    std::size_t s = 0;
    double stage_end = stages[0].duration;
    columns.begin(stages[0]);
    for (std::int64_t k = 1; k <= samples; ++k) {
        const double time = static_cast<double>(k) * base.time_step;
        bool converged = true;
        // A stage may end between two samples: the columns change stage exactly there.
        while (s + 1 < stages.size() && stage_end < time && converged) {
            converged = columns.advance_to(stage_end);
            columns.begin(stages[++s]);
            stage_end += stages[s].duration;
        }
        if (!converged || !columns.advance_to(time)) {
            return {{},
                    "the free-field columns alone do not converge at " +
                        words::text_of(columns.time()) + " s"};
        }
        base.velocity.push_back(columns.velocity_of_base());
    }
    return ground;
}

}  // namespace breach::fem
