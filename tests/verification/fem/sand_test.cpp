// PM4Sand in the mesh: an element equals the point, the switch from elastic stages happens once, an
// impossible strain is refused, and a resumed run repeats every bit.
#include <cmath>
#include <numbers>

#include "core/check/check.hpp"
#include "core/materials/pm4sand/fields.hpp"
#include "element_bench/specimen.hpp"
#include "fem_solver/checkpoint.hpp"
#include "fem_solver/solve/memory.hpp"
#include "tests/verification/fem/begun_element.hpp"

namespace breach::fem::sand_test {
namespace {

namespace pm4sand = materials::pm4sand;
using bench::expect_error;
using nlohmann::json;

const json tailings{{"type", "pm4sand"}, {"D_R", 0.35}, {"G_0", 476},
                    {"h_po", 2.7},       {"Q", 11.998}, {"R", 3.75}};

json element_scene(const std::string& element) {
    json scene = bench::scene_of({.law = tailings, .gravity = 0.0});
    scene["fem"]["element"] = element;
    return scene;
}

/// One element under a uniform effective stress, its top pushed sideways at constant volume.
struct ShearedElement : bench::BegunElement {
    explicit ShearedElement(const std::string& element)
        : BegunElement(element_scene(element), Voigt(-50e3, -100e3, -50e3, 0.0)) {}
    const std::vector<pm4sand::State>& memory() const {
        return std::get<materials::ZoneMemory<materials::PM4Sand>>(now.memory.at(0)).points;
    }
    Geometry shear(double gamma) {
        return move([&](const Vec2& x) { return Vec2(gamma * x.y(), 0.0); });
    }
};

TEST(SandInTheMesh, AnElementInUndrainedShearGivesWhatTheBenchGives) {
    for (const std::string element : {"ssp", "bbar"}) {
        ShearedElement sheared(element);
        const auto& law = std::get<materials::PM4Sand>(sheared.laws[0]);
        element_bench::Specimen specimen{element_bench::SandPoint{
            law.ready, law.options,
            pm4sand::initialise(law.ready, Voigt(-50e3, -100e3, -50e3, 0.0))}};
        double worst = 0.0, gamma = 0.0;
        constexpr int steps = 400;
        for (int n = 1; n <= steps; ++n) {
            const double next = 5e-3 * std::sin(4.0 * std::numbers::pi * n / steps);
            specimen = element_bench::driven(specimen, element_bench::Boundary::undrained_shear,
                                             next - gamma, 0.0)
                           .specimen;
            gamma = next;
            ASSERT_EQ(sheared.shear(gamma), Geometry::sound);
            for (const State& point : sheared.now.points) {
                worst = std::max(
                    worst, (point.sigma - element_bench::stress(specimen)).cwiseAbs().maxCoeff());
            }
        }
        // Strains are differences of displacements: their last digits differ from the bench's.
        expect_error(element + ": stress against the element bench over 100 kPa", worst / 1e5,
                     1e-7);
    }
}

TEST(SandInTheMesh, BeginsExactlyOnce) {
    ShearedElement sheared("ssp");
    ASSERT_EQ(sheared.shear(1e-3), Geometry::sound);
    const pm4sand::State before = sheared.memory().at(0);
    begin_memory(sheared.model, sheared.now);
    EXPECT_EQ(sheared.memory().size(), 1u);
    EXPECT_EQ(sheared.memory().at(0).z_cum, before.z_cum);
    EXPECT_EQ(sheared.memory().at(0).s.x, before.s.x);
}

TEST(SandInTheMesh, CountsTheStressThatDoesNotFit) {
    const Model model = bench::model_of(bench::parse(element_scene("ssp")));
    Motion motion = at_rest(model);
    motion.points[0].sigma = Voigt(-20e3, -100e3, -36e3, 0.0);  // K_0 = 0.2 lies outside
    const StressBias bias = begin_memory(model, motion);
    EXPECT_EQ(bias.points, 1u);
    // OpenSees moves this stress by 14.29 kPa horizontally
    // (docs/reference/methods/pm4sand_integration.md, 17); nodal forces must not change.
    EXPECT_GT(bias.largest, 1e3);
    expect_error("stress returned at the switch",
                 std::abs(motion.points[0].sigma[0] + 20e3) / 100e3, 1e-12);
}

TEST(SandInTheMesh, RefusesAnImpossibleStrainAtOnce) {
    ShearedElement sheared("ssp");
    EXPECT_EQ(sheared.shear(0.5), Geometry::degenerate);
    EXPECT_EQ(sheared.shear(std::nan("")), Geometry::degenerate);
    EXPECT_EQ(sheared.shear(1e-4), Geometry::sound);
    EXPECT_LT(sheared.force.memory_pass().evaluations(), 100);
}

TEST(SandInTheMesh, MemorySurvivesACheckpointToTheLastBit) {
    ShearedElement sheared("ssp");
    ASSERT_EQ(sheared.shear(3e-3), Geometry::sound);
    ASSERT_EQ(sheared.shear(-2e-3), Geometry::sound);
    const scene::Scene scene = bench::parse(element_scene("ssp"));
    Kept kept;
    kept.motion = sheared.now;
    const auto archive = checkpoint_archive(kept, {}, scene);
    ShearedElement resumed("ssp");
    resumed.now = checkpoint_from(archive, scene, resumed.model, "memory").kept.motion;
    resumed.trial = resumed.now;
    for (ShearedElement* each : {&sheared, &resumed}) {
        ASSERT_EQ(each->shear(1e-3), Geometry::sound);
        ASSERT_EQ(each->shear(4e-3), Geometry::sound);
    }
    EXPECT_EQ(sheared.now.points.at(0).sigma, resumed.now.points.at(0).sigma);
    const auto numbers = [](const pm4sand::State& state) {
        std::vector<double> all;
        for_each_number(state, [&](double x) { all.push_back(x); });
        return all;
    };
    EXPECT_EQ(numbers(sheared.memory().at(0)), numbers(resumed.memory().at(0)));
}

TEST(SandInTheMesh, AZoneWithoutMemoryStandsBesideItInTheCheckpoint) {
    json scene = element_scene("bbar");
    scene["materials"]["rock"] = {
        {"density", 2000.0}, {"law", {{"type", "linear_elastic"}, {"E_MPa", 20}, {"nu", 0.3}}}};
    json rock = scene["section"]["regions"][0];
    rock["name"] = "rock";
    rock["material"] = "rock";
    for (json& corner : rock["polygon"]) corner[0] = corner[0].get<double>() - 1.0;
    scene["section"]["regions"].insert(scene["section"]["regions"].begin(), rock);
    scene["fem"]["supports"] = {
        {{"name", "base"}, {"from", {-1, 0}}, {"to", {1, 0}}, {"fixes", "xy"}}};
    const scene::Scene parsed = bench::parse(scene);
    const Model model = bench::model_of(parsed);
    Kept kept;
    kept.motion = at_rest(model);
    for (State& point : kept.motion.points) point.sigma = Voigt(-50e3, -100e3, -50e3, 0.0);
    begin_memory(model, kept.motion);
    EXPECT_EQ(points_with_memory(model, kept.motion), 4u) << "of eight";
    auto archive = checkpoint_archive(kept, {}, parsed);
    const Motion back = checkpoint_from(archive, parsed, model, "memory").kept.motion;
    EXPECT_EQ(points_with_memory(model, back), 4u);
    archive.reals["memory"].push_back(0.0);
    EXPECT_THROW(checkpoint_from(archive, parsed, model, "memory"), fault::BadInput);
}

TEST(SandInTheMesh, RefusesALateElasticStage) {
    json late = element_scene("ssp");
    late["fem"]["stages"] = {{{"type", "static"}, {"name", "plastic"}, {"laws", "scene"}},
                             {{"type", "static"}, {"name", "elastic"}, {"laws", "elastic"}}};
    EXPECT_FALSE(check::problems_of(bench::parse(late)).faults.empty());
}

}  // namespace
}  // namespace breach::fem::sand_test
