// Stiff and extreme wet cases: the right result or a clear stop.
#include <fstream>

#include "tests/verification/fem/wet.hpp"

namespace breach::fem::wet_stiff_test {
namespace {

using bench::expect_error;
using bench::Steps;
using bench::terzaghi;
using bench::WetColumn;
using nlohmann::json;

/// A column loaded at once for 100 s, in 100 steps: base pressure over the undrained one.
double undrained_base(const WetColumn& column) {
    Model model = column.model();
    model.water = bench::water_of(model, {column.fluid(column.k)}, column.H, Vec2::Zero());
    Steps steps(std::move(model));
    steps.load_top(column.H, 1e5);
    steps.advance(100.0, 100);
    return steps.p_at(0.0) / (1e5 * column.share());
}

TEST(WetExtreme, PermeabilityOf1e12And1SideBySideStayApart) {
    json scene = WetColumn{.H = 5.0, .rows = 10}.scene();
    json lower = scene["section"]["regions"][0], upper = lower;
    upper["name"] = "open";
    upper["material"] = "gravel";
    upper["polygon"] = {{0, 5}, {1, 5}, {1, 10}, {0, 10}, {0, 5}};
    scene["section"]["regions"] = {lower, upper};
    scene["materials"]["gravel"] = scene["materials"]["soil"];
    scene["materials"]["soil"]["permeability"] = {1e-12, 1e-12};
    scene["materials"]["gravel"]["permeability"] = {1.0, 1.0};
    scene["fem"]["supports"][0]["to"] = {0, 10};
    scene["fem"]["supports"][1]["to"] = {1, 10};
    scene["fem"]["crest"] = {1, 10};
    scene["fem"]["water"]["line"] = {{0, 10}};
    scene["fem"]["newmark_beta"] = 4.0 / 9;
    scene["fem"]["newmark_gamma"] = 5.0 / 6;
    scene["fem"]["surcharge"] = {{{"from", 0}, {"to", 1}, {"pressure_kPa", 100}}};
    scene["fem"]["stages"] = {{{"type", "dynamic"},
                               {"name", "load"},
                               {"laws", "elastic"},
                               {"duration", 100},
                               {"time_step", 1}}};
    bench::Run run(scene);
    const Course& done = run.go();
    const auto p = [&](double y) {
        return done.motion.p[static_cast<Eigen::Index>(nearest_node(done.model.mesh, {0.0, y}))];
    };
    const double p_0 = 1e5 * WetColumn{}.share();
    expect_error("tight below: base pressure against undrained", std::abs(p(0.0) / p_0 - 1), 5e-3);
    expect_error("open above: pressure left over the load", std::abs(p(7.5)) / 1e5, 5e-3);
}

TEST(WetExtreme, PoissonsRatioOf04999IsUndrainedExactly) {
    expect_error("nu 0.4999, k 1e-12: base pressure",
                 std::abs(undrained_base({.nu = 0.4999, .k = 1e-12}) - 1.0), 1e-6);
}

TEST(WetExtreme, WaterAThousandTimesStifferIsUndrainedExactly) {
    expect_error("K_f x 1000: base pressure",
                 std::abs(undrained_base({.k = 1e-12, .K_f = 2.2e12}) - 1.0), 1e-6);
}

TEST(WetExtreme, OneElementThickLayersAndAspect100AreUndrained) {
    // One element between base and drain: its pressure is all gradient, of which the stabilisation
    // stores a little (in finer meshes only the drained row has one).
    expect_error("a single element: base pressure",
                 std::abs(undrained_base({.k = 1e-12, .rows = 1}) - 1.0), 2e-3);
    expect_error("aspect 1:100: base pressure",
                 std::abs(undrained_base({.H = 0.2, .k = 1e-14, .rows = 20}) - 1.0), 1e-3);
}

TEST(WetExtreme, ATimeStepAHundredTimesTooLargeStaysBoundedAndEndsDrained) {
    const WetColumn column;
    Model model = column.model();
    model.water = bench::water_of(model, {column.fluid(column.k)}, column.H, Vec2::Zero());
    Steps steps(std::move(model));
    steps.load_top(column.H, 1e5);
    double largest = 0.0;
    for (int k = 1; k <= 40; ++k) {
        steps.advance(column.time_of(0.5 * k), 1);  // a step of T_v = 0.5 instead of 0.005
        largest = std::max(largest, steps.now.p.lpNorm<Eigen::Infinity>());
    }
    EXPECT_LE(largest, 1.1e5);
    expect_error("pressure left over the load", steps.now.p.lpNorm<Eigen::Infinity>() / 1e5, 1e-3);
}

TEST(WetExtreme, ThreeGEndsClearly) {
    const bench::Folder folder;
    const auto file = folder.path() / "strong.txt";
    std::ofstream motion(file);
    for (int i = 0; i <= 200; ++i) motion << 0.005 * i << ' ' << std::sin(0.0628 * i) << '\n';
    motion.close();
    bench::Block block{.width = 10.0, .height = 10.0, .columns = 5, .rows = 10};
    block.law = {
        {"type", "mohr_coulomb"}, {"E_MPa", 50}, {"nu", 0.3}, {"c_kPa", 2}, {"phi_deg", 30}};
    block.stages.push_back(
        {{"type", "dynamic"}, {"name", "shaking"}, {"duration", 1.0}, {"time_step", 0.005}});
    json scene = bench::scene_of(block);
    json& fem = scene["fem"];
    fem["supports"] = json::array({scene["fem"]["supports"][2]});
    fem["element"] = "ssp";
    fem["water"] = {{"line", {{0, 9}}}};
    fem["base"] = {{"density", 2300}, {"V_s", 760}};
    fem["free_field"] = {{"width", 2}};
    fem["motion"] = {{"file", file.string()}, {"scale_to_pga_g", 3.0}};
    scene["materials"]["soil"]["void_ratio"] = 0.8;
    scene["materials"]["soil"]["permeability"] = {1e-6, 1e-6};
    bench::Run run(scene);
    try {
        run.go();
        std::printf("    reached the end with %lld cut steps\n",
                    static_cast<long long>(run.course().position.cut_steps));
    } catch (const fault::Breakdown& breakdown) {
        std::printf("    %s\n", breakdown.what());
    }
    EXPECT_TRUE(run.course().motion.u.allFinite());
    EXPECT_TRUE(run.course().motion.p.allFinite());
}

}  // namespace
}  // namespace breach::fem::wet_stiff_test
