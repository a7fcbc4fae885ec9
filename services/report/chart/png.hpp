// Converts SVG to PNG with rsvg-convert (Debian: librsvg2-bin).
#pragma once

#include <filesystem>

namespace breach::report {

enum class Converter { there, missing };
/// Whether rsvg-convert is on the PATH.
Converter png_converter();

/// Writes `svg` at twice its size as `png`. Throws IoError when the converter fails.
void write_png(const std::filesystem::path& svg, const std::filesystem::path& png);

}  // namespace breach::report
