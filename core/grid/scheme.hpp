// The update order of the material point scheme and the other words of a scene's scheme, as values
// only: reading, planning and computing share these enums.
#pragma once

namespace breach::grid {

enum class KernelKind { gimp, b_spline, linear };
/// When the stress follows the points: last (USL), last with a second mapping (MUSL), first (USF).
enum class UpdateOrder { usl, musl, usf };

}  // namespace breach::grid
