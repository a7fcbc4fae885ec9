// The paper's calibration, automated: from the default parameters to undrained strengths of 4.3,
// 6.5 and 11.1 kPa at 50, 100 and 250 kPa (Sordo et al., Table 3) with the cyclic strength of the
// default soil.
#include "element_bench/calibration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "element_bench/document.hpp"
#include "soils.hpp"

namespace breach::testing::calibration_test {
namespace {

using namespace element_bench;

CalibrationProblem paper_case(const pm4sand::Options& options) {
    CalibrationProblem problem{.start = soil("tailings_def"),
                               .reference = soil("tailings_def"),
                               .free = {{"Q", 6.0, 20.0}, {"R", 0.5, 8.0}, {"h_po", 0.05, 20.0}},
                               .strength = {{50e3, 0.5, 0.10, 4.3e3},
                                            {100e3, 0.5, 0.10, 6.5e3},
                                            {250e3, 0.5, 0.10, 11.1e3}},
                               .cyclic = {},
                               .options = options};
    for (const double sigma_v : {50e3, 100e3}) {
        for (const double CSR : {0.08, 0.10, 0.12, 0.14}) {
            problem.cyclic.push_back({sigma_v, 0.5, CSR, 0.03});
        }
    }
    return problem;
}

void print(const char* what, const Fit& fit) {
    std::printf("%s: Q %.4f R %.4f h_po %.4f, misfit %.3f\n", what, fit.values[0], fit.values[1],
                fit.values[2], fit.misfit);
    for (const Term& term : fit.terms) {
        std::printf("    %-24s wanted %10.4f computed %10.4f deviation %+.4f share %.4f\n",
                    term.name.c_str(), term.wanted, term.computed, term.deviation, term.share);
    }
}

const std::vector<double> paper{11.998, 3.75, 2.70};

TEST(CalibrationOfThePaper, EndsBetterThanThePaperFromTheDefaults) {
    const Calibration calibration(paper_case({}));
    const Fit of_paper = calibration.evaluate(paper);
    const CalibrationResult result = calibrate(calibration);
    print("defaults", result.first);
    print("paper", of_paper);
    print("found", result.best);
    std::printf("%d evaluations; path:\n", result.evaluations);
    for (const Fit& fit : result.path) {
        std::printf("    Q %8.4f R %7.4f h_po %7.4f misfit %10.4f\n", fit.values[0], fit.values[1],
                    fit.values[2], fit.misfit);
    }
    EXPECT_LE(result.best.misfit, of_paper.misfit);
}

TEST(CalibrationOfThePaper, FindsThePapersParametersAgainFromTheirOwnStrengths) {
    // Targets that the paper's parameters meet exactly allow a misfit of zero.
    CalibrationProblem problem = paper_case({});
    problem.reference = soil("tailings_cal");
    for (StrengthTarget& target : problem.strength) {
        CalibrationProblem alone = problem;
        alone.strength = {target};
        alone.cyclic.clear();
        target.s_u = Calibration(alone).evaluate(paper).terms[0].computed;
    }
    const CalibrationResult result = calibrate(Calibration(problem));
    print("found again", result.best);
    EXPECT_LT(result.best.misfit, 1e-2);
}

TEST(CalibrationOfThePaper, GivesTheSameAnswerTwice) {
    CalibrationProblem problem = paper_case({});
    problem.cyclic.resize(1);
    problem.most_evaluations = 80;
    const Calibration calibration(problem);
    EXPECT_EQ(calibrate(calibration).best.values, calibrate(calibration).best.values);
}

TEST(CalibrationOfThePaper, SchemesDifferInTheStrengthOfThePapersParameters) {
    for (const auto scheme : {pm4sand::Scheme::reference, pm4sand::Scheme::adaptive}) {
        CalibrationProblem problem = paper_case({.scheme = scheme});
        problem.cyclic.clear();
        const Fit fit = Calibration(problem).evaluate(paper);
        for (const Term& term : fit.terms) {
            std::printf("%-9s %s: %.4f kPa, the paper says %.1f\n",
                        scheme == pm4sand::Scheme::reference ? "reference" : "adaptive",
                        term.name.c_str(), term.computed / 1e3, term.wanted / 1e3);
        }
        EXPECT_LT(fit.misfit, 20.0);
    }
}

/// Cycles of a soil at two stresses, as laboratory data.
CalibrationProblem measured_on(const SandParameters& truth) {
    CalibrationProblem problem{.start = soil("tailings_def"),
                               .reference = truth,
                               .free = {{"h_po", 0.1, 10.0}, {"Q", 8.0, 15.0}},
                               .strength = {},
                               .cyclic = {{100e3, 0.5, 0.10, 0.03},
                                          {100e3, 0.5, 0.14, 0.03},
                                          {300e3, 0.5, 0.09, 0.03},
                                          {300e3, 0.5, 0.12, 0.03}},
                               .options = {},
                               .most_evaluations = 160};
    const Fit fit = Calibration(problem).evaluate({problem.start.h_po, problem.start.Q});
    for (std::size_t k = 0; k < problem.cyclic.size(); ++k)
        problem.cyclic[k].N = fit.terms[k].wanted;
    problem.reference.reset();
    return problem;
}

TEST(CalibrationToTheLaboratory, FindsTheSoilThatTheCurvesOfTwoStressesCameFrom) {
    SandParameters truth = soil("tailings_def");
    truth.h_po = 1.7;
    truth.Q = 10.9;
    const CalibrationProblem problem = measured_on(truth);
    const Calibration calibration(problem);
    EXPECT_EQ(calibration.evaluate({truth.h_po, truth.Q}).misfit, 0.0);
    const CalibrationResult result = calibrate(calibration);
    std::printf("h_po %.4f Q %.4f, misfit %.5f after %d\n", result.best.values[0],
                result.best.values[1], result.best.misfit, result.evaluations);
    for (const Term& term : result.best.terms) EXPECT_LT(std::abs(term.deviation), 0.01);
    EXPECT_NEAR(result.best.values[0], truth.h_po, 0.03 * truth.h_po);
    EXPECT_NEAR(result.best.values[1], truth.Q, 0.03 * truth.Q);
}

TEST(CalibrationToTheLaboratory, WeighsItsTargetsAndNeedsWhatItCountsAgainst) {
    SandParameters truth = soil("tailings_def");
    truth.h_po = 1.7;
    CalibrationProblem problem = measured_on(truth);
    const std::vector<double> start{problem.start.h_po, problem.start.Q};
    const Fit plain = Calibration(problem).evaluate(start);
    problem.cyclic[1].weight = 0.0;
    problem.cyclic[2].weight = 3.0;
    const Fit weighted = Calibration(problem).evaluate(start);
    EXPECT_GT(plain.terms[1].share, 0.0);
    EXPECT_EQ(weighted.terms[1].share, 0.0);
    EXPECT_DOUBLE_EQ(weighted.terms[2].share, 3.0 * plain.terms[2].share);
    problem.cyclic[0].N.reset();
    EXPECT_THROW(Calibration{problem}, std::invalid_argument);
}

/// With a slope of 0 between repeats, any count would fit.
TEST(CalibrationToTheLaboratory, RepeatsAtOneStressRatioCountAsItsMeanDoes) {
    const auto problem = [](std::vector<CyclicTarget> targets) {
        return CalibrationProblem{.start = soil("embankment"),
                                  .reference = {},
                                  .free = {{"h_po", 0.05, 5.0}},
                                  .strength = {},
                                  .cyclic = std::move(targets),
                                  .options = {},
                                  .most_evaluations = 20};
    };
    const auto at = [](double CSR, double N, double strain = 0.03) {
        return CyclicTarget{100e3, 0.5, CSR, strain, N};
    };
    const double mean = std::sqrt(40.0 * 60.0);
    const double wanted = calibrate(Calibration(problem({at(0.15, mean)}))).parameters.h_po;
    const CalibrationResult repeats = calibrate(Calibration(problem({at(0.15, 40), at(0.15, 60)})));
    std::printf("h_po %.4f of repeats, %.4f of their mean, misfit %.3f -> %.3f\n",
                repeats.parameters.h_po, wanted, repeats.first.misfit, repeats.best.misfit);
    EXPECT_NEAR(repeats.parameters.h_po, wanted, 0.02 * wanted);
    EXPECT_NEAR(wanted, 1.83, 0.06);
    EXPECT_GT(repeats.first.misfit, 10.0);
    EXPECT_NEAR(repeats.best.misfit, 2.0 * std::pow(0.2 * std::log(1.5) / 2.0 / 0.05, 2), 0.02);

    const auto slopes = [&](std::vector<CyclicTarget> targets) {
        const Calibration calibration(problem(std::move(targets)));
        std::vector<double> out;
        for (const Term& term : calibration.evaluate({0.4}).terms)
            out.push_back(-term.deviation / std::log(term.computed / term.wanted));
        return out;
    };
    const auto expect_usual = [&](std::vector<CyclicTarget> targets) {
        for (const double slope : slopes(std::move(targets))) EXPECT_NEAR(slope, -0.2, 1e-12);
    };
    expect_usual({at(0.15, 40), at(0.151, 60), at(0.149, 50)});  // scatter
    expect_usual({at(0.15, 30), at(0.20, 40)});                  // rises
    expect_usual({at(0.15, 40, 0.01), at(0.20, 30, 0.05)});      // two limits of strain
    for (const double slope : slopes({at(0.15, 49), at(0.20, 12)}))
        EXPECT_NEAR(slope, std::log(0.15 / 0.20) / std::log(49.0 / 12.0), 1e-12);
}

/// The document of a calibration to one file and one list.
scene::Scene document_with(const std::string& lines) {
    const auto folder = std::filesystem::temp_directory_path() / "breach_crr";
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "crr.csv") << lines;
    std::ofstream(folder / "bench.json") << R"({
        "format": "breachline-element-test/1", "name": "crr", "title": "",
        "law": {"type": "pm4sand", "D_R": 0.35, "G_0": 476, "h_po": 0.53},
        "calibration": {
            "free": {"h_po": {"least": 0.05, "most": 20}},
            "cyclic_strength": [
                {"sigma_v_kPa": 100, "file": "crr.csv"},
                {"sigma_v_kPa": 300, "K0": 1, "points": [{"CSR": 0.1, "N": 12}]}]}})";
    return read_document(folder / "bench.json", {});
}

TEST(CalibrationToTheLaboratory, ReadsCurvesFromAFileAndFromTheDocument) {
    const auto bench =
        bench_of(document_with("CSR,N,weight\n0.12,15\n\n0.16;4.5;0.5  # the last\n"));
    const auto& targets = bench.calibration->cyclic;
    ASSERT_EQ(targets.size(), 3u);
    EXPECT_EQ(targets[0].CSR, 0.12);
    EXPECT_EQ(targets[0].N, 15.0);
    EXPECT_EQ(targets[0].weight, 1.0);
    EXPECT_EQ(targets[1].weight, 0.5);
    EXPECT_EQ(targets[1].sigma_v, 100e3);
    EXPECT_EQ(targets[2].sigma_v, 300e3);
    EXPECT_EQ(targets[2].K0, 1.0);
    EXPECT_FALSE(bench.calibration->reference.has_value());
    for (const char* wrong : {"0.12\n", "0.12,x\n", "12,0.15\n", "0.12,15,-1\n", "\n"})
        EXPECT_THROW(document_with(wrong), fault::BadInput) << wrong;
}

}  // namespace
}  // namespace breach::testing::calibration_test
