// Runout of a released column of sand, against the published scaling and another code.
#include <fstream>
#include <sstream>

#include "mpm_solver/measure/overlap.hpp"
#include "mpm_solver/measure/runout.hpp"
#include "tests/unit/mpm/bodies.hpp"
#include "tests/verification/mpm/report.hpp"

namespace breach::mpm::test::column_runout_test {
namespace {

scene::Scene column(double L_0, double height, double h, double E, double c, double mu) {
    scene::Scene scene = one_soil(sand(E, 0.3, c, 30.0), 1800.0, rectangle(0, 0, L_0, height), h,
                                  8.0 * L_0, std::ceil(1.2 * height / h) * h);
    scene.gravity = 9.81;
    scene.mpm->left = scene::Wall::roller;
    scene.mpm->floor.friction = {{0.0, 8.0 * L_0, mu}};
    return scene;
}

struct End {
    Runout runout;
    double volume_ratio;
    double overlap;
    double numerical_share;
};

End run(const scene::Scene& scene, double toe, double seconds) {
    Body body = filled_body(scene);
    const Energy start = energy_of(body);
    const double volume = volume_of(body.points, {1});
    advance(body, scene, seconds);
    const Energy end = energy_of(body);
    const End result{runout_of(body.points, {1}, toe), volume_of(body.points, {1}) / volume,
                     OverlapMeter(body, 1.0).measure(body, {1}), numerical_share(start, end)};
    std::printf("    x99 %.2f m, largest %.2f m, volume ratio %.3f, overlap %.3f, numerical %.3f\n",
                toe + result.runout.all, toe + result.runout.largest, result.volume_ratio,
                result.overlap, result.numerical_share);
    return result;
}

struct Reference {
    double x50;
    double x99;
};

/// The row of the reference's history at this time: t, energies (3), x50, x95, x99, ...
Reference reference_at(double time) {
    std::ifstream file(BREACH_ROOT "/tests/verification/mpm/cbgeo_column_history.csv");
    std::string line;
    Reference best{};
    double nearest = 1e300;
    while (std::getline(file, line)) {
        if (line.empty() || line[0] == '#' || line[0] == 't') continue;
        std::stringstream cells(line);
        std::vector<double> row;
        for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
        if (std::abs(row[0] - time) > nearest) continue;
        nearest = std::abs(row[0] - time);
        best = {row[4], row[6]};
    }
    EXPECT_LT(nearest, 0.1) << "reference data is missing";
    return best;
}

scene::Scene reference_column() {
    scene::Scene scene = column(10.0, 20.0, 1.0, 20e6, 1e3, 0.5);
    std::get<materials::MohrCoulomb>(scene.materials[0].law).tension_cutoff = 500.0;
    scene.mpm->domain_x = {0.0, 60.0};
    scene.mpm->floor.friction = {{0.0, 60.0, 0.5}};
    return scene;
}

// CB-Geo MPM: the same section, pure FLIP without affine part, no objective rate, no anti-locking,
// no gap closure, USF, larger GIMP domains. 10 %: more than these differences explain would be a
// defect.
TEST(ReferenceColumn, WithItsSettingsIsNearAnotherCode) {
    scene::Scene scene = reference_column();
    scene.mpm->blending_rate = 0.0;
    scene.mpm->anti_locking = scene::AntiLocking::off;
    scene.mpm->gap_closure = false;
    scene.mpm->cfl = 0.2;
    const Reference reference = reference_at(4.0);
    const End end = run(scene, 0.0, 4.0);
    expect_error_within("x99 at 4 s against CB-Geo", end.runout.all / reference.x99 - 1.0, 0.10);
}

}  // namespace
}  // namespace breach::mpm::test::column_runout_test
