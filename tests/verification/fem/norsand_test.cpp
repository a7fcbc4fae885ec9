// NorSand in the mesh: an element equals the point, its state survives a checkpoint, and a scene
// reports what is impossible.
#include <cmath>

#include "core/materials/norsand/undrained.hpp"
#include "element_bench/specimen.hpp"
#include "fem_solver/checkpoint.hpp"
#include "fem_solver/solve/memory.hpp"
#include "tests/verification/fem/begun_element.hpp"

namespace breach::fem::norsand_test {
namespace {

namespace norsand = materials::norsand;
using bench::cj1;
using bench::expect_error;
using nlohmann::json;

json element_scene(const std::string& element, double psi_0 = 0.05) {
    json scene = bench::scene_of({.law = cj1(psi_0), .gravity = 0.0});
    scene["fem"]["element"] = element;
    return scene;
}

/// One element under level ground's stress at K_0 0.7.
struct Element : bench::BegunElement {
    explicit Element(const std::string& element)
        : BegunElement(element_scene(element), Voigt(-70e3, -100e3, -70e3, 0.0)) {}
    const materials::NorSand& law() const { return std::get<materials::NorSand>(laws[0]); }
    const norsand::State& memory() const {
        return std::get<materials::ZoneMemory<materials::NorSand>>(now.memory.at(0)).points.at(0);
    }
    /// u = (gamma y + e x, -e y): simple shear, or compression in the plane at constant volume.
    Geometry strain(double gamma, double e) {
        return move([&](const Vec2& x) { return Vec2(gamma * x.y() + e * x.x(), -e * x.y()); });
    }
};

element_bench::Specimen specimen_of(const Element& element) {
    return {
        element_bench::NorSandPoint{element.law().ready, element.law().options, element.memory()}};
}

TEST(NorSandInTheMesh, AnElementShearedUndrainedGivesThePointsPathAndTheTablesPeak) {
    for (const std::string kind : {"ssp", "bbar"}) {
        Element element(kind);
        element_bench::Specimen specimen = specimen_of(element);
        double worst = 0.0, peak = 0.0;
        for (int n = 1; n <= 500; ++n) {
            const double d = 2e-5;
            specimen =
                element_bench::driven(specimen, element_bench::Boundary::undrained_shear, d, 0.0)
                    .specimen;
            ASSERT_EQ(element.strain(n * d, 0.0), Geometry::sound);
            for (const State& point : element.now.points) {
                worst = std::max(
                    worst, (point.sigma - element_bench::stress(specimen)).cwiseAbs().maxCoeff());
                peak = std::max(peak, std::abs(point.sigma[3]));
            }
        }
        expect_error(kind + ": stress in shear against the point, over 100 kPa", worst / 1e5, 1e-6);
        // The open table: tau/sigma'_v0 0.253556 with S = 1.
        expect_error(kind + ": peak of shear against the table",
                     std::abs(peak / 100e3 / 0.253556 - 1.0), 2e-4);
    }
}

/// A wet column of CJ1 under 100 kPa, 70 kPa against each wall; the right wall is unloaded over
/// 20 s, and the soil has no time to drain. The top row, whose edge is drained, may be stronger.
json wet_column(const std::string& element, double psi_0) {
    constexpr int rows = 8;
    json scene = bench::scene_of({.height = rows, .rows = rows, .law = cj1(psi_0), .gravity = 0.0});
    scene["materials"]["soil"]["void_ratio"] = 0.85;
    scene["materials"]["soil"]["permeability"] = {1e-13, 1e-13};
    json& fem = scene["fem"];
    fem["element"] = element;
    fem["water"] = {{"line", {{0, 2 * rows}}}};
    fem["supports"][2]["fixes"] = "y";
    fem["telemetry_interval"] = 0.02;
    fem["strength_interval"] = 0.5;
    fem["stages"] = {{{"type", "static"},
                      {"name", "load"},
                      {"surcharge", {{{"from", -1}, {"to", 2}, {"pressure_kPa", 100}}}}},
                     {{"type", "static"}, {"name", "norsand"}, {"laws", "scene"}},
                     {{"type", "dynamic"},
                      {"name", "release"},
                      {"release", {"right"}},
                      {"ramp", 20},
                      {"duration", 12},
                      {"time_step", 0.02}}};
    return scene;
}

// sigma_xx decreases at constant sigma_yy, both total: the column fails when half their difference
// is the peak of the law's undrained path.
TEST(NorSandInTheMesh, AWetColumnCollapsesAtThePeakOfThePoint) {
    for (const std::string kind : {"ssp", "bbar"}) {
        bench::Run run(wet_column(kind, 0.05));
        const Element point(kind);
        const double s_u = norsand::undrained_strength(point.law().ready, point.memory(), 1e9).peak;
        const Course& done = run.go();
        double past = 0.0;
        for (const Reading& reading : done.history) {
            if (reading.past_peak_share < 0.5) continue;
            past = reading.time;
            break;
        }
        EXPECT_GT(done.history.back().kinetic_energy, 1e3);
        const Reading& first = done.history.front();
        for (const double ratio : {first.strength_ratio_avg, first.strength_ratio_min})
            expect_error(kind + ": s_u over sigma'_v0 of the column against the point's",
                         std::abs(ratio * 100e3 / s_u - 1.0), 1e-3);
        // Between two evaluations the last value stays.
        EXPECT_EQ(done.history.at(1).strength_ratio_avg, first.strength_ratio_avg);
        EXPECT_LT(done.history.back().strength_ratio_min, 0.9 * first.strength_ratio_min);
        // Half the difference of the applied stresses.
        const double load = 0.5 * (30e3 + 70e3 * past / 20.0);
        expect_error(kind + ": load on a wet column past its peak, over s_u",
                     std::abs(load / s_u - 1.0), 0.02);
    }
    bench::Run standing(wet_column("ssp", -0.05));
    EXPECT_LT(standing.go().history.back().kinetic_energy, 1.0);
}

TEST(NorSandInTheMesh, AnElementCompressedUndrainedGivesThePointsPath) {
    for (const std::string kind : {"ssp", "bbar"}) {
        Element element(kind);
        element_bench::Specimen specimen = specimen_of(element);
        double worst = 0.0;
        for (int n = 1; n <= 300; ++n) {
            const double d = 5e-5;
            specimen =
                element_bench::driven(specimen, element_bench::Boundary::undrained_biaxial, d, 0.0)
                    .specimen;
            ASSERT_EQ(element.strain(0.0, n * d), Geometry::sound);
            for (const State& point : element.now.points)
                worst = std::max(
                    worst, (point.sigma - element_bench::stress(specimen)).cwiseAbs().maxCoeff());
        }
        expect_error(kind + ": stress in compression against the point, over 100 kPa", worst / 1e5,
                     1e-6);
    }
}

TEST(NorSandInTheMesh, ReportsThePeakWhereTheShearStressPassesIt) {
    Element element("ssp");
    double past = 0.0, peak_at = 0.0, largest_q = 0.0;
    for (int n = 1; n <= 500; ++n) {
        ASSERT_EQ(element.strain(0.0, n * 2e-5), Geometry::sound);
        const double q = norsand::read(element.law().ready, element.memory()).q;
        if (q > largest_q) {
            largest_q = q;
            peak_at = n * 2e-5;
        }
        if (past == 0.0 && instability(element.law(), element.memory()).past_peak) past = n * 2e-5;
    }
    EXPECT_GT(peak_at, 2e-4);
    EXPECT_NEAR(past, peak_at, 1e-4);
}

TEST(NorSandInTheMesh, MemorySurvivesACheckpointToTheLastBit) {
    Element element("ssp");
    ASSERT_EQ(element.strain(5e-4, 0.0), Geometry::sound);
    const scene::Scene scene = bench::parse(element_scene("ssp"));
    Kept kept;
    kept.motion = element.now;
    const auto archive = checkpoint_archive(kept, {}, scene);
    Element resumed("ssp");
    resumed.now = checkpoint_from(archive, scene, resumed.model, "memory").kept.motion;
    resumed.trial = resumed.now;
    for (Element* each : {&element, &resumed}) {
        ASSERT_EQ(each->strain(8e-4, 0.0), Geometry::sound);
        ASSERT_EQ(each->strain(1e-3, 2e-4), Geometry::sound);
    }
    const auto numbers = [](const norsand::State& state) {
        std::vector<double> all;
        for_each_number(state, [&](double x) { all.push_back(x); });
        return all;
    };
    EXPECT_EQ(element.now.points.at(0).sigma, resumed.now.points.at(0).sigma);
    EXPECT_EQ(numbers(element.memory()), numbers(resumed.memory()));
}

TEST(NorSandInTheMesh, LevelGroundRestsWithThePsiThatTheSceneGives) {
    for (const double psi_0 : {0.05, -0.05}) {
        bench::Run run(
            bench::scene_of({.height = 4.0,
                             .rows = 4,
                             .law = cj1(psi_0),
                             .stages = {{{"type", "static"}, {"name", "gravity"}},
                                        {{"type", "static"}, {"name", "law"}, {"laws", "scene"}},
                                        {{"type", "dynamic"},
                                         {"name", "rest"},
                                         {"duration", 0.05},
                                         {"time_step", 5e-3}}}}));
        const Reading last = run.go().history.back();
        expect_error("displacement of level ground at rest [m]", last.crest_displacement, 1e-6);
        expect_error("psi at rest", std::abs(last.psi_avg - psi_0), 1e-4);
        EXPECT_GT(last.instability_ratio_max, 0.2);
        EXPECT_LT(last.instability_ratio_max, 0.8);
        EXPECT_EQ(last.past_peak_share, 0.0);
    }
}

/// Pointer of the fault; empty: accepted.
std::string refused_at(const json& law) {
    try {
        bench::parse(bench::scene_of({.law = law}));
    } catch (const fault::BadInput& bad) {
        return bad.faults().at(0).pointer;
    }
    return "";
}

TEST(NorSandInTheMesh, ASceneSaysWhatTheSoilCannotBe) {
    const auto with = [](const char* key, const json& value) {
        json law = cj1(0.05);
        law[key] = value;
        return law;
    };
    const std::string law = "/materials/soil/law";
    EXPECT_EQ(refused_at(cj1(0.05)), "");
    EXPECT_EQ(refused_at(cj1(-0.3)), "");
    EXPECT_EQ(refused_at(cj1(0.3)), law + "/psi_0");
    EXPECT_EQ(refused_at(with("K_0", 0.1)), law + "/K_0");
    EXPECT_EQ(refused_at(with("chi_tc", 60)), law + "/chi_tc");
    EXPECT_EQ(refused_at(with("e_0", 0.8)), law + "/psi_0") << "beside psi_0";
    json none = cj1(0.05);
    none.erase("psi_0");
    EXPECT_EQ(refused_at(none), law + "/psi_0");
    json pascal = cj1(0.05);
    pascal["lambda"] = 0.06;
    pascal["Gamma"] = 1.2 + 0.06 * std::log(1000.0);
    EXPECT_EQ(refused_at(pascal), law + "/Gamma");
}

}  // namespace
}  // namespace breach::fem::norsand_test
