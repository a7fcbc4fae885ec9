// Error of the interpolated stress against run time: mode, neighbours and mesh, for a smooth field,
// a shear band and a jump between two regions (elements from squares to aspect 1:10, 3 x 3 points
// each); error of the round trip against n, neighbours and mode on the graded elements of
// docs/reference/methods/mochikoshi_case.md; time against size. One thread, CPU seconds, except in
// the last table.
#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <ctime>

#include "tests/verification/transfer/case_field.hpp"

namespace {

using namespace breach::transfer;
using breach::mechanics::Vec2;
using breach::scene::Interpolation;

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

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
    const double began = cpu_seconds();
    const Interpolated carried = *interpolate(mesh, values, how, {}, points);
    const double seconds = cpu_seconds() - began;
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

/// Wall seconds of the whole default interpolation with two threads.
void sizes() {
    std::printf(
        "\nlocal, 40 neighbours, 3 x 3 points per element, 2 threads\n"
        "Gauss points  wall seconds  microseconds per Gauss point  peak memory so far [MB]\n");
    for (const int n : {50, 79, 112, 158}) {
        const auto mesh = graded(n, n);
        const Points points = meshes::points_on(mesh, 3);
        Values values(static_cast<Eigen::Index>(mesh.stress.size()), 6);
        values.colwise() = meshes::at_gauss(mesh, band).col(0);
        const auto began = std::chrono::steady_clock::now();
        interpolate(mesh, values, meshes::settings(3), {.threads = 2}, points);
        const double seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
        rusage usage{};
        getrusage(RUSAGE_SELF, &usage);
        std::printf("%12zu  %12.3f  %28.1f  %23.1f\n", mesh.stress.size(), seconds,
                    1e6 * seconds / static_cast<double>(mesh.stress.size()),
                    static_cast<double>(usage.ru_maxrss) / 1024.0);
        std::fflush(stdout);
    }
}

}  // namespace

int main() {
    sizes();  // first: the peak memory is this table's
    std::printf("\nfield    Gauss points  mode  neighbours  RMS [kPa]  max [kPa]  seconds\n");
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
    return 0;
}
