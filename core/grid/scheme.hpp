// Enums of the material point scheme, shared by scene, planning and solver.
#pragma once

namespace breach::grid {

enum class KernelKind { gimp, b_spline, linear };
/// When the stress is updated: last (USL), last with a second mapping (MUSL), first (USF).
enum class UpdateOrder { usl, musl, usf };

}  // namespace breach::grid
