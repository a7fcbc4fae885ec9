#include "services/report/run_report.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "core/fault/fault.hpp"
#include "services/report/chart/page.hpp"
#include "services/report/chart/png.hpp"
#include "services/report/figures/mesh_figures.hpp"
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
    const Measures m = measures_of(read_run(folder_));
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
}

TEST_F(WetRun, ShowsThePapersNumbersBesideItsOwn) {
    const Document d = document();
    const Table table = d.chapters.back().tables.front();
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
    EXPECT_EQ(measures_of(read_run(folder_)).count("window_lower"), 0u) << "no stability analysis";
    fs::create_directories(folder_ / "tasks/lem");
    fs::copy(folder_ / "tasks/fem/scene.completed.json",
             folder_ / "tasks/lem/scene.completed.json");
    std::ofstream(folder_ / "tasks/lem/result.json") << R"({"critical_depth": 12.25})";
    const Measures m = measures_of(read_run(folder_));
    EXPECT_EQ(m.at("window_lower").value, 11);
    EXPECT_EQ(m.at("window_upper").value, 18);
}

TEST_F(WetRun, TellsWhatEachVariantChanges) {
    const Document d = document();
    const auto chapter = std::ranges::find(d.chapters, "Variants", &Chapter::title);
    ASSERT_NE(chapter, d.chapters.end());
    const auto& rows = chapter->tables.front().rows;
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0][1], "nothing");
    EXPECT_EQ(rows[1][1],
              "/materials/*/viscosity=0 (2 materials); /mpm/terrain=[[0,0],[2,0],[102,-20]]");
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

TEST_F(WetRun, CarriesTheVariantsOfACompanion) {
    Choice choice;
    choice.companions = {folder_};
    const Document d = document_of(read_run(folder_), choice);
    ASSERT_GE(d.chapters.size(), 2u);
    const Chapter& last = d.chapters.back();
    EXPECT_EQ(last.title, "Variants: wet");
    EXPECT_EQ(last.tables.front().name, "variants_wet");
    EXPECT_EQ((d.chapters.end() - 2)->figures.front().name, "ground_softened_wet");
}

TEST_F(WetRun, TakesTheMotionThatTheFemKept) {
    std::ofstream(folder_ / "tasks/fem/motion.csv") << "time_s,acceleration_g\n0,0\n1,0.25\n2,0\n";
    const Series a = figure(document(), "motion_acceleration").chart.series.front();
    EXPECT_NEAR(a.y[1], 0.25, 1e-12) << "as applied: not scaled again";
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
    for (const char* outside : {"http:", "https:", " src=", "<script", "@import", "url("}) {
        EXPECT_EQ(html.find(outside), std::string::npos) << outside;
    }
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
    EXPECT_THROW(figure(d, "pore_pressure_ratio"), std::runtime_error) << "no /fem/water";
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
