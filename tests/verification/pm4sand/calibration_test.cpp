// The paper's calibration made automatic: from the default parameters to undrained strengths
// of 4.3, 6.5 and 11.1 kPa at 50, 100 and 250 kPa (Sordo et al., Table 3) with the cyclic strength
// of the default soil.
#include "fem_solver/element_bench/calibration.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "soils.hpp"

namespace breach::testing {
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
    // Targets that the paper's parameters meet exactly leave a misfit of nothing to reach.
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

}  // namespace
}  // namespace breach::testing
