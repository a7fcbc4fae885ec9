// A stage: its changes at the beginning, and its steps until its end.
#pragma once

#include "fem_solver/recorder.hpp"

namespace breach::fem {

/// Begins the course's stage: laws, water, elements present, loads, and with the first dynamic one
/// the clocks. For a resumed stage, only what a checkpoint does not contain.
void begin_stage(Course& course);

enum class StageEnd { reached, stopped, entangled };

/// Applies its load share by share.
StageEnd run_static(Course& course, Recorder& recorder);
/// Runs its time steps. Entangled: the course has the last good state.
StageEnd run_dynamic(Course& course, Recorder& recorder);

}  // namespace breach::fem
