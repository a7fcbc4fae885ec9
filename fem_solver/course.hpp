// An analysis in progress: everything that changes from stage to stage and from step to step.
// Kept is what a checkpoint contains. The rest is made from the scene (model, watch), made anew for
// each stage (laws, newton) or scratch memory (trial, prediction). Owned by run.cpp; stages and
// Recorder change it.
#pragma once

#include "core/process/session.hpp"
#include "fem_solver/checkpoint.hpp"
#include "fem_solver/choose.hpp"
#include "fem_solver/monitors/entanglement.hpp"
#include "fem_solver/monitors/watch.hpp"
#include "fem_solver/solve/step.hpp"

namespace breach::fem {

struct Course : Kept {
    /// Continues from the session's checkpoint if it is resumed and has one.
    Course(process::Session& its_session, Model its_model);

    const scene::Stage& stage() const;
    std::string pointer_of_stage() const;
    double stage_begin() const;  ///< [s]

    /// Sets elements, supports, loads and water of the stage and creates its solver.
    void make_newton();
    void write_checkpoint();

    process::Session& session;
    const scene::Fem& fem;
    const RunDecisions decided;
    Model model;
    Seconds seconds;
    double seconds_for_free_ground = 0.0;
    // The end of the step that is being tried. Accepting a step swaps it with `motion`.
    Motion trial;
    Prediction prediction;
    std::vector<materials::Law> laws;
    std::optional<Newton> newton;  ///< within a stage
    Work before;                   ///< of the resumed run
    Distortion distortion;
    std::optional<Entanglement> entanglement;
    Watch watch;
    std::size_t crest_node;
    double span = 0.0;  ///< of all dynamic stages [s]

  private:
    void check_changes() const;
    void place_stage();
    void resume();
    void raise_again(const std::vector<fault::Flag>& flags);
};

}  // namespace breach::fem
