// Draws polygons coloured by a value, and the colour bar.
#pragma once

#include <ostream>

#include "services/report/chart/frame.hpp"

namespace breach::report {

void draw_field(std::ostream& svg, const Frame& frame, const Field& field);
/// The colours with their values, below `y`.
void draw_colour_bar(std::ostream& svg, double x, double y, const Field& field);
constexpr double colour_bar_height = 62;

}  // namespace breach::report
