// What a scene says of the material point scheme, as values only: whoever reads, plans, audits or
// computes means the same two enums.
#pragma once

namespace breach::grid {

enum class KernelKind { gimp, b_spline, linear };
/// When the stress follows the points: last (USL), last with a second mapping (MUSL), first (USF).
enum class UpdateOrder { usl, musl, usf };

}  // namespace breach::grid
