#include "services/report/chart/colour_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace breach::report {

namespace {

using Triple = std::array<double, 3>;

/// sRGB's transfer function (IEC 61966-2-1) and its inverse.
double encoded(double linear) {
    const double v = std::clamp(linear, 0.0, 1.0);
    return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055;
}
double decoded(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }

/// OKLab -> linear sRGB.
Triple linear_rgb(double L, double a, double b) {
    const double l = std::pow(L + 0.3963377774 * a + 0.2158037573 * b, 3);
    const double m = std::pow(L - 0.1055613458 * a - 0.0638541728 * b, 3);
    const double s = std::pow(L - 0.0894841775 * a - 1.2914855480 * b, 3);
    return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
            -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
            -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

}  // namespace

std::string colour_at(double share) {
    const double s = std::clamp(share, 0.0, 1.0);
    const double lightness = 0.92 - 0.67 * s;
    // pale yellow over green and blue to violet; most colourful in the middle, where sRGB has room
    const double hue = (100.0 + 200.0 * s) * std::numbers::pi / 180.0;
    const double chroma = 0.05 + 0.16 * s * (1.0 - s);
    const Triple rgb = linear_rgb(lightness, chroma * std::cos(hue), chroma * std::sin(hue));
    char text[8];
    const auto byte = [](double linear) {
        return static_cast<unsigned>(std::lround(255.0 * encoded(linear)));
    };
    std::snprintf(text, sizeof text, "#%02x%02x%02x", byte(rgb[0]) & 255u, byte(rgb[1]) & 255u,
                  byte(rgb[2]) & 255u);
    return text;
}

double lightness_of(const std::string& colour) {
    Triple v;
    for (std::size_t k = 0; k < 3; ++k) {
        v[k] = decoded(std::stoi(colour.substr(1 + 2 * k, 2), nullptr, 16) / 255.0);
    }
    const double l = std::cbrt(0.4122214708 * v[0] + 0.5363325363 * v[1] + 0.0514459929 * v[2]);
    const double m = std::cbrt(0.2119034982 * v[0] + 0.6806995451 * v[1] + 0.1073969566 * v[2]);
    const double s = std::cbrt(0.0883024619 * v[0] + 0.2817188376 * v[1] + 0.6299787005 * v[2]);
    return 0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s;
}

}  // namespace breach::report
