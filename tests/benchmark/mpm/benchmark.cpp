// mpm_benchmark speed [seconds of the collapse [set [threads]]]: particle-steps per CPU second in a
// column collapse, by operation, instruction set, threads and number of points, with the error;
// with a set, 20,000 points with that set only. mpm_benchmark error: runout error against CPU
// seconds over cell size, points per cell and Courant number.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <numeric>

#include "core/scene/words.hpp"
#include "mpm_solver/measure/runout.hpp"
#include "tests/unit/mpm/memory.hpp"

namespace breach::mpm {
namespace {

double cpu_seconds() {
    timespec used{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
    return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

scene::Scene column(double h, int fill_points, double cfl) {
    scene::Scene scene = test::tall_column(h, fill_points);
    scene.mpm->cfl = cfl;
    return scene;
}

constexpr double duration = 4.0;

constexpr int verbs = 6;

struct Speed {
    std::size_t points;
    std::int64_t steps;
    double spent[verbs];  ///< CPU seconds
    double wall;
    double x99;
    double numerical_share;

    double work() const { return static_cast<double>(points) * static_cast<double>(steps); }
    double cpu() const { return std::accumulate(spent, spent + verbs, 0.0); }
};

Speed collapse(double h, double end, const Computing& computing) {
    const scene::Scene scene = column(h, 2, 0.4);
    Body body = make_body(scene, zoned_points(scene, fill_section(scene).state, "column"), "column",
                          computing);
    const Energy start = energy_of(body);
    Speed speed{.points = body.points.size(),
                .steps = 0,
                .spent = {},
                .wall = 0.0,
                .x99 = 0.0,
                .numerical_share = 0.0};
    const auto began = std::chrono::steady_clock::now();
    for (double time = 0.0; time < end; ++speed.steps) {
        const double dt = courant_step(body, 0.4);
        double at = cpu_seconds();
        const auto lap = [&](int verb) {
            const double now = cpu_seconds();
            speed.spent[verb] += now - at;
            at = now;
        };
        keep_sorted(body);
        lap(0);
        clear(body.grid);
        lap(1);
        particle_to_grid(body, dt);
        lap(2);
        update_momentum(body, dt);
        lap(3);
        grid_to_particle(body, dt);
        lap(4);
        update_stress(body, dt);
        lap(5);
        time += dt;
    }
    speed.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    speed.x99 = runout_of(body.points, {1}, 0.0).all;
    speed.numerical_share = test::numerical_share(start, energy_of(body));
    return speed;
}

const char* name_of(InstructionSet instructions) {
    switch (instructions) {
        case InstructionSet::avx512:
            return "avx512";
        case InstructionSet::avx2:
            return "avx2";
        case InstructionSet::plain:
            break;
    }
    return "plain";
}

void measure_speed(double h, double end, const Computing& computing) {
    const Speed s = collapse(h, end, computing);
    std::printf("%7zu %6ld %7s %7d %7.2f", s.points, static_cast<long>(s.steps),
                name_of(computing.instructions), computing.threads, s.cpu());
    for (const double spent : s.spent) std::printf(" %6.1f", 1e9 * spent / s.work());
    std::printf(" %8.2f %8.2f %7.2f %+7.1f %% %7.0f\n", 1e-6 * s.work() / s.cpu(),
                1e-6 * s.work() / s.wall, s.x99, 100.0 * s.numerical_share,
                test::bytes_per_point(column(h, 2, 0.4)));
    std::fflush(stdout);
}

void print_head(double end) {
    std::printf(
        "column 10 x 20 m, Mohr-Coulomb, friction, anti-locking, gap closure, usl, CFL 0.4, to "
        "%.1f s\nper verb: ns per particle-step\n",
        end);
    std::printf(
        " points  steps     set threads   CPU s   sort  clear    p2g   grid    g2p stress    "
        "M/CPU s  M/wall s    x99 numerical bytes/pt\n");
}

void measure_speeds(double end) {
    print_head(end);
    const InstructionSet best = best_instruction_set();
    for (const double h : {1.0, 0.4, 0.2}) measure_speed(h, end, {.instructions = best});
    if (best == InstructionSet::avx512) {
        measure_speed(0.2, end, {.instructions = InstructionSet::avx2});
    }
    measure_speed(0.2, end, {.instructions = InstructionSet::plain});
    measure_speed(0.2, end, {.threads = 2, .instructions = best});
    measure_speed(0.1, end, {.instructions = best});
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
            test::numerical_share(start, energy_of(body))};
}

void measure_errors() {
    struct Setting {
        double h;
        int points;
        double cfl;
    };
    const Run finest = run(column(0.25, 3, 0.4));
    std::printf("reference: h 0.25 m, 3 x 3 points, CFL 0.4: x99 %.2f m at %.0f s, %.1f s CPU\n",
                finest.x99, duration, finest.seconds);
    std::printf("    h  points   CFL    x99   error  numerical   CPU s\n");
    for (const Setting& s : {Setting{2.0, 2, 0.4}, Setting{1.0, 1, 0.4}, Setting{1.0, 2, 0.8},
                             Setting{1.0, 2, 0.4}, Setting{1.0, 2, 0.1}, Setting{1.0, 3, 0.4},
                             Setting{1.0, 4, 0.4}, Setting{0.5, 2, 0.8}, Setting{0.5, 2, 0.4},
                             Setting{0.5, 3, 0.4}, Setting{0.25, 2, 0.8}, Setting{0.25, 2, 0.4}}) {
        const Run r = run(column(s.h, s.points, s.cfl));
        std::printf("%5.2f %3d x %d %5.1f %6.2f %+6.1f %% %+8.1f %% %7.2f\n", s.h, s.points,
                    s.points, s.cfl, r.x99, 100.0 * (r.x99 / finest.x99 - 1.0),
                    100.0 * r.numerical_share, r.seconds);
        std::fflush(stdout);
    }
}

}  // namespace
}  // namespace breach::mpm

int main(int argc, char** argv) {
    using namespace breach::mpm;
    if (argc >= 2 && std::strcmp(argv[1], "speed") == 0) {
        const double end = argc > 2 ? std::strtod(argv[2], nullptr) : duration;
        if (argc == 3 || argc == 2) {
            measure_speeds(end);
            return 0;
        }
        using enum InstructionSet;
        const int threads = argc > 4 ? std::atoi(argv[4]) : 1;
        for (const InstructionSet set : {plain, avx2, avx512}) {
            if (argc > 5 || threads < 1 || std::strcmp(argv[3], name_of(set)) != 0) continue;
            if (set > best_instruction_set()) break;
            print_head(end);
            measure_speed(0.2, end, {.threads = threads, .instructions = set});
            return 0;
        }
    }
    if (argc == 2 && std::strcmp(argv[1], "error") == 0) {
        measure_errors();
        return 0;
    }
    std::fprintf(
        stderr,
        "usage: mpm_benchmark speed [seconds of the collapse [plain | avx2 | avx512, as far "
        "as the CPU has it [threads]]] | error\n");
    return 2;
}
