// A stage: its changes at the beginning, and its steps.
// analyse() (analysis.cpp) calls begin_stage, then one of the runs.
#pragma once

#include "fem_solver/recorder.hpp"

namespace breach::fem {

/// Begins the course's stage: laws, water, elements, loads, and the clocks if it is the first
/// dynamic one. In a resumed stage only what the checkpoint lacks.
void begin_stage(Course& course);

/// stopped: the caller writes a checkpoint in the middle of the stage. entangled: dynamic stages
/// only.
enum class StageEnd { reached, stopped, entangled };

/// Applies its load in shares.
StageEnd run_static(Course& course, Recorder& recorder);
/// Runs its time steps. If entangled, the course has the last good state.
StageEnd run_dynamic(Course& course, Recorder& recorder);

}  // namespace breach::fem
