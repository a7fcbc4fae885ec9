#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/statistics/percentiles.hpp"
#include "services/findings/uncertainty.hpp"
#include "services/report/chapters/chapters.hpp"
#include "services/report/chart/draw.hpp"
#include "services/report/chart/page.hpp"
#include "services/report/figures/uncertainty_figures.hpp"
#include "services/report/read/samples.hpp"

namespace breach::report {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

json from_file() {
    // Made by `node tests/browser/samples.mjs 64` from a known model.
    std::ifstream stream(BREACH_ROOT "/tests/unit/report/uncertainty.json");
    return json::parse(stream);
}

void write(const fs::path& file, const json& content) {
    fs::create_directories(file.parent_path());
    std::ofstream(file) << content.dump();
}

/// The export of a static study of 64 samples, as the assessment reads it.
class Sampled : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("sampled_" + std::to_string(getpid()));
        fs::remove_all(folder_);
        const json both = from_file();
        answer_ = both.at("uncertainty");
        answer_["samples"].update({{"moving", 1}, {"doubtful", 0}, {"no_transfer", 0}});
        write(folder_ / "envelopes.json", both.at("envelopes"));
        write(folder_ / "run.json", {{"id", "01"}, {"name", "uncertain"}, {"title", "A slope"}});
        const json scene = {{"name", "slope"},
                            {"section", {{"regions", json::array()}}},
                            {"mpm",
                             {{"gauges", {{{"name", "road"}, {"x", 50.0}}}},
                              {"sections", {{{"name", "toe"}, {"x", 0.0}}}}}}};
        json study = {
            {"scene", scene}, {"uncertainty", json::object()}, {"variants", json::array()}};
        for (const json& row : answer_.at("rows")) {
            study["variants"].push_back({{"name", row.at("sample")}, {"made_by", "uncertainty"}});
            add_task(row, scene);
        }
        write(folder_ / "study.json", study);
    }
    void TearDown() override { fs::remove_all(folder_); }

    void add_task(const json& row, const json& scene) const {
        const std::string sample = row.at("sample");
        const fs::path task = folder_ / "tasks" / ("mpm_" + sample);
        write(task / "scene.completed.json", scene);
        write(task / "task.json",
              {{"phase", "mpm_solver"}, {"variant", sample}, {"state", row.at("state")}});
        const json reached = row.at("results").at("runout_beyond_toe");
        if (reached.is_null()) return;
        const bool moves = row.at("state") == "questionable";
        json result = row.at("results");
        const json moving = {{"code", "still_moving"},
                             {"severity", "questionable"},
                             {"message", "12 % are left"},
                             {"pointer", "/mpm/duration"}};
        result.update({{"phase", "mpm_solver"},
                       {"at_rest", !moves},
                       {"flags", moves ? json::array({moving}) : json::array()},
                       {"cpu_seconds", 2.5},
                       {"provenance", {{"version", "0.9.0"}, {"overrides", json::array()}}},
                       {"sections", {{"toe", {{"volume", 30.0}, {"largest_discharge", 4.0}}}}}});
        const double length = reached;  // the flow is at 50 m when its runout is longer
        result["gauges"]["road"] = {{"arrival_time", length > 50 ? json(50 / length) : json()},
                                    {"largest_depth", std::max(0.0, length - 50) / 10},
                                    {"largest_velocity", std::max(0.0, length - 50) / 5}};
        write(task / "result.json", result);
    }

    Document document() const {
        json answer = answer_;
        answer["cautions"] = findings::cautions_of(answer);
        write(folder_ / "uncertainty.json", answer);
        const auto run = read_run(folder_);
        const std::optional<Paper> paper;
        const Measures measures;
        const Choice choice;
        Document made{run.title, {}, {}, {}, {}, front_of(run)};
        add_assessment({run, paper, measures, choice}, made);
        return made;
    }

    static std::vector<std::string> row(const Document& document, const std::string& table,
                                        const std::string& begin) {
        for (const Chapter& chapter : document.chapters)
            for (const Table& each : chapter.tables)
                if (each.name == table)
                    for (const auto& cells : each.rows)
                        if (cells[0].starts_with(begin)) return cells;
        throw std::runtime_error("no row " + begin + " in " + table);
    }
    static std::string cautions(const Document& document) {
        std::string text;
        for (const std::string& each : document.chapters.at(0).cautions) text += each + "\n";
        return text;
    }
    static std::vector<std::string> figures(const Document& document) {
        std::vector<std::string> names;
        for (const Figure& each : document.chapters.at(1).figures) names.push_back(each.name);
        return names;
    }

    fs::path folder_;
    json answer_;
};

