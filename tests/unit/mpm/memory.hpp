// Memory of a run, by the allocator's count.
#pragma once

#include <malloc.h>

#include "mpm_solver/simulation.hpp"
#include "tests/unit/mpm/bodies.hpp"

namespace breach::mpm::test {

/// 10 m x 20 m of sand that collapses on a floor of 60 m, for measurements of speed and memory.
inline scene::Scene tall_column(double h, int fill_points) {
    scene::Scene scene =
        one_soil(sand(20e6, 0.3, 1e3, 30.0), 1800.0, rectangle(0, 0, 10, 20), h, 60.0, 24.0);
    scene.gravity = 9.81;
    scene.mpm->left = scene::Wall::roller;
    scene.mpm->floor.friction = {{0.0, 60.0, 0.5}};
    scene.mpm->fill_points = fill_points;
    return scene;
}

/// Allocated bytes of the program; 0 if a sanitizer replaces the allocator.
inline double bytes_in_use() {
    const auto use = mallinfo2();
    return static_cast<double>(use.uordblks + use.hblkhd);
}

/// For a run after some steps.
inline double bytes_per_point(const scene::Scene& scene) {
    const double before = bytes_in_use();
    Simulation simulation(scene, filled_body(scene), 0.0);
    for (int k = 0; k < 3; ++k) simulation.advance();
    return (bytes_in_use() - before) / static_cast<double>(simulation.body().points.size());
}

}  // namespace breach::mpm::test
