#include "services/report/run_report.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <regex>
#include <sstream>

#include "core/fault/fault.hpp"
#include "core/scene/scene.hpp"
#include "services/report/chapters/chapters.hpp"
#include "services/report/chart/page.hpp"
#include "services/report/chart/png.hpp"
#include "services/report/figures/mesh_figures.hpp"
#include "services/report/read/entries.hpp"
#include "services/report/read/verdict.hpp"
#include "tests/unit/report/wet_run.hpp"

namespace breach::report {
namespace {

namespace fs = std::filesystem;

class WetRun : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("wet_run_" + std::to_string(getpid()));
        fs::remove_all(folder_);
        write_wet_run(folder_, "mochikoshi-small");
    }
    void TearDown() override { fs::remove_all(folder_); }

    Document document() const { return document_of(read_run(folder_), {}); }

    static const Figure& figure(const Document& document, const std::string& name) {
        for (const Chapter& chapter : document.chapters) {
            for (const Figure& each : chapter.figures) {
                if (each.name == name) return each;
            }
        }
        throw std::runtime_error("no figure " + name);
    }

    static const Table& table(const Document& document, const std::string& name) {
        for (const Chapter& chapter : document.chapters) {
            for (const Table& each : chapter.tables) {
                if (each.name == name) return each;
            }
        }
        throw std::runtime_error("no table " + name);
    }

    static std::string cell(const Document& document, const std::string& name, std::size_t row,
                            const std::string& column) {
        const Table& in = table(document, name);
        const auto head = std::ranges::find(in.columns, column);
        if (head == in.columns.end()) throw std::runtime_error("no column " + column);
        return in.rows.at(row).at(static_cast<std::size_t>(head - in.columns.begin()));
    }

    static std::string in_one(const std::vector<std::string>& sentences) {
        std::string text;
        for (const std::string& each : sentences) text += each + "\n";
        return text;
    }

    /// Adds entries to a phase's result.json, creating it if necessary.
    void edit_result(const std::string& label, const nlohmann::json& entries) const {
        const fs::path file = folder_ / "tasks" / label / "result.json";
        nlohmann::json result = nlohmann::json::object();
        if (fs::exists(file)) result = nlohmann::json::parse(text_of(file));
        result.update(entries);
        std::ofstream(file) << result.dump();
    }

    void edit_study(const nlohmann::json& entries) const {
        nlohmann::json study = nlohmann::json::parse(text_of(folder_ / "study.json"));
        study.update(entries);
        std::ofstream(folder_ / "study.json") << study.dump();
    }

    nlohmann::json scene_of(const std::string& label) const {
        return nlohmann::json::parse(text_of(folder_ / "tasks" / label / "scene.completed.json"));
    }
    void write_scene(const std::string& label, const nlohmann::json& scene) const {
        fs::create_directories(folder_ / "tasks" / label);
        std::ofstream(folder_ / "tasks" / label / "scene.completed.json") << scene.dump();
    }

    /// As this version's phases write it: all runouts warn, one still moves, the FEM is entangled.
    void flag_all() const {
        const nlohmann::json moving = {{"code", "still_moving"},
                                       {"severity", "questionable"},
                                       {"message", "12 % of the released energy is left"},
                                       {"pointer", "/mpm/duration"}};
        const nlohmann::json implausible = {{"code", "implausible"},
                                            {"severity", "warning"},
                                            {"message", "19 looks like kN/m3"},
                                            {"pointer", "/materials/sand/density"}};
        for (const char* sound : {"mpm_13.000000_softened", "mpm_16.000000_not_softened"}) {
            edit_result(sound, {{"at_rest", true}, {"flags", {implausible}}});
        }
        edit_result("mpm_16.000000_softened",
                    {{"at_rest", false}, {"flags", {implausible, moving}}});
        edit_result("transfer_14.000000", {{"flags", nlohmann::json::array()}});
        fs::remove(folder_ / "tasks/fem/fault.json");
        edit_result("fem", {{"phase", "fem_solver"},
                            {"ended", "entangled"},
                            {"end_time", 20.5},
                            {"flags",
                             {{{"code", "entangled"},
                               {"severity", "warning"},
                               {"message", "the mesh entangled"},
                               {"pointer", ""}}}},
                            {"entanglement",
                             {{"time", 20.5},
                              {"element", 212},
                              {"region", "sand"},
                              {"x", 1.5},
                              {"y", 0.25},
                              {"mean_epsilon_q", 0.34},
                              {"failure_surfaces", 2},
                              {"kind", "band"}}},
                            {"provenance", {{"overrides", nlohmann::json::array()}}}});
    }

    static std::string text_of(const fs::path& file) {
        std::ostringstream text;
        text << std::ifstream(file).rdbuf();
        return text.str();
    }

    fs::path folder_;
};

TEST_F(WetRun, KnowsItsPhases) {
    const auto run = read_run(folder_);
    EXPECT_EQ(run.id, "01");
    ASSERT_EQ(run.phases.size(), 5u);
    EXPECT_EQ(run.phases[0].phase, "fem_solver");
    EXPECT_EQ(run.phases[0].fault, "the mesh is entangled at 21 s");
    EXPECT_EQ(variants_of(run), (std::vector<std::string>{"softened", "not_softened"}));
    EXPECT_EQ(runouts_of(run, "softened").size(), 2u);
}

TEST_F(WetRun, IsMeasuredWhereItsTelemetryCrosses) {
    const Measures m = measures_of(read_run(folder_), paper_for("mochikoshi-small"));
    EXPECT_EQ(m.at("time_liquefied_12_m").value, 11);
    EXPECT_EQ(m.at("time_first_surface").value, 13);
    EXPECT_EQ(m.at("time_epsilon_q_20").value, 17) << "0.0125 t exceeds 0.2 after 16 s";
    EXPECT_EQ(m.at("time_jacobian_least_97").value, 20);
    EXPECT_EQ(m.count("time_jacobian_centre_97"), 0u) << "never met";
    EXPECT_EQ(m.at("time_entangled").value, 21);
    EXPECT_EQ(m.at("window_lower").value, 15);
    EXPECT_EQ(m.at("window_upper").value, 20);
    EXPECT_EQ(m.at("plateau_runout:softened").value, 210) << "13 s has less than 75 % of it";
    EXPECT_EQ(m.at("plateau_begin:softened").value, 16);
    EXPECT_EQ(m.at("plateau_ratio").value, 7);
    EXPECT_EQ(m.at("plateau_ratio").error, "between 7 and 7 by the runouts of either");
}

TEST_F(WetRun, GoesByTheSceneThatItsStudyAsksAboutAndNotByACachedPhases) {
    nlohmann::json asked = scene_of("fem");
    asked["title"] = "What is asked";
    asked["transfer"]["window"] = {{"lower", "liquefaction_depth >= 12"},
                                   {"upper", "jacobian_least_avg < 0.97"}};
    edit_study({{"scene", asked}, {"triggers", nlohmann::json::array()}});
    nlohmann::json others = scene_of("fem");
    others["name"] = "another-dam";
    others.erase("title");
    others.erase("transfer");
    write_scene("lem", others);
    fs::remove(folder_ / "run.json");
    const auto run = read_run(folder_);
    EXPECT_EQ(run.phases.front().phase, "lem_tool") << "the first, from the cache";
    EXPECT_EQ(run.name, "mochikoshi-small");
    EXPECT_EQ(run.title, "What is asked");
    const Measures m = measures_of(run, {});
    EXPECT_EQ(m.at("window_lower").value, 11);
    EXPECT_EQ(m.at("window_upper").value, 20);
    ASSERT_EQ(thresholds_in(run).size(), 2u);
    EXPECT_EQ(thresholds_in(run).front().value, 12);
    const Document d = document();
    EXPECT_TRUE(d.front.of.starts_with("Scene mochikoshi-small")) << d.front.of;
    EXPECT_NO_THROW(table(d, "comparison")) << "the paper is the asked scene's";
}

