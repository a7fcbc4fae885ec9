// A chart's picture as self-contained SVG.
#pragma once

#include <string>

#include "services/report/chart/chart.hpp"

namespace breach::report {

/// Axes cover all series, marks and the field. Throws std::invalid_argument for non-finite values,
/// values <= 0 on a logarithmic axis, columns of unequal length, an odd number of points of
/// segments, or an empty chart. A flat chart of equal aspect has its heights exaggerated by a whole
/// number, which the y axis states.
std::string as_svg(const Chart& chart);

}  // namespace breach::report
