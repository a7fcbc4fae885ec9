// What a run holds in memory, as the allocator counts it.
#pragma once

#include <malloc.h>

#include "mpm_solver/simulation.hpp"
#include "tests/unit/mpm/bodies.hpp"

namespace breach::mpm::test {

/// 10 m x 20 m of sand that collapses along a floor of 60 m: what speed and memory are measured with.
inline scene::Scene tall_column(double h, int fill_points) {
    scene::Scene scene =
        one_soil(sand(20e6, 0.3, 1e3, 30.0), 1800.0, rectangle(0, 0, 10, 20), h, 60.0, 24.0);
    scene.gravity = 9.81;
    scene.mpm->left = scene::Wall::roller;
    scene.mpm->floor.friction = {{0.0, 60.0, 0.5}};
    scene.mpm->fill_points = fill_points;
    return scene;
}

/// Bytes that the program has asked for and not given back; 0 where a sanitizer has the allocator.
inline double bytes_in_use() {
    const auto use = mallinfo2();
    return static_cast<double>(use.uordblks + use.hblkhd);
}

/// Of a run that has made some steps.
inline double bytes_per_point(const scene::Scene& scene) {
    const double before = bytes_in_use();
    Simulation simulation(scene, filled_body(scene), 0.0);
    for (int k = 0; k < 3; ++k) simulation.advance();
    return (bytes_in_use() - before) / static_cast<double>(simulation.body().points.size());
}

}  // namespace breach::mpm::test
