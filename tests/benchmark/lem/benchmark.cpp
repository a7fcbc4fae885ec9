// Speed of the circle analysis, and error against effort.
//   lem_benchmark speed   circles per second on one core, and the whole Mochikoshi staging
//   lem_benchmark error   comma-separated: error in F against slices, and against the search's
//   effort
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <string>

#include "lem_tool/limit_scene.hpp"
#include "lem_tool/search.hpp"
#include "lem_tool/slip_circle.hpp"

namespace {

using namespace breach;

double seconds_since(std::chrono::steady_clock::time_point began) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
}

scene::Scene mochikoshi() {
    return lem::limit_scene(scene::read_scene(BREACH_ROOT "/workflows/scenes/mochikoshi.json"));
}

/// F of one circle, if any; includes cutting and equilibrium.
double analyse(const lem::Model& model, const lem::Surface& surface, lem::Slices& slices) {
    if (lem::cut(model.strata, model.soils, surface, model.slices, slices) != lem::Cut::done) {
        return 0.0;
    }
    return lem::bishop(slices, lem::Slide::to_right, model.k_h).factor_of_safety;
}

/// Different circles of the dam; counts only those with a factor of safety.
void circles_per_second(int wanted, const char* what, const scene::Scene& scene) {
    lem::Model model = lem::make_model(scene);
    model.slices = wanted;
    lem::Slices slices = lem::make_slices(model.strata, wanted);
    std::vector<lem::Surface> surfaces;
    for (int i = 0; i < 20; ++i) {
        for (int j = 0; j < 20; ++j) {
            const double x0 = 80.0 + 1.5 * i;
            const double x1 = 135.0 + 4.0 * j;
            const lem::Ends ends{{x0, lem::ground_level(model.strata, x0, lem::From::left)},
                                 {x1, lem::ground_level(model.strata, x1, lem::From::left)}};
            for (const double share : {0.1, 0.25, 0.4}) {
                const auto surface = lem::surface_through(ends, share * ends.largest_sagitta());
                if (analyse(model, surface, slices) > 0.0) surfaces.push_back(surface);
            }
        }
    }
    double best = 0.0;
    double sum = 0.0;
    std::size_t cuts = 0;
    for (int round = 0; round < 20; ++round) {
        const auto began = std::chrono::steady_clock::now();
        for (const lem::Surface& surface : surfaces) {
            sum += analyse(model, surface, slices);
            cuts += slices.count;
        }
        best = std::max(best, static_cast<double>(surfaces.size()) / seconds_since(began));
    }
    std::printf("%-28s %3d slices asked, %.1f cut: %.0f circles/s (best of 20 rounds of %zu)\n",
                what, wanted,
                static_cast<double>(cuts) / (20.0 * static_cast<double>(surfaces.size())), best,
                surfaces.size());
    if (!(sum > 0.0)) std::printf("no circle was analysed\n");
}

void speed() {
    scene::Scene dam = mochikoshi();
    circles_per_second(25, "Mochikoshi, 69 layer pieces", dam);
    circles_per_second(50, "Mochikoshi, 69 layer pieces", dam);
    dam.lem->water.reset();
    circles_per_second(25, "the same without water", dam);
    dam = mochikoshi();
    const lem::Model sound = lem::make_model(dam);
    double best = 1e9;
    double least_cpu = 1e9;
    for (int round = 0; round < 5; ++round) {
        const auto began = std::chrono::steady_clock::now();
        const std::clock_t cpu = std::clock();
        for (std::size_t layers = 0; layers <= dam.lem->liquefaction.size(); ++layers) {
            lem::Model model = sound;
            model.soils = lem::liquefied(sound, dam.lem->liquefaction, layers);
            (void)lem::search(model, *dam.lem->search);
        }
        best = std::min(best, seconds_since(began));
        least_cpu = std::min(least_cpu, static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC);
    }
    std::printf("Mochikoshi staging, 6 searches on one thread: %.3f s, of the processor %.3f s\n",
                best, least_cpu);
}

void error() {
    const scene::Scene dam = mochikoshi();
    lem::Model model = lem::make_model(dam);
    model.soils = lem::liquefied(model, dam.lem->liquefaction, 5);
    const lem::Surface surface = lem::search(model, *dam.lem->search).critical->surface;
    lem::Slices many = lem::make_slices(model.strata, 20000);
    model.slices = 20000;
    const double exact = analyse(model, surface, many);
    std::printf("table,slices,points_per_range,factor_of_safety,relative_error,seconds\n");
    for (const int wanted : {5, 10, 25, 50, 100, 200, 400}) {
        model.slices = wanted;
        lem::Slices slices = lem::make_slices(model.strata, wanted);
        const auto began = std::chrono::steady_clock::now();
        double F = 0.0;
        for (int n = 0; n < 1000; ++n) F = analyse(model, surface, slices);
        std::printf("slices,%d,,%.8f,%.2e,%.3e\n", wanted, F, F / exact - 1.0,
                    seconds_since(began) / 1000.0);
    }
    model.slices = 50;
    scene::SlipSearch ranges = *dam.lem->search;
    double lowest = 1e9;
    struct Row {
        int points;
        double F;
        double seconds;
    };
    std::vector<Row> rows;
    for (const int points : {4, 6, 8, 12, 16, 24, 32, 48}) {
        ranges.entry_points = ranges.exit_points = ranges.depths = points;
        const auto began = std::chrono::steady_clock::now();
        const double F = lem::search(model, ranges).critical->bishop.factor_of_safety;
        rows.push_back({points, F, seconds_since(began)});
        lowest = std::min(lowest, F);
    }
    for (const Row& row : rows) {
        std::printf("search,50,%d,%.8f,%.2e,%.3e\n", row.points, row.F, row.F / lowest - 1.0,
                    row.seconds);
    }
}

}  // namespace

int main(int argc, char** argv) {
    const std::string what = argc > 1 ? argv[1] : "speed";
    if (what != "speed" && what != "error") {
        std::printf("lem_benchmark speed | error\n");
        return 64;
    }
    what == "speed" ? speed() : error();
    return 0;
}
