// Colours for values: from light (low) to dark (high), perceptually uniform. Independent of charts.
#pragma once

#include <string>

namespace breach::report {

/// Colour at a share of the range, clamped to [0, 1], as "#rrggbb". Lightness, hue and chroma run
/// along a line in OKLab (Ottosson 2020), so that equal steps of the value look equally far apart
/// and survive a black-and-white print.
std::string colour_at(double share);

/// Perceived lightness of "#rrggbb" in OKLab [0 black, 1 white].
double lightness_of(const std::string& colour);

}  // namespace breach::report
