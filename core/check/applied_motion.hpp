// The motion that shakes the scene: read, reversed, baseline-corrected and scaled as the scene requests. The
// check judges this motion, and the FEM applies it.
#pragma once

#include "core/motion/read_motion.hpp"
#include "core/scene/scene.hpp"

namespace breach::check {

/// Baseline-corrected and scaled as the scene requests; a velocity record becomes an acceleration.
motion::Recording applied(const scene::BaseMotion& wanted, motion::Recording recording);
/// The same from the scene's motion file. Throws as motion::read_motion does.
motion::Recording applied_motion(const scene::BaseMotion& wanted);

}  // namespace breach::check