TEST_F(Sampled, OpensWithWhatARegulatorAsks) {
    const Document d = document();
    ASSERT_EQ(d.chapters.size(), 2u);
    EXPECT_EQ(d.chapters[0].title, "Dam-breach assessment");
    EXPECT_TRUE(d.chapters[0].opens_page);
    const auto far = row(d, "assessment", "Of what passed the toe");
    EXPECT_EQ(far[1], "38.52 (32.67 to 43.73)");
    EXPECT_EQ(far[2], "24.15 (22.45 to 25.24)");
    EXPECT_EQ(far[3], "70.99 (62.64 to 78.68)");
    EXPECT_EQ(far[4], "60 of 64 samples");
    EXPECT_TRUE(row(d, "assessment_what", "When")[1].starts_with("Not applicable"));
    EXPECT_EQ(d.front.found.rows.front()[1], "p50: 38.52 (32.67 to 43.73)");
    EXPECT_EQ(d.front.limits.front().substr(0, 12), "Plane strain") << "uncertainty was computed";
    const std::string html = as_html(d, "files");
    EXPECT_NE(html.find("<section class=\"opens\">"), std::string::npos);
    EXPECT_LT(html.find("left no result and are in no number"), html.find("id=\"assessment\""));
}

TEST_F(Sampled, ASearchForOneValueHasAChapterOfItsOwnAndNoDistribution) {
    answer_["quantities"] = json::object();
    answer_["sentences"] = {"A residual strength of at least 0.484 gives it."};
    const auto step = [](double value, const json& results, int moving) {
        double sum = 0.0;
        for (const json& each : results) sum += each.get<double>();
        return json{{"value", value},
                    {"results", results},
                    {"lower_bounds", moving},
                    {"result", sum / static_cast<double>(results.size())},
                    {"state", "done"}};
    };
    answer_["inverse"] = {{"quantity", "runout_beyond_toe"},
                          {"unit", "m"},
                          {"target", 215.0},
                          {"vary", "residual strength"},
                          {"state", "found"},
                          {"value", 0.484},
                          {"bound", "at_least"},
                          {"low", 0.465},
                          {"high", 0.504},
                          {"reason", ""},
                          {"noise", 3.0},
                          {"steps", {step(0.4, {232.0, 236.0}, 1), step(2.5, {10.0, 12.0}, 0)}}};
    const Document d = document();
    ASSERT_EQ(d.chapters.size(), 1u);
    EXPECT_EQ(d.chapters[0].title, "Back-analysis");
    EXPECT_EQ(row(d, "back_analysis_steps", "0.4"),
              (std::vector<std::string>{"0.4", "\u2265 234", "232; 236", "1 of 2", "done"}));
    EXPECT_EQ(row(d, "back_analysis_steps", "2.5")[1], "11");
    const Chart& chart = d.chapters[0].figures.at(0).chart;
    EXPECT_EQ(chart.series.at(0).certainty.at(0), Certainty::at_least);
    ASSERT_EQ(chart.marks.size(), 2u);
    EXPECT_DOUBLE_EQ(chart.marks[0].value, 215.0);
    EXPECT_EQ(d.front.found.rows.front()[1], "\u2265 0.484");
    EXPECT_EQ(d.front.found.rows.front()[2], "0.465 to 0.504");
    const auto& asked = d.front.asked;
    EXPECT_TRUE(std::ranges::any_of(asked, [](const std::string& each) {
        return each.starts_with("Which residual strength gives a runout_beyond_toe of 215 m?");
    }));
    EXPECT_FALSE(std::ranges::any_of(
        asked, [](const std::string& each) { return each.starts_with("How sure"); }));
}

