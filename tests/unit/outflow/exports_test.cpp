#include "services/outflow/exports.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/fault/fault.hpp"
#include "services/outflow/hec_ras.hpp"

namespace breach::outflow {
namespace {

/// A triangle of 8 m2 over 4 s with its peak of 4 m2/s at 1 s, after 0.5 s of nothing, every 0.05
/// s; `returns` flow back over the last second.
Hydrograph triangle(double returns = 0.0) {
    Hydrograph h{.section = "toe"};
    for (int k = 0; k <= 120; ++k) {
        const double t = 0.05 * k;
        const double s = std::clamp(t - 0.5, 0.0, 4.0);
        double volume = s <= 1.0 ? 2.0 * s * s : 8.0 - (4.0 - s) * (4.0 - s) * 2.0 / 3.0;
        volume -= returns * std::max(0.0, t - 5.0);
        h.discharge.push_back(h.volume.empty() ? 0.0 : (volume - h.volume.back()) / 0.05);
        h.time.push_back(t);
        h.volume.push_back(volume);
        h.mass.push_back(2000.0 * volume);
        h.depth.push_back(1.0);
        h.velocity.push_back(2.0);
    }
    return h;
}

double trapezoid(const std::vector<double>& values, double interval) {
    double sum = 0.0;
    for (std::size_t k = 1; k < values.size(); ++k)
        sum += 0.5 * (values[k - 1] + values[k]) * interval;
    return sum;
}

TEST(Ordinates, CarryExactlyWhatPassedAtAnyInterval) {
    for (const double interval : {0.05, 0.3, 1.0, 2.0, 60.0}) {
        const Ordinates flows = ordinates_of(triangle(), 72.0, interval, "test");
        EXPECT_EQ(flows.m3_per_s.front(), 0.0);
        EXPECT_EQ(flows.m3_per_s.back(), 0.0);
        EXPECT_NEAR(trapezoid(flows.m3_per_s, interval), 576.0, 1e-9) << interval;
        EXPECT_NEAR(flows.volume, 576.0, 1e-9);
        for (const double flow : flows.m3_per_s) EXPECT_GE(flow, 0.0);
    }
    // The middle of the ordinate after t = 1.5 s, one interval later, contains the peak.
    const Ordinates fine = ordinates_of(triangle(), 1.0, 0.1, "test");
    EXPECT_NEAR(fine.m3_per_s[16], 4.0, 0.15);
}

TEST(Ordinates, SoilThatComesBackIsTakenFromWhatPassedBefore) {
    const Ordinates flows = ordinates_of(triangle(3.0), 1.0, 0.5, "test");
    EXPECT_NEAR(flows.volume, 5.0, 1e-9);
    for (const double flow : flows.m3_per_s) EXPECT_GE(flow, 0.0);
}

TEST(Ordinates, WithoutAnInflowThereAreNone) {
    EXPECT_THROW(ordinates_of(triangle(9.0), 1.0, 0.5, "test"), fault::BadInput);
    EXPECT_THROW(ordinates_of(triangle(), 1.0, 1e-6, "test"), fault::BadInput);
    EXPECT_THROW(ordinates_of(triangle(), 1.0, 0.0, "test"), fault::BadInput);
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

TEST(Exports, HecRasHasOneFlowPerIntervalAndSaysWhatItIs) {
    const std::string text = as_hec_ras(triangle(), 72.0, 1.0, "test");
    const auto lines = lines_of(text);
    EXPECT_NE(lines[0].find("volume 576 m3"), std::string::npos) << lines[0];
    EXPECT_NE(lines[1].find("slurry"), std::string::npos);
    EXPECT_EQ(lines[2], "Ordinate,Simulation Time (hh:mm:ss),Flow (m3/s)");
    EXPECT_EQ(lines[3], "1,00:00:00,0");
    EXPECT_TRUE(lines[4].starts_with("2,00:00:01,"));
    EXPECT_TRUE(lines.back().ends_with(",0"));
    EXPECT_THROW(as_hec_ras(triangle(), 72.0, 0.7, "test"), fault::BadInput);
}

/// 453 m3/s for 3 s: 1359 m3; with ordinates every 60 s spread over one or two of them.
TEST(Exports, SayThePeakBeforeAndAfterAndWhereItIsLost) {
    Hydrograph h{.section = "toe"};
    for (int k = 0; k <= 600; ++k) {
        const double t = 0.1 * k, passed = 453.0 * std::clamp(t - 20.0, 0.0, 3.0);
        h.discharge.push_back(h.volume.empty() ? 0.0 : (passed - h.volume.back()) / 0.1);
        h.time.push_back(t);
        h.volume.push_back(passed);
    }
    const Ordinates coarse = ordinates_of(h, 1.0, 60.0, "test");
    EXPECT_NEAR(coarse.peak_before, 453.0, 1e-6);
    EXPECT_NEAR(coarse.peak_after, 1359.0 / 60.0, 1e-6);
    EXPECT_NE(peaks_in_words(coarse).find("The peak is lost: 453 m3/s become 22.6 m3/s"),
              std::string::npos)
        << peaks_in_words(coarse);
    EXPECT_NE(lines_of(as_hec_ras(h, 1.0, 60.0, "test"))[1].find("The peak is lost"),
              std::string::npos);
    const Ordinates fine = ordinates_of(h, 1.0, 1.0, "test");
    EXPECT_NEAR(fine.peak_after, 453.0, 1e-6);
    EXPECT_EQ(peaks_in_words(fine), "Peak 453 m3/s, of the flows every 1 s 453 m3/s.");
}

TEST(Exports, Flo2dHasHoursAndTheCell) {
    const auto lines =
        lines_of(as_flo_2d(triangle(), 72.0, 1.0, {.cell = 8672, .concentration = 0.45}, "test"));
    std::vector<std::vector<std::string>> words;
    for (const std::string& line : lines) {
        std::istringstream stream(line);
        words.emplace_back(std::istream_iterator<std::string>(stream),
                           std::istream_iterator<std::string>());
    }
    EXPECT_EQ(words[0], (std::vector<std::string>{"0", "8672"}));
    EXPECT_EQ(words[1], (std::vector<std::string>{"F", "0", "8672"}));
    EXPECT_EQ(words[2], (std::vector<std::string>{"H", "0.00000000", "0", "0.45"}));
    double volume = 0.0;
    for (std::size_t k = 3; k < words.size(); ++k) {
        EXPECT_NEAR(std::stod(words[k][1]), static_cast<double>(k - 2) / 3600.0, 1e-8);
        volume += std::stod(words[k][2]);
    }
    EXPECT_NEAR(volume, 576.0, 0.01);
    EXPECT_EQ(lines_of(as_flo_2d(triangle(), 72.0, 1.0, {}, "test"))[2].back(), '0');
}

TEST(Exports, CsvHasEveryRowAndTheBreachOnce) {
    Hydrograph cut_off = triangle();
    cut_off.warning = "The runout was cut off in motion: volumes are lower bounds.";
    for (const std::string& text : {as_csv(cut_off, {}), as_hec_ras(cut_off, 72.0, 1.0, "test")})
        EXPECT_NE(text.find("Route it with a rheology of its own. The runout was cut off"),
                  std::string::npos)
            << text;
    const auto lines = lines_of(as_csv(triangle(), BreachWidth{60, 72, 90}));
    EXPECT_EQ(lines.size(), 2U + 121U);
    EXPECT_TRUE(lines[0].starts_with("# section toe"));
    EXPECT_TRUE(lines.back().ends_with(",480,576,720")) << lines.back();
    EXPECT_EQ(lines_of(as_csv(triangle(), {}))[1],
              "time_s,discharge_m2_per_s,depth_m,velocity_m_per_s,volume_m2,mass_kg_per_m");
}

TEST(Sections, AreNamedWhereOneIsAskedForThatIsNotThere) {
    exchange::Archive history;
    history.reals = {{"time", {0.0, 1.0}}};
    for (const char* what : {"discharge", "depth", "velocity", "volume", "mass"})
        history.reals[std::string("section.toe.") + what] = {0.0, 1.0};
    EXPECT_EQ(hydrograph_in(history, "toe", "run").volume, (std::vector<double>{0.0, 1.0}));
    try {
        hydrograph_in(history, "road", "run");
        FAIL();
    } catch (const fault::BadInput& bad) {
        EXPECT_EQ(bad.faults()[0].pointer, "/section");
        EXPECT_NE(bad.faults()[0].remedy.find("toe"), std::string::npos);
    }
}

/// Value after "key" of the line that begins with it.
std::string after(const std::vector<std::string>& lines, const std::string& key) {
    for (const std::string& line : lines)
        if (line.starts_with(key)) return line.substr(key.size());
    return "none";
}

TEST(HecRas, UnsteadyFileCarriesTheVolumeInFieldsOfEight) {
    const auto lines = lines_of(as_hec_ras_unsteady(triangle(), 72.0, 2.0, Resistance::bingham,
                                                    {8700.0, 1000.0, "given"}, 0.5, "test"));
    EXPECT_EQ(after(lines, "Interval="), "2SEC");
    const std::size_t count = std::stoul(after(lines, "Flow Hydrograph="));
    EXPECT_EQ(count, ordinates_of(triangle(), 72.0, 2.0, "test").m3_per_s.size());
    const auto begin = std::ranges::find_if(
        lines, [](const std::string& line) { return line.starts_with("Flow Hydrograph="); });
    std::vector<double> flows;
    for (auto line = begin + 1; flows.size() < count; ++line)
        for (std::size_t k = 0; k + 8 <= line->size(); k += 8)
            flows.push_back(std::stod(line->substr(k, 8)));
    EXPECT_EQ(flows.size(), count);
    EXPECT_NEAR(trapezoid(flows, 2.0), 576.0, 0.01);
}

TEST(HecRas, NonNewtonianBlockHasItsMethodAndPascals) {
    const auto block = [](Resistance resistance) {
        return lines_of(as_hec_ras_unsteady(triangle(), 1.0, 1.0, resistance,
                                            {8700.0, 1000.0, "given"}, 0.45, "test"));
    };
    EXPECT_EQ(after(block(Resistance::bingham), "Non-Newtonian Method="), " 1 , ");
    EXPECT_EQ(after(block(Resistance::obrien), "Non-Newtonian Method="), " 2 , ");
    EXPECT_EQ(after(block(Resistance::herschel_bulkley), "Non-Newtonian Method="), " 4 , ");
    EXPECT_EQ(after(block(Resistance::herschel_bulkley), "Herschel-Bulkley Coef="), "1000, 1");
    const auto lines = block(Resistance::bingham);
    EXPECT_EQ(after(lines, "User Yeild="), "   8700");
    EXPECT_EQ(after(lines, "User Viscosity="), "1000");
    EXPECT_EQ(after(lines, "Non-Newtonian Constant Vol Conc="), "45");
    EXPECT_EQ(after(lines, "Herschel-Bulkley Coef="), "0, 0");
}

TEST(HecRas, RheologyIsTheMeanOfSoilsWithoutFrictionOnceTheyFlow) {
    nlohmann::json scene = {
        {"mpm", {{"runout", {{"regions", {"a", "b", "dam"}}}}}},
        {"section",
         {{"regions",
           {{{"name", "a"}, {"material", "weak"}, {"polygon", {{0, 0}, {3, 0}, {3, 1}, {0, 1}}}},
            {{"name", "b"}, {"material", "soft"}, {"polygon", {{0, 0}, {1, 0}, {1, 1}, {0, 1}}}},
            {{"name", "dam"}, {"material", "fill"}, {"polygon", {{0, 0}, {9, 0}, {9, 9}}}},
            {{"name", "far"}, {"material", "weak"}, {"polygon", {{0, 0}, {9, 0}, {9, 9}}}}}}}},
        {"materials",
         {{"weak",
           {{"viscosity", 100}, {"law", {{"type", "mohr_coulomb"}, {"c_kPa", 4}, {"phi_deg", 0}}}}},
          {"soft",
           {{"viscosity", 500},
            {"law",
             {{"type", "mohr_coulomb"},
              {"c_kPa", 30},
              {"phi_deg", 0},
              {"softening", {{"c_residual_kPa", 8}, {"phi_residual_deg", 0}}}}}}},
          {"fill", {{"law", {{"type", "mohr_coulomb"}, {"c_kPa", 2}, {"phi_deg", 33}}}}}}}};
    const Rheology found = rheology_of(scene);
    EXPECT_NEAR(found.yield_stress, 5000.0, 1e-9);
    EXPECT_NEAR(found.viscosity, 200.0, 1e-9);
    EXPECT_EQ(found.from, "mean by area of a, b");
    scene["mpm"]["runout"]["regions"] = {"dam"};
    EXPECT_THROW(rheology_of(scene), fault::BadInput);
}

TEST(Percentiles, AreANearestRunScaledToTheVolume) {
    std::vector<Hydrograph> samples;
    for (const double scale : {1.0, 4.0, 2.0, 5.0, 3.1}) {
        samples.push_back(triangle());
        for (std::vector<double>* each : {&samples.back().discharge, &samples.back().volume})
            for (double& value : *each) value *= scale;
    }
    samples.pop_back();
    samples.push_back(triangle());
    for (double& value : samples.back().volume) value *= 3.1;
    const Hydrograph median = at_percentile(samples, 50.0, "test").hydrograph;
    EXPECT_NEAR(median.volume.back(), 8.0 * 3.1, 1e-9);
    EXPECT_NE(median.warning.find("p50 of 5 runouts, times 1"), std::string::npos)
        << median.warning;
    EXPECT_THROW(at_percentile(samples, 90.0, "test"), fault::BadInput);
    while (samples.size() < 30) samples.push_back(triangle());
    const Hydrograph high = at_percentile(samples, 90.0, "test").hydrograph;
    EXPECT_NEAR(high.volume.back(), 8.0 * 2.11, 0.01);
    EXPECT_NEAR(high.discharge[30] / triangle().discharge[30], high.volume.back() / 8.0, 1e-6);
}

TEST(Breach, WidthIsANumberOrThreeThatAscend) {
    EXPECT_EQ(breach_width_from(72, "f", "/w").high, 72.0);
    EXPECT_EQ(breach_width_from({60, 72, 90}, "f", "/w").low, 60.0);
    using nlohmann::json;
    for (const json& wrong : {json(0), json(-1), json("72"), json(nullptr), json({90, 72, 60}),
                              json({60, 72}), json(json::value_t::discarded)})
        EXPECT_THROW(breach_width_from(wrong, "f", "/w"), fault::BadInput);
}

TEST(BreachWidth, IsTheScenesOrFollowsTheHeightOfItsSoilAboveTheToe) {
    nlohmann::json scene = {
        {"mpm", {{"runout", {{"toe", {0, 2}}, {"regions", {"dam"}}}}}},
        {"section",
         {{"regions",
           {{{"name", "dam"}, {"polygon", {{-40, 2}, {0, 2}, {-20, 22}}}},
            {{"name", "hill"}, {"polygon", {{-90, 0}, {-40, 0}, {-90, 80}}}}}}}}};
    const StatedWidth by_rule = stated_width(scene);
    EXPECT_DOUBLE_EQ(by_rule.width.low, 40.0);
    EXPECT_DOUBLE_EQ(by_rule.width.best, 60.0);
    EXPECT_DOUBLE_EQ(by_rule.width.high, 80.0);
    EXPECT_NE(by_rule.from.find("assumed"), std::string::npos);
    scene["mpm"]["breach_width"] = {50, 72, 90};
    EXPECT_DOUBLE_EQ(stated_width(scene).width.best, 72.0);
    EXPECT_EQ(stated_width(scene).from, "/mpm/breach_width of the scene");
}

}  // namespace
}  // namespace breach::outflow