TEST_F(WetRun, DrawsWhatItsStudyAppendsOnce) {
    const std::string road = R"(/mpm/gauges/-={"name":"road","x":40})";
    const auto asked = nlohmann::json::parse(
        scene::read_scene(BREACH_ROOT "/workflows/scenes/mochikoshi.json", {road}).completed);
    const auto drawing = [&](const std::vector<std::string>& overrides) {
        edit_study({{"scene", asked}, {"overrides", overrides}});
        const Document d = document();
        return std::ranges::find(d.chapters, "Inputs", &Chapter::title)->drawing;
    };
    const std::string once = drawing({});
    EXPECT_NE(once.find("road (x = 40)"), std::string::npos);
    EXPECT_EQ(drawing({road}), once) << "the stored scene has it already";
}

TEST_F(WetRun, ReportsTheEndsOfManyFemsInOneRow) {
    flag_all();
    for (const char* name : {"fem_a", "fem_b", "fem_c", "fem_d", "fem_e", "fem_f"})
        fs::copy(folder_ / "tasks/fem", folder_ / "tasks" / name, fs::copy_options::recursive);
    edit_result("fem_f", {{"end_time", 25.0}, {"ended", "complete"}, {"flags", {}}});
    const Front front = front_of(read_run(folder_));
    std::vector<std::vector<std::string>> ends;
    for (const auto& row : front.found.rows)
        if (row[0].starts_with("Finite elements end")) ends.push_back(row);
    ASSERT_EQ(ends.size(), 1u);
    EXPECT_EQ(ends[0][0], "Finite elements end [s], 7 of them");
    EXPECT_EQ(ends[0][2], "20.5 to 25 (7 of 7)");
    EXPECT_NE(ends[0][3].find("6 not simply well, the first"), std::string::npos) << ends[0][3];
}

TEST_F(WetRun, ShowsTheLastStageOfEachAnalysisForAnyLayers) {
    const auto stages = [](const std::vector<double>& factors) {
        nlohmann::json all = nlohmann::json::array();
        for (const double each : factors) all.push_back({{"factor_of_safety", each}});
        return all;
    };
    for (const char* label : {"lem_one_layer", "lem_two_layers", "lem_no_layer"}) {
        fs::create_directories(folder_ / "tasks" / label);
        fs::copy(folder_ / "tasks/fem/scene.completed.json",
                 folder_ / "tasks" / label / "scene.completed.json");
    }
    edit_result("lem_one_layer", {{"factor_of_safety", 1.25}, {"stages", stages({1.25, 0.875})}});
    edit_result("lem_two_layers",
                {{"factor_of_safety", 1.5}, {"stages", stages({1.5, 1.125, 0.75})}});
    edit_result("lem_no_layer", {{"factor_of_safety", 1.75}});
    const Front front = front_of(read_run(folder_));
    const auto row = [&](const std::string& begin) {
        for (const auto& each : front.found.rows)
            if (each[0].starts_with(begin)) return each;
        throw std::runtime_error("no row " + begin);
    };
    EXPECT_EQ(row("Factor of safety before any layer liquefies")[1], "1.25");
    EXPECT_EQ(row("Factor of safety before any layer liquefies")[2], "1.25 to 1.75 (3 of 3)");
    const auto liquefied = row("Factor of safety with every layer liquefied that may");
    EXPECT_EQ(liquefied[1], "0.875") << "of the governing case";
    EXPECT_EQ(liquefied[2], "0.75 to 0.875 (2 of 3)") << "each one's own last stage";
    EXPECT_TRUE(liquefied[3].ends_with("0.75 in two_layers")) << "the least: " << liquefied[3];
}

TEST_F(WetRun, SaysWhatNothingWasTransferredOf) {
    std::ofstream(folder_ / "results.json") << R"({"rows": [
        {"variant": "early", "transfer_time": 9, "state": "not_reached", "reason": "the FEM ended at 8 s"}],
        "columns": [], "without_transfer": [
        {"variant": "strong", "fem_task": "f", "state": "not_reached", "stood": true, "reason": "window: never met"},
        {"variant": "odd", "fem_task": "g", "state": "not_reached", "stood": false, "reason": "window: there is no window"}]})";
    const Verdict verdict = verdict_of(read_run(folder_));
    const auto said = [](const std::vector<std::string>& list, const std::string& text) {
        return std::ranges::find(list, text) != list.end();
    };
    EXPECT_TRUE(said(verdict.cautions,
                     "No transfer from strong, so there is no runout: window: never "
                     "met. The dam may stand; then nothing runs out."));
    EXPECT_TRUE(said(verdict.cautions,
                     "No transfer from early, so there is no runout: the FEM ended at 8 s. "
                     "This does not mean that the dam is stable."));
    EXPECT_TRUE(said(verdict.cautions,
                     "No transfer from odd, so there is no runout: window: there is "
                     "no window. This does not mean that the dam is stable."));
}

TEST_F(WetRun, SaysWhenARatioOfRunoutsSaysNothing) {
    for (const std::string variant : {"softened", "not_softened"}) {
        const fs::path at_17 = folder_ / "tasks" / ("mpm_17.000000_" + variant);
        fs::copy(folder_ / "tasks" / ("mpm_16.000000_" + variant), at_17,
                 fs::copy_options::recursive);
        std::ofstream(at_17 / "task.json")
            << nlohmann::json{{"phase", "mpm_solver"}, {"transfer_time", 17}, {"variant", variant}};
    }
    edit_result("mpm_17.000000_not_softened", {{"runout", 0.5}});
    const auto run = read_run(folder_);
    const Measures m = measures_of(run, paper_for("mochikoshi"));
    EXPECT_EQ(m.at("plateau_runout:not_softened").value, 15.25);
    EXPECT_EQ(m.at("plateau_ratio").error, "says nothing: the smaller runouts go down to 0.5 m");
}

TEST_F(WetRun, ShowsThePapersNumbersBesideItsOwn) {
    const Document d = document();
    const Table table = (d.chapters.end() - 2)->tables.front();
    EXPECT_EQ(table.name, "comparison");
    bool found = false;
    for (const auto& row : table.rows) {
        if (row[0].find("plateau runout") == std::string::npos || row[3] != "210") continue;
        found = true;
        EXPECT_EQ(row[2], "215");
        EXPECT_EQ(row[4], "0.977");
    }
    EXPECT_TRUE(found);
    std::string remarks;
    for (const std::string& each : d.remarks) remarks += each;
    EXPECT_NE(remarks.find("calibrated"), std::string::npos);
    EXPECT_NE(remarks.find("stand-in"), std::string::npos);
    EXPECT_EQ(figure(d, "runout_against_transfer_time").chart.series.size(), 4u);
}