TEST_F(Sampled, SaysWhichCasesItCovers) {
    const Document d = document();
    EXPECT_EQ(row(d, "assessment_cases", "1A")[3], "no");
    EXPECT_EQ(row(d, "assessment_cases", "1B")[3], "no");
    EXPECT_EQ(row(d, "assessment_cases", "2A")[3], "yes");
    EXPECT_EQ(row(d, "assessment_cases", "2B")[3], "yes");
    const Table& cases = d.chapters[0].tables[3];
    EXPECT_TRUE(cases.caption.starts_with("Whether this static scene is 2A or 2B"))
        << cases.caption;
    json study = json::parse(std::ifstream(folder_ / "study.json"));
    study["scene"]["transfer"]["liquefied"]["regions"] = {"pond"};
    write(folder_ / "study.json", study);
    const Document other = document();
    EXPECT_EQ(row(other, "assessment_cases", "2A")[3], "yes: this run");
    EXPECT_EQ(row(other, "assessment_what", "What fails")[1], "A slope; soil liquefies in pond.");
}

TEST_F(Sampled, ListsManyMeshesAndAnalysesWithNumberAndRange) {
    const auto what = [&] { return row(document(), "assessment_what", "What fails")[1]; };
    const auto add = [&](const std::string& phase, const std::string& label, const json& result) {
        write(folder_ / "tasks" / label / "task.json", {{"phase", phase}, {"variant", label}});
        write(folder_ / "tasks" / label / "result.json", result);
    };
    add("lem_tool", "lem_a", {{"factor_of_safety", 1.25}});
    EXPECT_EQ(what(), "A slope; factor of safety 1.25 (lem_a).");
    add("lem_tool", "lem_b", {{"factor_of_safety", 0.875}});
    write(folder_ / "tasks/lem_c/task.json", {{"phase", "lem_tool"}, {"state", "failed"}});
    EXPECT_EQ(what(), "A slope; factor of safety 0.875 to 1.25 (2 of 3 analyses).");

    const auto entangled = [](double time, const char* kind) {
        return json{{"ended", "entangled"},
                    {"end_time", time},
                    {"entanglement", {{"time", time}, {"kind", kind}}}};
    };
    add("fem_solver", "fem_a", entangled(9.75, "band"));
    EXPECT_TRUE(what().starts_with("A slope. The mesh entangled at 9.75 s")) << what();
    add("fem_solver", "fem_b", {{"ended", "complete"}, {"end_time", 20.0}});
    EXPECT_EQ(what(), "A slope. 1 of 2 meshes entangled, at 9.75 s.");
    add("fem_solver", "fem_c", entangled(4.25, "band"));
    EXPECT_EQ(what(), "A slope. 2 of 3 meshes entangled, from 4.25 to 9.75 s.");
    add("fem_solver", "fem_c", entangled(4.25, "corner"));
    EXPECT_EQ(what(),
              "A slope. 2 of 3 meshes entangled, from 4.25 to 9.75 s; 1 of them at one bad corner, "
              "which is the mesh's doing and not the section's failure.");
}

TEST_F(Sampled, CountsItsTransferTimesFromAShakingOnlyWhereThereIsOne) {
    const auto when = [&] { return row(document(), "assessment_what", "When")[1]; };
    write(folder_ / "tasks/mpm_s0001/task.json",
          {{"phase", "mpm_solver"}, {"variant", "s0001"}, {"transfer_time", 3.0}});
    write(folder_ / "tasks/fem/task.json", {{"phase", "fem_solver"}});
    EXPECT_NE(when().find("t_T = 3 s after the beginning of the dynamic analysis."),
              std::string::npos)
        << when();
    json scene = json::parse(std::ifstream(folder_ / "study.json")).at("scene");
    scene["fem"]["motion"]["file"] = "shake.csv";
    write(folder_ / "tasks/fem/scene.completed.json", scene);
    EXPECT_NE(when().find("t_T = 3 s after the beginning of the shaking."), std::string::npos)
        << when();
}

