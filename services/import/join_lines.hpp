// Joins the lines of a layer end to end into outlines, closed if they return to their beginning.
#pragma once

#include <vector>

#include "services/import/drawing.hpp"

namespace breach::importing {

/// Joins the outlines of one layer into as few as possible; ends within `tolerance` [m] coincide.
/// Closed outlines are unchanged. The origin of a joined outline is that of its first piece.
std::vector<Outline> joined(std::vector<Outline> pieces, double tolerance);

}  // namespace breach::importing