TEST_F(WetRun, KnowsTheCriticalDepthThatItsTriggersAskFor) {
    std::ofstream(folder_ / "study.json") << R"({"triggers": [{"kind": "window",
        "lower": "liquefaction_depth >= critical_depth", "upper": "time >= 18"}]})";
    EXPECT_EQ(measures_of(read_run(folder_), paper_for("mochikoshi-small")).count("window_lower"),
              0u)
        << "no stability analysis";
    fs::create_directories(folder_ / "tasks/lem");
    fs::copy(folder_ / "tasks/fem/scene.completed.json",
             folder_ / "tasks/lem/scene.completed.json");
    std::ofstream(folder_ / "tasks/lem/result.json") << R"({"critical_depth": 12.25})";
    const Measures m = measures_of(read_run(folder_), paper_for("mochikoshi-small"));
    EXPECT_EQ(m.at("window_lower").value, 11);
    EXPECT_EQ(m.at("window_upper").value, 18);
}

TEST_F(WetRun, FindsTheWindowAsItsTriggerDoes) {
    std::ofstream(folder_ / "study.json") << R"({"triggers": [{"kind": "window", "hold_s": 1.5,
        "lower": "time < 2 or time >= 15", "upper": "time < 14 or time >= 19"}]})";
    const WindowEdges window =
        window_in(measures_of(read_run(folder_), paper_for("mochikoshi-small")));
    EXPECT_EQ(window.lower, 15) << "0 to 1 s did not last";
    EXPECT_EQ(window.upper, 19) << "what was over before the lower edge shuts nothing";
    EXPECT_FALSE(window.is_none());
}

TEST_F(WetRun, SaysThatThereIsNoWindowWhereTheMeshIsDistortedFirst) {
    std::ofstream(folder_ / "study.json") << R"({"triggers": [{"kind": "window",
        "lower": "time >= 18", "upper": "time >= 12"}]})";
    EXPECT_TRUE(window_in(measures_of(read_run(folder_), paper_for("mochikoshi"))).is_none());
    const Document d = document();
    const std::vector<Mark> marks = figure(d, "runout_against_transfer_time").chart.marks;
    ASSERT_EQ(marks.size(), 2u);
    EXPECT_EQ(marks[0].label, "failure developed");
    EXPECT_EQ(marks[0].value, 18);
    EXPECT_EQ(marks[1].label, "mesh too distorted");
    EXPECT_EQ(marks[1].value, 12);
}

TEST_F(WetRun, ListsWhatEachVariantChanges) {
    const Document d = document();
    const auto chapter = std::ranges::find(d.chapters, "Variants", &Chapter::title);
    ASSERT_NE(chapter, d.chapters.end());
    const auto& rows = chapter->tables.front().rows;
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0][1], "nothing");
    EXPECT_EQ(rows[1][1], "/materials/{a, b}/viscosity=0; /mpm/terrain=[[0,0],[2,0],[102,-20]]");
    EXPECT_EQ(rows[0][4], "210");
    EXPECT_EQ(rows[1][4], "30") << "on the first one's plateau, 16 s";
    EXPECT_EQ(rows[1][5], "-85.7");
    EXPECT_EQ(rows[1][8], "15") << "the window of the FEM that they share";
}

TEST_F(WetRun, ShowsDifferentGroundsOnOneScale) {
    const Document d = document();
    const auto chapter = std::ranges::find(d.chapters, "The ground below the dam", &Chapter::title);
    ASSERT_NE(chapter, d.chapters.end());
    ASSERT_EQ(chapter->figures.size(), 2u);
    const auto lines = [&](std::size_t k) {
        std::vector<Series> found;
        for (const Series& s : chapter->figures[k].chart.series) {
            if (s.name.starts_with("ground, ")) found.push_back(s);
        }
        return found;
    };
    for (const std::size_t k : {0u, 1u}) {
        ASSERT_EQ(lines(k).size(), 2u) << "both grounds in both";
        EXPECT_EQ(lines(k)[0].y, (std::vector<double>{-30, -30})) << "a floor is level";
        const double end = 2 + 1.15 * 210;
        EXPECT_EQ(lines(k)[1].x, (std::vector<double>{-1, 0, 2, 102, end}));
        EXPECT_NEAR(lines(k)[1].y.back(), -20 - 0.2 * (end - 102), 1e-12) << "straight beyond";
    }
    EXPECT_EQ(chapter->tables.front().rows.front(),
              (std::vector<std::string>{"runout [m]", "210", "30", "> 800"}));
}

TEST_F(WetRun, ShowsTheLongestRunoutOnEachGroundWhicheverVariantHasIt) {
    const fs::path farther = folder_ / "tasks/mpm_16.000000_wetter";
    fs::copy(folder_ / "tasks/mpm_16.000000_softened", farther, fs::copy_options::recursive);
    std::ofstream(farther / "task.json")
        << R"({"phase": "mpm_solver", "variant": "wetter", "transfer_time": 16})";
    edit_result("mpm_16.000000_wetter", {{"runout", 250.0}, {"runout_largest", 250.0}});
    edit_study(
        {{"variants", {{{"name", "softened"}}, {{"name", "not_softened"}}, {{"name", "wetter"}}}}});
    const Document d = document();
    EXPECT_EQ(
        table(d, "ground").columns,
        (std::vector<std::string>{"quantity", "t_T = 16 s, wetter", "t_T = 16 s, not_softened",
                                  "case history, valley of about 20 %"}));
    EXPECT_EQ(cell(d, "ground", 0, "t_T = 16 s, wetter"), "250");
    EXPECT_NO_THROW(figure(d, "ground_wetter"));
    EXPECT_THROW(figure(d, "ground_softened"), std::runtime_error);
}

TEST_F(WetRun, CarriesTheVariantsOfACompanion) {
    Choice choice;
    choice.companions = {folder_};
    const Document d = document_of(read_run(folder_), choice);
    ASSERT_GE(d.chapters.size(), 2u);
    EXPECT_TRUE(d.chapters.back().title.starts_with("Annex"));
    const Chapter& last = *(d.chapters.end() - 2);
    EXPECT_EQ(last.title, "Variants: wet");
    EXPECT_EQ(last.tables.front().name, "variants_wet");
    EXPECT_EQ((d.chapters.end() - 3)->figures.front().name, "ground_softened_wet");

    const Document alone = document();
    const auto& own = figure(alone, "runout_against_transfer_time").chart.series;
    const auto& both = figure(d, "runout_against_transfer_time").chart.series;
    ASSERT_GT(both.size(), own.size());
    EXPECT_EQ(both[own.size()].name, "wet, " + own.front().name);
    EXPECT_EQ(both[own.size()].x, own.front().x);
    EXPECT_EQ(both[own.size()].y, own.front().y);
}

TEST_F(WetRun, NamesTheMaterialThatAVariantChanges) {
    std::ofstream(folder_ / "study.json") << R"({"variants": [{"name": "softened"},
        {"name": "not_softened", "overrides": ["/materials/liquefied/viscosity=0",
         "/materials/a/law/c_kPa=1", "/materials/b/law/c_kPa=2"]}]})";
    const Document d = document();
    const auto chapter = std::ranges::find(d.chapters, "Variants", &Chapter::title);
    ASSERT_NE(chapter, d.chapters.end());
    EXPECT_EQ(chapter->tables.front().rows[1][1],
              "/materials/liquefied/viscosity=0; /materials/{a, b}/law/c_kPa=1, 2");
}

TEST_F(WetRun, SaysWhichPhaseLeftNoResult) {
    const Document d = document();
    EXPECT_NE(
        in_one(d.verdict.cautions).find("The FEM left no result: the mesh is entangled at 21 s."),
        std::string::npos)
        << in_one(d.verdict.cautions);
    EXPECT_EQ(cell(d, "numbers_fem_solver", 0, "settings"), "not known: no result.json");
}

