// A chart's picture as self-contained SVG.
#pragma once

#include <string>

#include "services/report/chart/chart.hpp"

namespace breach::report {

/// Axes cover all series, marks and the field. Values are finite, and positive on a logarithmic
/// axis; columns of a series are equally long, of segments even; throws std::invalid_argument
/// otherwise, or when there is nothing to draw. A flat chart of equal aspect is drawn with heights
/// exaggerated by a whole number, which its y axis states.
std::string as_svg(const Chart& chart);

}  // namespace breach::report
