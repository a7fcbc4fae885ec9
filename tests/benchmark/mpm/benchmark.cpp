// mpm_benchmark speed: particle-steps per CPU second over a whole column collapse, verb by verb.
// mpm_benchmark error: runout error against CPU seconds over cell size, points per cell, Courant
// number and order.
#include <cstdio>
#include <cstring>
#include <ctime>

#include "mpm_solver/runout.hpp"
#include "mpm_solver/sort.hpp"
#include "tests/unit/mpm/bodies.hpp"

namespace breach::mpm {
namespace {

double cpu_seconds() {
    timespec used{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
    return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

scene::Scene column(double h, int fill_points, double cfl, scene::UpdateOrder order) {
    scene::Scene scene = test::one_soil(test::sand(20e6, 0.3, 1e3, 30.0), 1800.0,
                                        test::rectangle(0.0, 0.0, 10.0, 20.0), h, 60.0, 24.0);
    scene.gravity = 9.81;
    scene.mpm->left = scene::Wall::roller;
    scene.mpm->floor.friction = {{0.0, 60.0, 0.5}};
    scene.mpm->fill_points = fill_points;
    scene.mpm->cfl = cfl;
    scene.mpm->order = order;
    return scene;
}

constexpr double duration = 4.0;

void measure_speed(double h) {
    Body body = test::filled_body(column(h, 2, 0.4, scene::UpdateOrder::usl));
    Sorter sorter(body);
    double spent[6] = {};
    std::int64_t steps = 0;
    double time = 0.0;
    while (time < duration) {
        const double dt = courant_step(body, 0.4);
        double at = cpu_seconds();
        const auto lap = [&](int verb) {
            const double now = cpu_seconds();
            spent[verb] += now - at;
            at = now;
        };
        if (body.points.size() >= least_points_to_sort && steps % steps_between_sorts == 0) {
            sorter.sort(body);
        }
        lap(0);
        clear(body.grid);
        lap(1);
        body.verbs.particle_to_grid(body);
        lap(2);
        update_momentum(body, dt);
        lap(3);
        body.verbs.grid_to_particle(body, dt);
        lap(4);
        body.verbs.update_stress(body, dt);
        lap(5);
        time += dt;
        ++steps;
    }
    const double work = static_cast<double>(body.points.size()) * static_cast<double>(steps);
    double sum = 0.0;
    for (const double s : spent) sum += s;
    std::printf("%7zu %7ld %8.2f %8.1f %6.1f %6.1f %6.1f %6.1f %6.1f %12.2f\n", body.points.size(),
                static_cast<long>(steps), sum, 1e9 * spent[0] / work, 1e9 * spent[1] / work,
                1e9 * spent[2] / work, 1e9 * spent[3] / work, 1e9 * spent[4] / work,
                1e9 * spent[5] / work, 1e-6 * work / sum);
    std::fflush(stdout);
}

struct Run {
    double x99;
    double seconds;
    double numerical_share;
};

Run run(const scene::Scene& scene) {
    Body body = test::filled_body(scene);
    const Energy start = energy_of(body);
    const double began = cpu_seconds();
    test::advance(body, scene, duration);
    return {runout_of(body.points, {1}, 0.0).all, cpu_seconds() - began,
            numerical_share(start, energy_of(body))};
}

void measure_errors() {
    struct Setting {
        double h;
        int points;
        double cfl;
        scene::UpdateOrder order;
    };
    using enum scene::UpdateOrder;
    const Run finest = run(column(0.25, 3, 0.4, usl));
    std::printf(
        "reference: h 0.25 m, 3 x 3 points, CFL 0.4, usl: x99 %.2f m at %.0f s, %.1f s CPU\n",
        finest.x99, duration, finest.seconds);
    std::printf("    h  points   CFL order    x99   error  numerical   CPU s\n");
    for (const Setting& s :
         {Setting{2.0, 2, 0.4, usl}, Setting{1.0, 1, 0.4, usl}, Setting{1.0, 2, 0.8, usl},
          Setting{1.0, 2, 0.4, usl}, Setting{1.0, 2, 0.1, usl}, Setting{1.0, 2, 0.4, musl},
          Setting{1.0, 3, 0.4, usl}, Setting{1.0, 4, 0.4, usl}, Setting{0.5, 2, 0.8, usl},
          Setting{0.5, 2, 0.4, usl}, Setting{0.5, 2, 0.4, musl}, Setting{0.5, 3, 0.4, usl},
          Setting{0.25, 2, 0.8, usl}, Setting{0.25, 2, 0.4, usl}}) {
        const Run r = run(column(s.h, s.points, s.cfl, s.order));
        std::printf("%5.2f %3d x %d %5.1f %5s %6.2f %+6.1f %% %+8.1f %% %7.2f\n", s.h, s.points,
                    s.points, s.cfl, s.order == usl ? "usl" : "musl", r.x99,
                    100.0 * (r.x99 / finest.x99 - 1.0), 100.0 * r.numerical_share, r.seconds);
        std::fflush(stdout);
    }
}

}  // namespace
}  // namespace breach::mpm

int main(int argc, char** argv) {
    using namespace breach::mpm;
    if (argc == 2 && std::strcmp(argv[1], "speed") == 0) {
        std::printf(
            "column, Mohr-Coulomb, friction, anti-locking, gap closure, usl, CFL 0.4, to %.0f s\n",
            duration);
        std::printf(
            " points   steps    CPU s   sort ns  clear    p2g   grid    g2p stress   M steps/s\n");
        for (const double h : {1.0, 0.4, 0.2}) measure_speed(h);
        return 0;
    }
    if (argc == 2 && std::strcmp(argv[1], "error") == 0) {
        measure_errors();
        return 0;
    }
    std::fprintf(stderr, "usage: mpm_benchmark speed | error\n");
    return 2;
}