TEST_F(WetRun, SaysAtItsHeadWhatMustBeKnownFirst) {
    flag_all();
    const Document d = document();
    const std::string cautions = in_one(d.verdict.cautions), notes = in_one(d.verdict.notes);
    EXPECT_NE(cautions.find("Still moving, 1 of 3 runouts: 12 % of the released energy is left."),
              std::string::npos)
        << cautions;
    EXPECT_NE(cautions.find("Implausible, 3 of 3 runouts: 19 looks like kN/m3 (mpm_13"),
              std::string::npos)
        << cautions;
    EXPECT_NE(
        notes.find("The mesh entangled at 20.5 s in element 212 (region sand, x = 1.5 m, "
                   "y = 0.25 m), in the failure's band; then: mean epsilon_q there 34 %, failure "
                   "surfaces 2."),
        std::string::npos)
        << notes;
    const std::string html = as_html(d, "files");
    EXPECT_LT(html.find("id=\"verdict\" class=\"verdict doubt unusable\""), html.find("<nav>"));
    EXPECT_LT(html.find("Still moving, 1 of 3 runouts"), html.find("<nav>"));
}

TEST_F(WetRun, OpensWithQuestionResultAndVerdict) {
    flag_all();
    const Document d = document();
    const auto row = [&](const std::string& what) {
        for (const auto& each : d.front.found.rows)
            if (each[0].starts_with(what)) return each;
        throw std::runtime_error("no row " + what);
    };
    EXPECT_NE(in_one(d.front.asked).find("shaken by shake.csv scaled to 0.3 g"), std::string::npos);
    EXPECT_NE(in_one(d.front.asked).find("2 variants: softened, not_softened"), std::string::npos);
    EXPECT_EQ(row("Runout")[1], "\u2265 210") << "it still moved";
    EXPECT_EQ(row("Runout")[2], "30 to \u2265 210 (3 of 3)");
    EXPECT_NE(row("Runout")[3].find("questionable: still moving"), std::string::npos);
    EXPECT_NE(row("Runout")[3].find("numerical error not quantified"), std::string::npos);
    EXPECT_EQ(row("At rest")[2], "2 of 3");
    EXPECT_EQ(d.verdict.word, "not usable") << "an entry is implausible";
    EXPECT_NE(in_one(d.front.limits).find("Plane strain"), std::string::npos);
    const std::string html = as_html(d, "files");
    for (const char* before :
         {"What was asked", "What comes out", "Verdict of the checks", "Limits", "checked by"})
        EXPECT_LT(html.find(before), html.find("<nav>")) << before;
}

TEST_F(WetRun, AnswersWhatAReviewerAsksFromItsOwnFindings) {
    const Table asked = table(document(), "checklist");
    const auto answer = [&](const std::string& begin) {
        for (const auto& row : asked.rows)
            if (row[0].starts_with(begin)) return row[1];
        throw std::runtime_error("no question " + begin);
    };
    EXPECT_EQ(answer("Which laws"), "not modelled") << "the scene has no materials";
    EXPECT_NE(answer("What is left out").find("plane section"), std::string::npos);
    EXPECT_NE(answer("Was the soil calibrated").find("--element-tests"), std::string::npos);
    EXPECT_EQ(answer("How far may").find("no estimate"), 0U) << answer("How far may");
    for (const auto& row : asked.rows) EXPECT_FALSE(row[1].empty()) << row[0];
}

TEST_F(WetRun, DrawsWhatHappensWhenBesideThePaper) {
    const Chart chart = figure(document(), "timeline").chart;
    EXPECT_EQ(chart.y.names, (std::vector<std::string>{"here", "paper"}));
    const auto entangled =
        std::ranges::find(chart.series, "time at which the mesh entangles", &Series::name);
    ASSERT_NE(entangled, chart.series.end());
    EXPECT_EQ(entangled->x, (std::vector<double>{21.0, 23.0}));
}

TEST_F(WetRun, SaysWhichRunoutsAreShakenOnAndOfAnUnshakenSectionNothing) {
    const auto limits = [&] { return in_one(front_of(read_run(folder_)).limits); };
    EXPECT_NE(limits().find("and the shaking ends with it."), std::string::npos) << limits();
    nlohmann::json shaken = scene_of("mpm_16.000000_softened");
    shaken["mpm"]["shaking"] = "on";
    write_scene("mpm_16.000000_softened", shaken);
    EXPECT_NE(limits().find("the ground shakes on in 1 of 3 runouts (/mpm/shaking)"),
              std::string::npos)
        << limits();
    nlohmann::json still = scene_of("fem");
    still["fem"].erase("motion");
    write_scene("fem", still);
    EXPECT_NE(limits().find("Nothing liquefies after the transfer."), std::string::npos);
    EXPECT_EQ(limits().find("shak"), std::string::npos) << limits();
}

TEST_F(WetRun, ThatHasNotEndedIsNotMistakenForAnother) {
    fs::remove_all(folder_ / "tasks/mpm_13.000000_softened");
    fs::create_directories(folder_ / "tasks/mpm_13.000000_softened");
    std::ofstream(folder_ / "tasks/mpm_13.000000_softened/task.json")
        << R"({"phase": "mpm_solver", "variant": "softened", "transfer_time": 13, "state": "blocked"})";
    std::ofstream(folder_ / "run.json") << R"({"id": "01", "name": "wet", "state": "running"})";
    const Document d = document();
    EXPECT_EQ(d.verdict.word, "not finished");
    EXPECT_NE(in_one(d.verdict.cautions)
                  .find("1 of 3 runouts left no result: it has not ended (blocked)"),
              std::string::npos)
        << in_one(d.verdict.cautions);
    EXPECT_NE(in_one(d.verdict.cautions).find("The run is running: this is not all of it."),
              std::string::npos);
    EXPECT_NE(d.front.found.rows.front()[2].find("(2 of 3)"), std::string::npos);
    EXPECT_NE(d.front.headline.find("; 1 of 3 runouts without a result."), std::string::npos)
        << d.front.headline;
}

TEST(Entries, AreAllThatTheSceneHasWithDefaults) {
    const auto scene = nlohmann::json::parse(
        scene::read_scene(BREACH_ROOT "/workflows/scenes/mochikoshi.json", {}).completed);
    const std::vector<SceneEntry> entries = entries_of(scene, {"/mpm/cfl"});
    std::size_t leaves = 0;
    const auto found = [&](const std::string& pointer) {
        const auto at = std::ranges::find(entries, pointer, &SceneEntry::pointer);
        if (at == entries.end()) throw std::runtime_error("no entry " + pointer);
        return *at;
    };
    const nlohmann::json flat = scene.flatten();
    for (const auto& [pointer, value] : flat.items()) {
        ++leaves;
        const bool is_there = std::ranges::any_of(entries, [&](const SceneEntry& each) {
            return pointer == each.pointer || pointer.starts_with(each.pointer + "/");
        });
        EXPECT_TRUE(is_there) << pointer;
    }
    EXPECT_GT(leaves, 300u);
    EXPECT_EQ(found("/mpm/cell_size").value, "1.25");
    EXPECT_EQ(found("/mpm/cell_size").unit, "m");
    EXPECT_FALSE(found("/mpm/cell_size").is_default) << "the scene gives it";
    EXPECT_TRUE(found("/mpm/rest_speed").is_default) << "it does not";
    EXPECT_FALSE(found("/mpm/cfl").is_default) << "an override set it";
    EXPECT_FALSE(found("/materials/tailings/law/D_R").is_default);
    EXPECT_TRUE(found("/materials/tailings/law/n_b").is_default) << "PM4Sand's own, by D_R";
}

