// Error of the interpolated stress against run time: mode, neighbours and mesh, for a smooth field,
// a shear band and a jump between two regions. Mesh: squares at one side that widen to aspect 1:10
// at the other, 3 x 3 points per element.
#include <chrono>
#include <cstdio>

#include "tests/verification/transfer/meshes.hpp"

namespace {

using namespace breach::transfer;
using breach::mechanics::Vec2;
using breach::scene::Interpolation;

/// Overburden of 18 kPa/m with a wave of 40 kPa.
double smooth(const Vec2& x, int) {
    return -18e3 * (30.0 - x.y()) + 40e3 * std::sin(x.x() / 8.0) * std::cos(x.y() / 5.0);
}

/// The same with a band 3 m wide across which the stress drops by 30 kPa.
double band(const Vec2& x, int region) {
    return smooth(x, region) - 15e3 * std::tanh((x.y() - 0.4 * x.x() + 8.0) / 1.5);
}

/// The same with 200 kPa more in the second region.
double jump(const Vec2& x, int region) { return smooth(x, region) - 200e3 * region; }

/// Column widths grow from 1 m to 10 m.
meshes::MeshSnapshot graded(int nx, int ny) {
    auto mesh = meshes::grid({.nx = nx, .ny = ny, .width = 1.0 * nx, .height = 30.0, .regions = 2});
    for (auto& x : mesh.position_0) x.x() += 4.5 * x.x() * x.x() / nx;
    return mesh;
}

void row(const char* name, const meshes::MeshSnapshot& mesh, const meshes::Field& field,
         const breach::scene::Transfer& how) {
    const Points points = meshes::points_on(mesh, how.points_per_direction);
    Values values(static_cast<Eigen::Index>(mesh.stress.size()),
                  6);  // as many fields as a transfer
    values.colwise() = meshes::at_gauss(mesh, field).col(0);
    const auto began = std::chrono::steady_clock::now();
    const Interpolated carried = *interpolate(mesh, values, how, {}, points);
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    double largest = 0.0;
    double square = 0.0;
    for (std::size_t p = 0; p < points.state.size(); ++p) {
        const double error = carried.value(static_cast<Eigen::Index>(p), 0) -
                             field(points.state.position[p], points.state.region[p]);
        largest = std::max(largest, std::abs(error));
        square += error * error / static_cast<double>(points.state.size());
    }
    const bool local = how.interpolation == Interpolation::local;
    std::printf("%-7s %6zu %6zu  %-5s %10s  %9.4f  %9.3f  %8.3f\n", name, mesh.stress.size(),
                points.state.size(), local ? "local" : "paper",
                local ? std::to_string(how.neighbours).c_str() : "all", std::sqrt(square) / 1e3,
                largest / 1e3, seconds);
    std::fflush(stdout);
}

}  // namespace

int main() {
    std::printf("field    Gauss points  mode  neighbours  RMS [kPa]  max [kPa]  seconds\n");
    const std::pair<const char*, meshes::Field> fields[] = {
        {"smooth", smooth}, {"band", band}, {"jump", jump}};
    for (const auto& [name, field] : fields)
        for (const int n : {12, 24}) {
            const auto mesh = graded(n, n);
            for (const int neighbours : {12, 20, 40, 60}) {
                auto how = meshes::settings(3);
                how.neighbours = neighbours;
                row(name, mesh, field, how);
            }
            row(name, mesh, field, meshes::settings(3, Interpolation::paper));
        }
    const auto large = graded(158, 158);
    row("band", large, band, meshes::settings(3));
    return 0;
}
