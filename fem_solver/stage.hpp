// A stage: what it changes as it begins, and how its steps follow each other until its end.
#pragma once

#include "fem_solver/recorder.hpp"

namespace breach::fem {

/// Puts the course's stage in force: laws, water, what is there, what comes to bear, and with the
/// first dynamic one the clocks. Of a stage that has begun, what a checkpoint does not hold.
void begin_stage(Course& course);

enum class StageEnd { reached, stopped, entangled };

/// Puts its load in place share by share.
StageEnd run_static(Course& course, Recorder& recorder);
/// Lets its time pass. Entangled: the last good state is that of the course.
StageEnd run_dynamic(Course& course, Recorder& recorder);

}  // namespace breach::fem