TEST_F(WetRun, MarksLowerBoundsWhereverTheyStand) {
    flag_all();
    const Document d = document();
    EXPECT_EQ(cell(d, "numbers_mpm_solver", 2, "runout [m]"), "\u2265 210");
    EXPECT_EQ(cell(d, "numbers_mpm_solver", 2, "how it ended"),
              "questionable: still moving; warnings: implausible");
    EXPECT_EQ(cell(d, "numbers_mpm_solver", 0, "runout [m]"), "90");
    EXPECT_EQ(cell(d, "numbers_mpm_solver", 0, "how it ended"), "well; warnings: implausible");
    EXPECT_EQ(cell(d, "variants", 0, "runout [m]"), "\u2265 210");
    EXPECT_EQ(cell(d, "variants", 1, "runout [m]"), "30");
    EXPECT_EQ(cell(d, "variants", 1, "against the first [%]"), "-") << "of a bound";
    EXPECT_EQ(cell(d, "variants", 0, "how the runouts ended"), "1 of 2 questionable: still moving");
    EXPECT_EQ(cell(d, "ground", 0, "t_T = 16 s, softened"), "\u2265 210");
    const Figure& against = figure(d, "runout_against_transfer_time");
    EXPECT_EQ(against.chart.series.front().certainty,
              (std::vector<Certainty>{Certainty::certain, Certainty::at_least}));
    EXPECT_TRUE(against.chart.series[1].certainty.empty()) << "the other variant is sound";
    EXPECT_NE(as_csv(against.chart).find("16,210,\"lower bound\""), std::string::npos);
    EXPECT_NE(figure(d, "final_geometry_16s").caption.find("\u2265 210 m, a lower bound"),
              std::string::npos);
    EXPECT_EQ(cell(d, "flags", 1, "flag"), "implausible");
    bool compared = false;
    for (const auto& row : table(d, "comparison").rows) compared |= row[3] == "\u2265 210";
    EXPECT_TRUE(compared);
}

TEST_F(WetRun, TakesNoLargestRunoutForCertainWhileAnotherStillMoves) {
    flag_all();
    edit_result("mpm_16.000000_softened", {{"at_rest", true}, {"flags", nlohmann::json::array()}});
    edit_result("mpm_13.000000_softened", {{"at_rest", false}});
    const Front front = front_of(read_run(folder_));
    const auto runout = std::ranges::find_if(
        front.found.rows, [](const auto& row) { return row[0].starts_with("Runout: 99 %"); });
    ASSERT_NE(runout, front.found.rows.end());
    EXPECT_EQ((*runout)[1], "210") << "it has come to rest";
    EXPECT_EQ((*runout)[2], "30 to \u2265 210 (3 of 3)") << "that at 13 s may go farther";
    EXPECT_NE(front.found.caption.find("unless one whose soil still moved"), std::string::npos)
        << front.found.caption;
}

TEST_F(WetRun, MarksLowerBoundsAtGaugesSectionsAndOnEachGround) {
    flag_all();
    edit_result(
        "mpm_16.000000_softened",
        {{"sections",
          {{"toe",
            {{"x", 2.0}, {"volume", 30.0}, {"largest_discharge", 4.0}, {"closure", 0.25}}}}}});
    const Document d = document();
    EXPECT_EQ(cell(d, "gauges", 2, "largest depth [m]"), "\u2265 0.75");
    EXPECT_EQ(cell(d, "gauges", 2, "largest velocity [m/s]"), "-");
    EXPECT_EQ(cell(d, "gauges", 2, "arrival [s]"), "0.5");
    EXPECT_EQ(cell(d, "gauges", 0, "largest depth [m]"), "0.75") << "it came to rest";
    EXPECT_EQ(cell(d, "sections", 0, "passed [m2]"), "\u2265 30");
    EXPECT_EQ(cell(d, "sections", 0, "largest discharge [m2/s]"), "\u2265 4");
    EXPECT_EQ(cell(d, "sections", 0, "closure"), "0.25");
    EXPECT_EQ(cell(d, "sections", 0, "passed [m3]"), "-") << "no breach";
    EXPECT_EQ(cell(d, "ground", 7, "quantity"), "largest depth at toe (x = 2 m) [m]");
    EXPECT_EQ(cell(d, "ground", 7, "t_T = 16 s, softened"), "\u2265 0.75");
    EXPECT_EQ(cell(d, "ground", 7, "t_T = 16 s, not_softened"), "0.75");
    EXPECT_NE(figure(d, "ground_softened").caption.find("Runout \u2265 210 m"), std::string::npos);
}

TEST_F(WetRun, MarksAMeanAsALowerBoundWhereADrawStillMoved) {
    flag_all();
    edit_result("mpm_16.000000_softened", {{"at_rest", true}, {"flags", nlohmann::json::array()}});
    const fs::path second = folder_ / "tasks/mpm_13.000000_softened_d2";
    fs::copy(folder_ / "tasks/mpm_13.000000_softened", second, fs::copy_options::recursive);
    std::ofstream(second / "task.json")
        << R"({"phase": "mpm_solver", "variant": "softened_d2", "transfer_time": 13})";
    edit_result("mpm_13.000000_softened_d2", {{"at_rest", false}});
    std::ofstream(folder_ / "study.json") << R"({"variants": [{"name": "softened"},
        {"name": "softened_d2", "made_by": "draws"}, {"name": "not_softened"}]})";
    const auto mean = [](double time, double runout) {
        return nlohmann::json{
            {"transfer_time", time}, {"variant", "softened"},    {"draws", 2.0},
            {"draws_done", 2.0},     {"runout", runout},         {"runout_deviation", 2.5},
            {"missing_draws", ""},   {"questionable_draws", ""}, {"runout_error", nullptr}};
    };
    std::ofstream(folder_ / "results.json") << nlohmann::json{
        {"rows", nlohmann::json::array()}, {"means", {mean(13, 220), mean(16, 210)}}};
    const Document d = document();
    EXPECT_EQ(cell(d, "numbers_means", 0, "runout [m]"), "\u2265 220 +- 2.5");
    EXPECT_EQ(cell(d, "numbers_means", 1, "runout [m]"), "210 +- 2.5");
    EXPECT_EQ(figure(d, "runout_against_transfer_time").chart.series.front().certainty,
              (std::vector{Certainty::at_least, Certainty::certain}));
    const auto& rows = d.front.found.rows;
    const auto row = std::ranges::find_if(
        rows, [](const auto& each) { return each[0].starts_with("Runout, mean of 2 repeats"); });
    ASSERT_NE(row, rows.end());
    EXPECT_EQ((*row)[1], "\u2265 220");
}

