// The synthetic stress field on a graded mesh for which docs/reference/methods/transfer.md measures
// interpolations: 5,130 elements of 1 m height with widths from 1 m to 10 m, one Gauss point each,
// stress that increases with depth and drops across a shear band. The document gives no formula:
// this field was chosen to give the same error with the paper's interpolation.
#pragma once

#include <cstdio>

#include "tests/verification/transfer/meshes.hpp"

namespace breach::transfer::case_field {

constexpr int columns = 171;
constexpr int rows = 30;
constexpr int narrow = 131;  ///< columns of 1 m; the rest widens linearly to 10 m

inline double column_x(int i) {
    double x = std::min(i, narrow);
    for (int k = narrow; k < i; ++k) x += 1.0 + 9.0 * (k - narrow) / (columns - narrow - 1);
    return x;
}

inline meshes::MeshSnapshot mesh() {
    auto mesh =
        meshes::grid({.nx = columns, .ny = rows, .width = columns, .height = rows, .gauss = 1});
    for (auto& x : mesh.position_0) x.x() = column_x(static_cast<int>(std::lround(x.x())));
    return mesh;
}

/// Vertical stress [Pa]: 18.3 kPa/m, with a drop of 48 kPa across a band some 3 m wide that rises
/// from (30, 5) m at 0.12, through narrow elements into wide ones.
inline double sigma_v(const mechanics::Vec2& x, int) {
    constexpr double slope = 0.12;
    const double d = (x.y() - 5.0 - slope * (x.x() - 30.0)) / std::sqrt(1.0 + slope * slope);
    return -18.3e3 * (rows - x.y()) - 24e3 * std::tanh(d / 1.5);
}

/// Errors inside and outside the hull of the Gauss points [Pa], 2 x 2 points per element.
struct HullError {
    double inside = 0.0;   ///< rms
    double outside = 0.0;  ///< rms
    double largest = 0.0;
};
inline HullError error_of(const meshes::MeshSnapshot& s, const scene::Transfer& how) {
    const auto points = meshes::points_on(s, 2);
    const auto carried =
        interpolate(s, meshes::at_gauss(s, sigma_v), how, {.threads = 2}, points)->value;
    const auto centres = meshes::gauss_places(s);
    mechanics::Vec2 low = centres.front();
    mechanics::Vec2 high = centres.front();
    for (const auto& x : centres) {
        low = low.cwiseMin(x);
        high = high.cwiseMax(x);
    }
    HullError error;
    double inside = 0.0;
    double outside = 0.0;
    for (std::size_t p = 0; p < points.state.size(); ++p) {
        const auto& x = points.state.position[p];
        const double e = carried(static_cast<Eigen::Index>(p), 0) - sigma_v(x, 0);
        const bool in = (x.array() > low.array()).all() && (x.array() < high.array()).all();
        (in ? error.inside : error.outside) += e * e;
        (in ? inside : outside) += 1.0;
        error.largest = std::max(error.largest, std::abs(e));
    }
    error.inside = std::sqrt(error.inside / inside);
    error.outside = std::sqrt(error.outside / outside);
    return error;
}

inline HullError measured(const scene::Transfer& how) {
    const HullError error = error_of(mesh(), how);
    std::printf("  rms inside the hull %.3f kPa, outside %.3f kPa, largest %.2f kPa\n",
                error.inside / 1e3, error.outside / 1e3, error.largest / 1e3);
    return error;
}

}  // namespace breach::transfer::case_field
