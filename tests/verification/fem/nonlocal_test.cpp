// Averages of the softening strain over a soil's length, on a mesh at rest whose strains are given.
// The band that follows from them: shear_band.py.
#include "fem_solver/model/nonlocal.hpp"

#include <nlohmann/json.hpp>

#include "core/materials/nonlocal.hpp"
#include "tests/verification/fem/bench.hpp"

namespace breach::fem::nonlocal_test {
namespace {

using nlohmann::json;

constexpr int across = 40;
constexpr double length = 2.0, end_of_softening = 0.1;  // on elements of 1 m

json softening_block(int elements, const char* kind = "bbar") {
    const double size = elements;
    json scene = bench::scene_of({.width = size,
                                  .height = size,
                                  .columns = elements,
                                  .rows = elements,
                                  .law = {{"type", "mohr_coulomb"},
                                          {"E_MPa", 20},
                                          {"nu", 0.3},
                                          {"c_kPa", 10},
                                          {"phi_deg", 20},
                                          {"softening",
                                           {{"epsilon_q_start", 0.0},
                                            {"epsilon_q_end", end_of_softening},
                                            {"c_residual_kPa", 1},
                                            {"phi_residual_deg", 10}}}}});
    scene["materials"]["soil"]["nonlocal_length"] = length;
    scene["fem"]["element"] = kind;
    return scene;
}

std::size_t element_at(int column, int row) {
    return static_cast<std::size_t>(row) * across + static_cast<std::size_t>(column);
}

/// A mesh at rest and the end of a step in which some elements have strained.
struct Step {
    explicit Step(const json& scene)
        : model(bench::model_of(bench::parse(scene))), old(at_rest(model)), trial(old) {}
    void strain(std::size_t element, double by) {
        for (std::size_t g = 0; g < model.points_per_element; ++g)
            trial.points[element * model.points_per_element + g].epsilon_q += by;
    }
    void share() { model.nonlocal->share(model, old, trial); }
    double growth(std::size_t element) const {
        const std::size_t p = element * model.points_per_element;
        return trial.points[p].epsilon_q - old.points[p].epsilon_q;
    }
    Model model;
    Motion old, trial;
};

TEST(NonlocalFem, AUniformStrainStaysWhatItIsUpToTheBoundaries) {
    for (const char* kind : {"bbar", "ssp"}) {
        Step step(softening_block(across, kind));
        for (std::size_t e = 0; e < step.model.mesh.quads.size(); ++e) step.strain(e, 0.01);
        step.share();
        for (std::size_t e = 0; e < step.model.mesh.quads.size(); ++e)
            EXPECT_NEAR(step.growth(e), 0.01, 1e-15) << kind << " " << e;
    }
}

TEST(NonlocalFem, TwoElementsAwayFromTheBoundaryGiveEachOtherTheSame) {
    const std::size_t a = element_at(20, 20), b = element_at(23, 19);
    Step from_a(softening_block(across)), from_b(softening_block(across));
    from_a.strain(a, 0.01);
    from_b.strain(b, 0.01);
    from_a.share();
    from_b.share();
    EXPECT_GT(from_a.growth(b), 0.0);
    EXPECT_NEAR(from_a.growth(b), from_b.growth(a), 1e-15);
    EXPECT_EQ(from_a.growth(a), 0.0) << "the weight of an element for itself is 0";
    // The weights of all others, from one; round-off decides who lies within 3 l.
    double sum = 0.0;
    for (std::size_t e = 0; e < from_a.model.mesh.quads.size(); ++e) sum += from_a.growth(e);
    EXPECT_NEAR(sum, 0.01, 1e-8);
    const double near = materials::nonlocal_weight(1.0, length);
    const double far = materials::nonlocal_weight(3.0, length);
    EXPECT_NEAR(from_a.growth(element_at(21, 20)) / from_a.growth(element_at(23, 20)), near / far,
                1e-12);
}

TEST(NonlocalFem, ASingleElementKeepsItsPointsStrains) {
    Step step(softening_block(1));
    step.trial.points[0].epsilon_q = 0.01;
    step.trial.points[3].epsilon_q = 0.02;
    step.share();
    EXPECT_EQ(step.trial.points[0].epsilon_q, 0.01);
    EXPECT_EQ(step.trial.points[1].epsilon_q, 0.0);
    EXPECT_EQ(step.trial.points[3].epsilon_q, 0.02);
}

TEST(NonlocalFem, SpentAndAbsentElementsNeitherGiveNorTake) {
    const std::size_t spent = element_at(10, 12), absent = element_at(11, 12),
                      sound = element_at(12, 12), beside = element_at(13, 12);
    Step step(softening_block(across));
    step.model.absent.assign(step.model.mesh.quads.size(), 0);
    step.model.absent[absent] = 1;
    for (std::size_t g = 0; g < 4; ++g)
        step.old.points[4 * spent + g].epsilon_q = 6.0 * end_of_softening;
    step.trial = step.old;
    step.strain(spent, 1.0);
    step.share();
    EXPECT_EQ(step.growth(spent), 1.0);
    EXPECT_EQ(step.growth(beside), 0.0);
    step.trial = step.old;
    step.strain(sound, 0.01);
    step.share();
    EXPECT_GT(step.growth(beside), 0.0);
    EXPECT_EQ(step.growth(spent), 0.0);
    EXPECT_EQ(step.growth(absent), 0.0);
}

TEST(NonlocalFem, StrainsDoNotCrossIntoAnotherRegion) {
    json scene = softening_block(across);
    json& regions = scene["section"]["regions"];
    json upper = regions[0];
    const int half = across / 2;
    regions[0]["polygon"] = {{0, 0}, {across, 0}, {across, half}, {0, half}, {0, 0}};
    upper["polygon"] = {{0, half}, {across, half}, {across, across}, {0, across}, {0, half}};
    upper["name"] = "upper";
    regions.push_back(upper);
    for (json& each : regions) each["mesh"]["divisions"] = {across, half};
    Step step(scene);
    step.strain(element_at(10, half - 1), 0.01);
    step.share();
    EXPECT_GT(step.growth(element_at(10, half - 2)), 0.0);
    EXPECT_EQ(step.growth(element_at(10, half)), 0.0);
}

TEST(NonlocalFem, StrainsAreScaledToTheWidthOfTheBand) {
    json scene = softening_block(across);
    scene["mpm"] = {{"cell_size", 1},         {"domain_x", {0, 60}},
                    {"domain_y", {0, 50}},    {"floor", {{"level", 0}}},
                    {"duration", 1},          {"runout", {{"toe", {24, 0}}}},
                    {"softening_length", 0.5}};
    Step step(scene);
    for (std::size_t e = 0; e < step.model.mesh.quads.size(); ++e) step.strain(e, 0.01);
    step.share();
    const double scale = 0.5 / (scene::band_in_nonlocal_lengths_of_fem * length);
    EXPECT_NEAR(step.growth(0), 0.01 / scale, 1e-13);
}

TEST(NonlocalFem, SoilThatDoesNotSoftenOverALengthHasNoWeights) {
    json scene = softening_block(2);
    scene["materials"]["soil"].erase("nonlocal_length");
    EXPECT_EQ(bench::model_of(bench::parse(scene)).nonlocal, nullptr);
}

}  // namespace
}  // namespace breach::fem::nonlocal_test
