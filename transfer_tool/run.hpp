// The transfer as a phase: its plan, and one snapshot in, one particle file out.
#pragma once

#include "core/process/phase.hpp"

namespace breach::transfer {

process::Plan plan(const scene::Scene& scene);
process::Outcome run(process::Session& session);

}  // namespace breach::transfer
