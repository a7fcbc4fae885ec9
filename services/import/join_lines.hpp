// Lines of a layer put end to end: what is drawn in pieces becomes one outline, closed where it comes
// back to its beginning.
#pragma once

#include <vector>

#include "services/import/drawing.hpp"

namespace breach::importing {

/// Outlines of one layer in, as few as possible out; ends within `tolerance` [m] are one. Closed ones
/// pass. The origin of a joined outline is that of its first piece.
std::vector<Outline> joined(std::vector<Outline> pieces, double tolerance);

}  // namespace breach::importing