TEST_F(Sampled, SaysWhatTheNumbersDoNot) {
    const std::string all = cautions(document());
    EXPECT_NE(all.find("2 samples of 64 left no result"), std::string::npos) << all;
    EXPECT_NE(all.find("2 samples have not ended"), std::string::npos);
    EXPECT_NE(all.find("1 of 60 samples were stopped while their soil still moved"),
              std::string::npos);
    EXPECT_NE(all.find("outside of the bounds given for residual strength"), std::string::npos);
    EXPECT_NE(
        all.find("p90 of runout_beyond_toe to \u00b1 10 % of its value. Reached: \u00b1 13 %."),
        std::string::npos);
    EXPECT_EQ(all.find("Too few samples"), std::string::npos);
}

TEST_F(Sampled, PercentilesAboveSoilThatStillMovedAreLowerBounds) {
    for (json& each : answer_.at("rows"))
        if (each.at("sample") == "s0001") {  // 24.86 m: below p50, above p10
            each["state"] = "questionable";
            add_task(each, json::parse(std::ifstream(folder_ / "study.json")).at("scene"));
        }
    const Document d = document();
    const auto far = row(d, "assessment", "Of what passed the toe");
    EXPECT_EQ(far[1].substr(0, 9), "\u2265 38.52");
    EXPECT_EQ(far[2].substr(0, 6), "24.15 ") << "no sample below it moved";
    EXPECT_EQ(row(d, "assessment_samples", "s0001").back(), "\u2265 24.86");
    const auto& marks = d.chapters[1].figures.front().chart.marks;
    ASSERT_EQ(marks.size(), 1u);
    EXPECT_NEAR(marks[0].value, 24.86, 0.005);
}

TEST_F(Sampled, AGaugeThatTheFlowSeldomReachesHasNoMedianArrival) {
    const Document d = document();
    std::size_t came = 0;
    for (const json& each : answer_.at("rows"))
        if (each.at("results").at("runout_beyond_toe").is_number() &&
            each.at("results").at("runout_beyond_toe") > 50)
            ++came;
    const auto arrival = row(d, "assessment", "Gauge road (x = 50 m): arrival");
    ASSERT_LT(came, 30u);
    EXPECT_EQ(arrival[1], "not by the end");
    EXPECT_NE(arrival[2], "not by the end") << "one in ten comes";
    EXPECT_EQ(arrival[4], std::to_string(came) + " of 64 samples: there the flow came");
    EXPECT_EQ(row(d, "assessment", "Gauge road (x = 50 m): largest depth")[1], "0")
        << "it was deep";
    EXPECT_EQ(row(d, "assessment", "Section toe (x = 0 m): volume")[1], "\u2265 30");
}

TEST_F(Sampled, ListsTheOriginOfNumbersAndTheErrorOfOneRun) {
    const Document d = document();
    EXPECT_EQ(row(d, "assessment_origin", "mpm_solver")[1], "0.9.0");
    EXPECT_EQ(row(d, "assessment_origin", "uncertainty.json")[1].size(), 64u);
    EXPECT_EQ(row(d, "assessment_error", "largest known error")[1], "not known");
    EXPECT_EQ(row(d, "assessment_error", "CPU seconds of all")[1], "150");
    EXPECT_EQ(row(d, "assessment_left_out", "s0005")[2], "exit 70: a point left the grid at 3.2 s");
}

TEST_F(Sampled, ATornadoThatIsRefusedIsNotDrawn) {
    EXPECT_EQ(figures(document())[1], "tornado");
    answer_["quantities"]["runout_beyond_toe"]["tornado"] = {
        {"refused", "Q2 is 0.4; 0.7 is needed"}, {"q2", 0.4}};
    const Document d = document();
    EXPECT_EQ(std::ranges::count(figures(d), "tornado"), 0);
    EXPECT_TRUE(std::ranges::any_of(d.left_out, [](const LeftOut& each) {
        return each.what.starts_with("tornado") && each.why == "Q2 is 0.4; 0.7 is needed";
    }));
}