TEST_F(WetRun, DrawsTheMeanOfItsDrawsWithTheirScatter) {
    const auto mean = [](double time, const nlohmann::json& deviation, const char* missing) {
        return nlohmann::json{{"transfer_time", time},
                              {"variant", ""},
                              {"draws", 3.0},
                              {"draws_done", 2.0},
                              {"runout", 100 + time},
                              {"runout_deviation", deviation},
                              {"missing_draws", missing},
                              {"questionable_draws", ""},
                              {"runout_error", nullptr}};
    };
    std::ofstream(folder_ / "results.json")
        << nlohmann::json{{"rows", nlohmann::json::array()},
                          {"means", {mean(13, 2.5, ""), mean(16, nullptr, "d2: failed")}}};
    const Document d = document();
    const Figure& against = figure(d, "runout_against_transfer_time");
    const Series& curve = against.chart.series.front();
    EXPECT_EQ(curve.name, "mean of the repeats");
    EXPECT_EQ(curve.y, (std::vector{113.0, 116.0}));
    EXPECT_EQ(curve.error[0], 2.5);
    EXPECT_TRUE(std::isnan(curve.error[1])) << "one repeat has no scatter";
    EXPECT_EQ(curve.certainty, (std::vector{Certainty::certain, Certainty::doubtful}));
    EXPECT_EQ(cell(d, "numbers_means", 0, "runout [m]"), "113 +- 2.5");
    EXPECT_EQ(cell(d, "numbers_means", 1, "runout [m]"), "116");
    EXPECT_EQ(cell(d, "numbers_means", 1, "repeats"), "2 of 3");
    EXPECT_EQ(cell(d, "numbers_means", 1, "not as it should be"), "without a result: d2: failed");
}

TEST_F(WetRun, DrawsHowFarARunoutIsOffWhereItIsKnown) {
    const auto row = [](double time, const nlohmann::json& error) {
        return nlohmann::json{{"transfer_time", time},
                              {"variant", "softened"},
                              {"runout_error", error},
                              {"runout_error_from", "scatter of 5 repeats"}};
    };
    std::ofstream(folder_ / "results.json")
        << nlohmann::json{{"rows", {row(13, 4.0), row(16, nullptr)}}};
    const Document d = document();
    const Figure& against = figure(d, "runout_against_transfer_time");
    const auto softened = std::ranges::find(against.chart.series, "softened", &Series::name);
    ASSERT_NE(softened, against.chart.series.end());
    const auto at = [&](double time) {
        return softened->error[std::ranges::find(softened->x, time) - softened->x.begin()];
    };
    EXPECT_EQ(at(13), 4.0);
    EXPECT_TRUE(std::isnan(at(16)));
    const auto other = std::ranges::find_if(
        against.chart.series, [](const Series& each) { return each.name != "softened"; });
    EXPECT_TRUE(other->error.empty()) << "nothing tells it";
}

TEST_F(WetRun, ReportsAnEntangledMeshAsARegularEnd) {
    flag_all();
    const Document d = document();
    EXPECT_EQ(cell(d, "numbers_fem_solver", 0, "how it ended"),
              "entangled at 20.5 s in element 212 (region sand, x = 1.5 m, y = 0.25 m), in the "
              "failure's band");
    EXPECT_EQ(cell(d, "numbers_fem_solver", 0, "settings"), "as in the scene");
    EXPECT_EQ(measures_of(read_run(folder_), {}).at("time_entangled").value, 20.5);
    const auto chapter = std::ranges::find(d.chapters, "Motion and failure", &Chapter::title);
    EXPECT_EQ(chapter->text.find("ended early"), std::string::npos) << chapter->text;
    EXPECT_NE(chapter->text.find("it is no fault"), std::string::npos) << chapter->text;
}

TEST_F(WetRun, ReportsTheSettingsOfItsOwnStudyForAResultFromAnEarlierRun) {
    edit_study({{"variants",
                 {{{"name", "softened"}, {"overrides", {"/mpm/cell_size=2"}}},
                  {{"name", "not_softened"}, {"overrides", nlohmann::json::array()}}}}});
    for (const std::string variant : {"softened", "not_softened"})
        std::ofstream(folder_ / "tasks" / ("mpm_16.000000_" + variant) / "task.json")
            << nlohmann::json{{"id", "t_" + variant},
                              {"phase", "mpm_solver"},
                              {"transfer_time", 16},
                              {"variant", variant},
                              {"same_as", "of another run"}};
    const Document d = document();
    EXPECT_EQ(cell(d, "numbers_mpm_solver", 0, "settings"), "/mpm/cell_size=1")
        << "of no service: what its result says";
    EXPECT_EQ(cell(d, "numbers_mpm_solver", 1, "settings"), "as in the scene");
    EXPECT_EQ(cell(d, "numbers_mpm_solver", 2, "settings"), "/mpm/cell_size=2");
}

TEST_F(WetRun, LooksAtTheFemBehindTheFarthestRunout) {
    const fs::path tasks = folder_ / "tasks";
    fs::copy(tasks / "fem", tasks / "fem_dense", fs::copy_options::recursive);
    fs::rename(tasks / "fem", tasks / "fem_softened");
    EXPECT_EQ(phase_shown(read_run(folder_), "fem_solver")->label, "fem_softened") << "by variant";
    const Document d = document();
    for (const char* title : {"Motion and failure", "Strain, pore pressure and mesh"}) {
        const auto chapter = std::ranges::find(d.chapters, title, &Chapter::title);
        EXPECT_TRUE(chapter->text.starts_with(
            "Of 2 finite element analyses the one behind the farthest runout: softened. "))
            << chapter->text;
    }

    const auto took = [](const char* path, const char* sha256) {
        return nlohmann::json{{"provenance", {{"inputs", {{{"path", path}, {"sha256", sha256}}}}}}};
    };
    edit_result("mpm_16.000000_softened",
                took("/data/runs/1/transfer_14.000000/output/particles.vtkhdf", "1a"));
    edit_result("transfer_14.000000",
                took("/data/runs/1/fem_softened/output/snapshot.vtkhdf", "2b"));
    EXPECT_EQ(phase_shown(read_run(folder_), "fem_solver")->label, "fem_softened") << "by folder";

    std::ofstream(tasks / "fem_dense/task.json")
        << R"({"phase": "fem_solver", "artifacts": [{"name": "snapshot.vtkhdf", "sha256": "2b"}]})";
    EXPECT_EQ(phase_shown(read_run(folder_), "fem_solver")->label, "fem_dense") << "by content";
}

TEST_F(WetRun, ShowsAVariantWithoutARunoutNoOtherVariantsFem) {
    const fs::path tasks = folder_ / "tasks";
    fs::copy(tasks / "fem", tasks / "fem_dense", fs::copy_options::recursive);
    fs::rename(tasks / "fem", tasks / "fem_softened");
    edit_study({{"variants",
                 {{{"name", "softened"}},
                  {{"name", "stands"}},
                  {{"name", "broken"}},
                  {{"name", "not_begun"}}}}});
    std::ofstream(tasks / "fem_dense/task.json") << R"({"id": "f2", "variant": "dense"})";
    std::ofstream(folder_ / "results.json") << R"({"rows": [], "without_transfer": [
        {"variant": "stands", "fem_task": "f2", "stood": true, "reason": "window: never met"}]})";
    std::ofstream(tasks / "transfer_14.000000/task.json")
        << R"({"phase": "transfer_tool", "transfer_time": 14, "variant": "broken"})";
    edit_result("transfer_14.000000",
                {{"provenance",
                  {{"inputs", {{{"path", "/data/fem_softened/snapshot.h5"}, {"sha256", "2b"}}}}}}});
    const auto run = read_run(folder_);
    EXPECT_EQ(phase_of_variant(run, "fem_solver", "stands")->label, "fem_dense") << "it waited";
    EXPECT_EQ(phase_of_variant(run, "fem_solver", "broken")->label, "fem_softened");
    EXPECT_EQ(phase_of_variant(run, "fem_solver", "not_begun"), nullptr);
    const Document d = document();
    EXPECT_EQ(cell(d, "variants", 1, "window opens [s]"), "15");
    EXPECT_EQ(cell(d, "variants", 3, "window opens [s]"), "-");
    EXPECT_EQ(cell(d, "variants", 3, "FEM ended"), "-");
    EXPECT_EQ(cell(d, "variants", 3, "how the runouts ended"), "none");
}

