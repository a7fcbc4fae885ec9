// The stages of an analysis in their order: how large each step is, when it is cut, what is written
// when, and how it ends.
#pragma once

#include "core/process/phase.hpp"
#include "fem_solver/checkpoint.hpp"
#include "fem_solver/choose.hpp"
#include "fem_solver/monitors/entanglement.hpp"
#include "fem_solver/monitors/watch.hpp"
#include "fem_solver/solve/step.hpp"

namespace breach::fem {

class Analysis {
  public:
    /// Goes on from the session's checkpoint when it is resumed and there is one.
    Analysis(process::Session& session, Model model);

    /// All stages, or as many as the mesh lives to see: entangled is a regular end, with the last
    /// good state in a snapshot, unless the scene asks to go on. Throws Breakdown when the mesh entangles in its very first step or
    /// the least step does not converge; the last good state is then in a snapshot and in the
    /// checkpoint.
    process::Outcome run();

    const Model& model() const { return model_; }
    const Motion& motion() const { return motion_; }
    const Position& position() const { return position_; }
    const Beginning& beginning() const { return beginning_; }
    const std::vector<Reading>& history() const { return history_; }

  private:
    enum class StageEnd { reached, stopped, entangled };

    StageEnd static_stage(const scene::Stage& stage);
    NewtonOutcome static_balance(double load);
    StageEnd dynamic_stage(const scene::Stage& stage);
    void place_stage();
    void make_newton(const scene::Stage& stage, const NewtonCounts& counts);
    void begin_stage(const scene::Stage& stage);
    void set_steady_pressure();
    void drive(double share);
    void note_reactions(const scene::Stage& stage);
    void begin_laws(const scene::Stage& stage);
    void begin_motion();
    void check_changes() const;
    void withhold(const scene::Stage& stage, const Eigen::VectorXd& force);
    void note_limit_point(const scene::Stage& stage);
    void note_free_ground();
    void flag_no_base_motion(const std::string& why);
    void note_geostatic_state(const scene::Stage& stage, const NewtonOutcome& outcome);
    Distortion trial_distortion();
    void note_entanglement(const Distortion& folded, double time);
    bool step_is_too_coarse(const scene::Stage& stage, double dt);
    double next_step_size(double stage_end) const;
    double next_stop(double stage_end) const;
    void keep_largest_excess_pressure();
    void accept(double dt, double stop, const NewtonOutcome& outcome);
    void cut_step(const scene::Stage& stage, const NewtonOutcome& outcome);
    void read_strength(Reading& reading) const;
    void write_due_outputs(double dt, const NewtonOutcome& outcome);
    bool snapshot_is_due(double dt);
    void write_snapshot();
    void write_last_snapshot();
    void write_checkpoint();
    void write_history();
    void resume();
    void raise_again(const std::vector<fault::Flag>& flags);
    bool checkpoint_is_due() const;
    [[noreturn]] void refuse_the_mesh();
    [[noreturn]] void give_up(const std::string& cause);
    void report_facts();
    void report_fallen();
    void report_crest();
    void report_end();
    void report_base_motion();
    void print_profile();
    double stage_begin(std::int64_t stage) const;

    process::Session& session_;
    const scene::Fem& fem_;
    const RunDecisions decided_;
    Model model_;
    Seconds seconds_;
    Position position_;
    Motion motion_, trial_;
    Beginning beginning_;
    std::vector<double> excess_pressure_max_;  ///< since the first dynamic stage began, per node of
                                               ///< the body; empty when dry [Pa]
    Eigen::VectorXd stage_force_;  ///< internal force when the static stage began; of a dynamic
                                   ///< one with a ramp what it withholds [N]
    Prediction prediction_;
    std::vector<materials::Law> laws_;
    std::optional<Newton> newton_;
    NewtonCounts counts_;  ///< of the stages before this one
    Work before_;          ///< of the run that is resumed
    Distortion distortion_;
    std::vector<Column> columns_;  ///< of telemetry and history
    std::vector<Reading> history_;
    Watch watch_;
    std::size_t crest_node_;
    std::optional<Entanglement> entanglement_;
    double step_error_ = 0.0;  ///< of the last step [m]
    double seconds_for_free_ground_ = 0.0;
    double span_ = 0.0;                ///< all dynamic stages [s]
    double checkpoint_written_ = 0.0;  ///< wall clock [s]
    bool checkpoint_wanted_ = false;   ///< since the last one a wanted snapshot was written
    double last_snapshot_ = -1.0;      ///< its time [s]
};

}  // namespace breach::fem