TEST_F(Sampled, ThreeSamplesAreNotEnough) {
    json& quantity = answer_["quantities"]["runout_beyond_toe"];
    quantity["count"] = 3;
    quantity["percentiles"] = {
        {"refused", "3 samples are not enough for the 50th percentile: 5 are needed"}};
    quantity["percentiles_lacking"] = {{{"p", 50}, {"needs", 5}}, {{"p", 90}, {"needs", 29}}};
    const Document d = document();
    const auto far = row(d, "assessment", "Of what passed the toe");
    EXPECT_EQ(far[1], "3 samples are not enough for the 50th percentile: 5 are needed");
    EXPECT_NE(
        cautions(d).find("Too few samples for p50 (needs 5), p90 (needs 29): 3 have a result."),
        std::string::npos);
}

TEST_F(Sampled, WithoutItsAnswerIsLeftOutAndSaid) {
    fs::remove(folder_ / "uncertainty.json");
    const auto run = read_run(folder_);
    const std::optional<Paper> paper;
    const Measures measures;
    const Choice choice;
    Document d{run.title, {}, {}, {}, {}, front_of(run)};
    add_assessment({run, paper, measures, choice}, d);
    EXPECT_TRUE(d.chapters.empty());
    ASSERT_EQ(d.left_out.size(), 1u);
    EXPECT_NE(d.left_out[0].why.find("no uncertainty.json"), std::string::npos);
    EXPECT_EQ(d.front.limits.front().substr(0, 27), "No uncertainty was computed");
}

TEST(Spread, NeedsEnoughSamples) {
    EXPECT_EQ(statistics::samples_needed(50), 5u);
    EXPECT_EQ(statistics::samples_needed(90), 29u);
    EXPECT_EQ(statistics::samples_needed(10), 29u);
    EXPECT_EQ(statistics::samples_needed(95), 59u);
    Spread spread{3,
                  5,
                  {1, 2, 3, std::numeric_limits<double>::infinity(),
                   std::numeric_limits<double>::infinity()}};
    EXPECT_EQ(spread.percentile(50), 3.0);
    EXPECT_EQ(spread.percentile(90), std::nullopt);
}

TEST(UncertaintyFigures, TheCurveFallsInStepsWithinItsBand) {
    const json quantity = from_file().at("uncertainty").at("quantities").at("runout_beyond_toe");
    const Series s = exceedance_figure(quantity, "runout [m]", {}).chart.series.front();
    for (std::size_t i = 1; i < s.x.size(); ++i) {
        EXPECT_TRUE(s.x[i] == s.x[i - 1] || s.y[i] == s.y[i - 1]);
        EXPECT_LE(s.y[i], s.y[i - 1]);
        EXPECT_LE(s.low[i], s.y[i]);
        EXPECT_GE(s.high[i], s.y[i]);
    }
    const std::string csv = as_csv(exceedance_figure(quantity, "runout [m]", {}).chart);
    EXPECT_NE(csv.find(",\"low\",\"high\"\n"), std::string::npos);
}

TEST(UncertaintyFigures, TheLongestBarStandsOnTopWithItsName) {
    const json quantity = from_file().at("uncertainty").at("quantities").at("runout_beyond_toe");
    const auto figure = tornado_figure(quantity, "runout [m]");
    ASSERT_TRUE(figure);
    EXPECT_EQ(figure->chart.y.names,
              (std::vector<std::string>{"motion", "viscosity", "residual strength"}));
    EXPECT_DOUBLE_EQ(figure->chart.series[0].x.front(), 40.0) << "from the middle";
    EXPECT_NE(as_svg(figure->chart).find(">residual strength</text>"), std::string::npos);
}

TEST(UncertaintyFigures, APercentileOfTheArrivalEndsWhereTooFewCame) {
    const json envelopes = from_file().at("envelopes");
    const auto figures = envelope_figures(envelopes);
    ASSERT_EQ(figures.size(), 3u);
    EXPECT_EQ(figures[2].name, "envelope_arrival");
    const auto end_of = [&](const std::string& name) {
        for (const Series& each : figures[2].chart.series)
            if (each.name.starts_with(name)) return each.x.back();
        throw std::runtime_error("no series " + name);
    };
    EXPECT_GT(end_of("p10"), end_of("p50"));
    EXPECT_GT(end_of("p50"), end_of("p90")) << "half of the flows come farther than nine in ten do";
    EXPECT_NO_THROW(as_svg(figures[2].chart)) << "a band with an open end is no number";
}

}  // namespace
}  // namespace breach::report