TEST_F(WetRun, DistinguishesABadCornerFromAFailure) {
    flag_all();
    edit_result("fem", {{"entanglement", {{"time", 20.5}, {"element", 3}, {"kind", "corner"}}},
                        {"flags",
                         {{{"code", "entangled_corner"},
                           {"severity", "questionable"},
                           {"message", "one corner folded"},
                           {"pointer", ""}}}}});
    const Document d = document();
    EXPECT_NE(in_one(d.verdict.cautions)
                  .find("The mesh entangled at 20.5 s in element 3, at one bad corner, not in a "
                        "failure's band. That is the mesh's doing"),
              std::string::npos)
        << in_one(d.verdict.cautions);
    EXPECT_EQ(cell(d, "numbers_fem_solver", 0, "how it ended"),
              "entangled at 20.5 s in element 3, at one bad corner, not in a failure's band; "
              "questionable: entangled corner");
}

TEST_F(WetRun, ReportsOnlyWhatItsOwnSceneAndStudySay) {
    fs::remove_all(folder_);
    write_wet_run(folder_, "other-dam");
    fs::create_directories(folder_ / "tasks/lem");
    fs::copy(folder_ / "tasks/fem/scene.completed.json",
             folder_ / "tasks/lem/scene.completed.json");
    std::ofstream(folder_ / "tasks/lem/result.json") << R"({"factor_of_safety": 1.5, "slices": 30,
        "circle": {"center": [1, 1], "radius": 1}, "entry": [0, 1], "exit": [2, 1]})";
    const auto run = read_run(folder_);
    const Measures m = measures_of(run, paper_for("other-dam"));
    for (const char* key :
         {"time_liquefied_12_m", "time_liquefied_critical", "runout_at_13:softened"})
        EXPECT_EQ(m.count(key), 0u) << key;
    EXPECT_EQ(m.at("factor_of_safety_intact").error, "30 slices");
    const std::string html = as_html(document(), "files");
    for (const char* others : {"upper dam", "50 slices", "r_u > 0.7", "threshold 20", "18.5 m"}) {
        EXPECT_EQ(html.find(others), std::string::npos) << others;
    }
}

TEST_F(WetRun, DrawsTheThresholdsOfItsTriggersAndTheLiquefactionOfItsScene) {
    const auto marks = [](const Figure& figure) {
        std::vector<double> levels;
        for (const Mark& each : figure.chart.marks) {
            if (each.at == Mark::At::y) levels.push_back(each.value);
        }
        return levels;
    };
    const Document d = document();
    EXPECT_EQ(marks(figure(d, "jacobian_average")), (std::vector<double>{0.97}));
    EXPECT_EQ(marks(figure(d, "epsilon_q_average")), (std::vector<double>{}));
    EXPECT_EQ(marks(figure(d, "liquefaction_depth")), (std::vector<double>{18.5}));
    EXPECT_EQ(figure(d, "liquefaction_depth").caption,
              "Depth of the deepest liquefied node below y = 1 m (/fem/liquefaction).");
    std::ofstream(folder_ / "study.json")
        << R"({"triggers": [{"kind": "criterion", "when": "0.2 < epsilon_q_avg and time > 3"}]})";
    EXPECT_EQ(marks(figure(document(), "epsilon_q_average")), (std::vector<double>{20}));
}

TEST_F(WetRun, TakesTheMotionThatTheFemKept) {
    std::ofstream(folder_ / "tasks/fem/motion.csv") << "time_s,acceleration_g\n0,0\n1,0.25\n2,0\n";
    const Series a = figure(document(), "motion_acceleration").chart.series.front();
    EXPECT_NEAR(a.y[1], 0.25, 1e-12) << "as applied: not scaled again";
}

TEST_F(WetRun, ReportsHowMuchOfTheMotionCameBeforeTheFemEnded) {
    const auto text = [&] {
        const Document d = document();
        return std::ranges::find(d.chapters, "Motion", &Chapter::title)->text;
    };
    EXPECT_EQ(text().find("whole record"), std::string::npos) << "the FEM outlasted it";
    flag_all();
    edit_result("fem", {{"end_time", 1.25}});
    // trapezoids of 0, 0.15, -0.3 of 0, 0.15, -0.3, 0.15, 0 g: 0.0675 / 2 of 0.0675
    EXPECT_NE(text().find("That is of the whole record. The finite elements ended at 1.25 s: until "
                          "then PGA 0.3 g and 50 % of the Arias intensity."),
              std::string::npos)
        << text();
    EXPECT_EQ(figure(document(), "motion_arias").chart.marks.front().value, 1.25);
}

TEST_F(WetRun, OfAnotherNameHasNoPaper) {
    fs::remove_all(folder_);
    write_wet_run(folder_, "slope");
    const Document d = document();
    EXPECT_NE(d.chapters.back().tables.front().name, "comparison");
    EXPECT_EQ(figure(d, "runout_against_transfer_time").chart.series.size(), 2u);
}

TEST_F(WetRun, ShowsPorePressureAndStrainOfItsElements) {
    const Document d = document();
    const Field r_u = *figure(d, "r_u_14s").chart.field;
    EXPECT_NEAR(r_u.value[0], 0.5, 1e-15) << "(5 - 1) / 8 at each node";
    EXPECT_NEAR(r_u.value[1], 0.75, 1e-15) << "half the nodes 0.5, half 1";
    EXPECT_EQ(figure(d, "epsilon_q_14s").chart.field->value, (std::vector<double>{1, 50}));
    EXPECT_EQ(r_u.x.front(), 0.25) << "where the node has moved to";
    EXPECT_EQ(figure(d, "mesh_14s").chart.series.front().x.size(), 14u) << "seven edges";
}

TEST_F(WetRun, ShowsWhatLiquefiedBeforeAndAfterTheTransfer) {
    const Document d = document();
    EXPECT_EQ(figure(d, "liquefied_before").chart.field->value, (std::vector<double>{0, 1}));
    EXPECT_EQ(figure(d, "liquefied_after").chart.field->value, (std::vector<double>{0, 0, 1, 1}));
}

TEST_F(WetRun, TakesTheMotionAsTheFemDoes) {
    const Document d = document();
    const Series& a = figure(d, "motion_acceleration").chart.series.front();
    EXPECT_NEAR(*std::ranges::min_element(a.y), -0.3, 1e-12) << "scaled to 0.3 g";
    const Series& arias = figure(d, "motion_arias").chart.series.front();
    // trapezoids: 0.5 s (0.15^2 + 0.3^2 + 0.15^2) g^2 pi / (2 g)
    EXPECT_NEAR(arias.y.back(), 0.5 * 0.135 * 9.80665 * M_PI / 2.0, 1e-9);
}

TEST_F(WetRun, ShowsFlowAtGaugesAndTheDeposit) {
    const Document d = document();
    EXPECT_EQ(figure(d, "gauge_velocity_16s").chart.series.front().y.back(), 3.5);
    EXPECT_EQ(figure(d, "deposit_profile").chart.series.front().y,
              (std::vector<double>{1, 0.5, 0.5}));
}

