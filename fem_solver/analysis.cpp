// The only place that moves Position::stage on: to the next stage when one is reached, not at all
// when it is stopped (a resumed run begins there), and out of the loop when the mesh is entangled.
#include "fem_solver/analysis.hpp"

#include <algorithm>

#include "fem_solver/facts.hpp"
#include "fem_solver/stage.hpp"

namespace breach::fem {

namespace {

StageEnd run_stage(Course& course, Recorder& recorder) {
    const bool is_static = course.stage().kind == scene::StageKind::static_equilibrium;
    const bool begins = !course.position.stage_begun;
    begin_stage(course);
    if (is_static) return run_static(course, recorder);
    // A row and, if one is due, a snapshot of the stage's beginning. A resumed stage has them
    // already.
    if (begins) recorder.take_step(0.0, {NewtonOutcome::End::converged, 0, 0.0});
    return run_dynamic(course, recorder);
}

void end_stage(Course& course) {
    Position& position = course.position;
    position.stage_begun = false;
    position.load = 0.0;
    // Dynamic stages keep their time step: the next one begins with it (begin_dynamic).
    if (course.stage().kind == scene::StageKind::static_equilibrium)
        position.dt = 0.0;  // it ends at rest
}

}  // namespace

process::Outcome analyse(Course& course) {
    Recorder recorder(course);
    const auto stages = static_cast<std::int64_t>(course.fem.stages.size());
    std::int64_t& stage = course.position.stage;
    for (; stage < stages; ++stage) {
        const StageEnd end = run_stage(course, recorder);
        if (end == StageEnd::stopped) {
            recorder.checkpoint();
            print_profile(course);
            return process::Outcome::stopped;
        }
        // Counts outlive the stage's solver, which the next stage replaces.
        course.counts = course.newton->counts();
        // The next stage may have other unknowns: supports, base and water differ.
        course.newton.reset();
        if (end == StageEnd::entangled) break;
        end_stage(course);
    }
    // After the last stage, `stage` would name none; results and snapshot need its laws and
    // pointer.
    stage = std::min(stage, stages - 1);
    recorder.finish();
    report_facts(course);
    report_end(course);
    print_profile(course);
    course.session.progress(1.0, "done");
    return process::Outcome::done;
}

}  // namespace breach::fem