TEST_F(WetRun, IsOnePageThatNeedsNoNetworkWithAllItsFilesBesideIt) {
    const fs::path page = folder_ / "out/report.html";
    const Document d = document();
    write_report(d, page);
    const std::string html = text_of(page);
    for (const char* outside : {"http:", "https:", " src=", "<script", "@import"}) {
        EXPECT_EQ(html.find(outside), std::string::npos) << outside;
    }
    EXPECT_FALSE(std::regex_search(html, std::regex("url\\([^#]"))) << "more than its own hatches";
    std::size_t figures = 0;
    for (const Chapter& chapter : d.chapters) {
        for (const Figure& each : chapter.figures) {
            ++figures;
            const fs::path file = folder_ / "out/report_files" / each.name;
            EXPECT_EQ(text_of(file.string() + ".csv"), as_csv(each.chart)) << each.name;
            EXPECT_TRUE(fs::exists(file.string() + ".svg"));
            EXPECT_EQ(fs::exists(file.string() + ".png"), png_converter() == Converter::there);
            EXPECT_NE(html.find("<figure id=\"" + each.name + "\">"), std::string::npos);
        }
    }
    EXPECT_GT(figures, 15u);
    EXPECT_NE(html.find("Left out"), std::string::npos);
    EXPECT_NE(html.find("the run has no limit equilibrium"), std::string::npos);
}

TEST_F(WetRun, ShowsOnlyTelemetryThatItsSceneGivesAMeaning) {
    const Document d = document();
    EXPECT_EQ(figure(d, "liquefaction_depth").chart.series.front().y.back(), 20);
    EXPECT_EQ(figure(d, "pore_pressure_ratio").chart.series.front().y.back(), 0.95);
    for (const fs::directory_entry& each : fs::directory_iterator(folder_ / "tasks")) {
        const fs::path file = each.path() / "scene.completed.json";
        nlohmann::json scene = nlohmann::json::parse(text_of(file));
        scene["fem"].erase("liquefaction");
        std::ofstream(file) << scene.dump();
    }
    EXPECT_THROW(figure(document(), "pore_pressure_ratio"), std::runtime_error)
        << "nothing is watched";
}

TEST_F(WetRun, WithoutAFileThatAPhaseDidNotReachSaysSo) {
    fs::remove(folder_ / "tasks/fem/telemetry.jsonl");
    fs::remove(folder_ / "tasks/fem/snapshot_14.000000.vtkhdf");
    fs::remove(folder_ / "tasks/fem/shake.csv");
    std::string why;
    for (const LeftOut& each : document().left_out) why += each.why + "\n";
    EXPECT_NE(why.find("before its first line of telemetry"), std::string::npos);
    EXPECT_NE(why.find("left no snapshot"), std::string::npos);
    EXPECT_NE(why.find("no snapshot at t_T = 14 s"), std::string::npos);
    EXPECT_NE(why.find("give it with --motion"), std::string::npos);
}

TEST_F(WetRun, WithASceneThatIsNotWholeIsRefused) {
    std::ofstream(folder_ / "tasks/mpm_13.000000_softened/scene.completed.json") << "{}";
    EXPECT_THROW(document(), fault::BadInput);
}

TEST_F(WetRun, WithALineThatIsNoTelemetryIsRefused) {
    std::ofstream(folder_ / "tasks/fem/telemetry.jsonl") << "{\"time\":0}\nnonsense\n";
    EXPECT_THROW(document(), fault::BadInput);
}

TEST_F(WetRun, MistakesNoVariantsNameForATransferTime) {
    const fs::path tasks = folder_ / "tasks";
    const auto add = [&](const std::string& label) {
        fs::copy(tasks / "mpm_16.000000_softened", tasks / label, fs::copy_options::recursive);
        fs::remove(tasks / label / "task.json");
    };
    const std::vector<std::string> names{"20_kpa", "20.5_kpa", "inflow", "inf_low", "nan_dry"};
    for (const std::string& each : names) add("mpm_" + each);
    add("mpm_20.000000_kpa");
    add("mpm_21.000000_kpa");
    std::ofstream(tasks / "mpm_21.000000_kpa/task.json") << R"({"phase": "mpm_solver",
        "variant": "21.000000_kpa", "transfer_time": null})";
    nlohmann::json rows = nlohmann::json::array();
    for (const std::string& each : names)
        rows.push_back({{"variant", each}, {"transfer_time", nullptr}, {"runout_error", 4.0}});
    std::ofstream(folder_ / "results.json") << nlohmann::json{{"rows", rows}};
    const auto run = read_run(folder_);
    const auto phase = [&](const std::string& label) {
        return *std::ranges::find(run.phases, label, &PhaseFolder::label);
    };
    for (const std::string& each : names) {
        EXPECT_EQ(phase("mpm_" + each).variant, each);
        EXPECT_FALSE(phase("mpm_" + each).transfer_time) << each;
        EXPECT_EQ(phase("mpm_" + each).runout_error, 4.0) << each;
    }
    EXPECT_EQ(phase("mpm_20.000000_kpa").transfer_time, 20.0);
    EXPECT_EQ(phase("mpm_20.000000_kpa").variant, "kpa");
    EXPECT_FALSE(phase("mpm_21.000000_kpa").transfer_time) << "its task says that it has none";
    EXPECT_EQ(phase("mpm_21.000000_kpa").variant, "21.000000_kpa");
}

TEST_F(WetRun, OfRunoutsAloneHasNoTwoFiguresOfOneName) {
    for (const char* each : {"fem", "transfer_14.000000"}) fs::remove_all(folder_ / "tasks" / each);
    edit_result("mpm_16.000000_not_softened", {{"runout", 105.0}});  // half of the largest
    EXPECT_FALSE(is_static(read_run(folder_))) << "they have transfer times";
    const Document d = document();
    std::vector<std::string> names;
    for (const Chapter& chapter : d.chapters)
        for (const Figure& each : chapter.figures) names.push_back(each.name);
    EXPECT_EQ(std::ranges::count(names, "final_geometry_16s"), 1);
    std::ranges::sort(names);
    EXPECT_EQ(std::ranges::adjacent_find(names), names.end());
}

TEST(RunFolder, WithoutPhasesIsRefused) {
    EXPECT_THROW(read_run("/nonexistent"), fault::IoError);
    const fs::path empty = fs::temp_directory_path() / ("no_run_" + std::to_string(getpid()));
    fs::create_directories(empty);
    EXPECT_THROW(read_run(empty), fault::BadInput);
    fs::remove_all(empty);
}

TEST(TableData, QuotesTextAndKeepsNumbers) {
    Table table{"t", "t", {"what", "value"}, {{"a \"b\"", "1.5"}}};
    EXPECT_EQ(as_csv(table), "\"what\",\"value\"\n\"a \"\"b\"\"\",1.5\n");
    table.rows.push_back({"short"});
    EXPECT_THROW(as_csv(table), std::invalid_argument);
}

TEST(ColourRange, EndsAtARoundNumberAboveNearlyAll) {
    EXPECT_DOUBLE_EQ(colour_range({0.1, 1.7, 0.27}).high, 0.3)
        << "rank 99 % of three is the middle one";
    EXPECT_EQ(colour_range(std::vector<double>(100, 3.2)).high, 4.0);
    EXPECT_EQ(colour_range({0.0, 0.0}).high, 1.0);
}

}  // namespace
}  // namespace breach::report
