// Every row of the reference tables in ../shared/reference/norsand (Runge-Kutta runs of the same
// equations with 8000 steps and more), at two tolerances. Skipped without the tables.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <regex>

#include "tests/verification/norsand/soils.hpp"
#include "tests/verification/norsand/tables.hpp"

namespace breach::testing::open_rows_test {
namespace {

using element_bench::Boundary;
using element_bench::Specimen;

const std::filesystem::path folder = std::filesystem::path(BREACH_SHARED) / "reference/norsand";

/// Parameters in a file's name.
struct Run {
    Specimen start;
    Boundary boundary;
};

Run run_of(const std::string& name, double tolerance) {
    const std::regex pattern(
        "[a-z]+_([A-Za-z0-9]+)_(txc_dr|txc_un|txe_dr|txe_un|dss|psc_dr|psc_un)_([0-9.]+)_psi([-+0-"
        "9.]+)"
        "(_OCR[0-9.]+)?(_K0([0-9.]+))?(_S([0-9.]+))?(_(radial|normal))?");
    std::smatch part;
    if (!std::regex_match(name, part, pattern)) throw std::runtime_error("no test: " + name);
    static const std::map<std::string, Boundary> boundaries{
        {"txc_dr", Boundary::drained_compression}, {"txc_un", Boundary::undrained_compression},
        {"txe_dr", Boundary::drained_extension},   {"txe_un", Boundary::undrained_extension},
        {"dss", Boundary::undrained_shear},        {"psc_dr", Boundary::drained_biaxial},
        {"psc_un", Boundary::undrained_biaxial}};
    norsand::Parameters parameters = soil(part[1]);
    if (part[1] == "NK" && part[2] == "txc_un") parameters.H_0 = 40.0;
    parameters.S = part[9].matched ? std::stod(part[9]) : 0.0;
    if (part[11] == "radial") parameters.flow = norsand::FlowRule::radial;
    if (part[11] == "normal") parameters.flow = norsand::FlowRule::normal;
    const std::string test = part[2];
    const double K0 = part[7].matched ? std::stod(part[7]) : test.starts_with("psc") ? 0.5 : 1.0;
    const double R = part[5].matched ? std::stod(part[5].str().substr(4)) : 1.0;
    return {specimen(parameters, 1e3 * std::stod(part[3]), K0, std::stod(part[4]),
                     {.tolerance = tolerance}, R),
            boundaries.at(test)};
}

/// Largest deviations over all rows, relative to the row's value; q near its start relative to p.
struct Deviation {
    double p = 0.0, q = 0.0, stress = 0.0, e = 0.0, p_i = 0.0;
    double peak = 0.0;
    double largest() const { return std::max({p, q, stress, e, p_i, peak}); }
};

Deviation deviation_of(const Table& table, const Run& run) {
    constexpr double longest_step = 2e-4;
    const auto at = [&](const char* name, std::size_t row) { return table.columns.at(name)[row]; };
    Deviation out;
    Specimen now = run.start;
    const double held = element_bench::held_stress(now, run.boundary);
    double peak = 0.0, wanted_peak = 0.0;
    for (std::size_t row = 0; row < table.rows; ++row) {
        const double strain = at("strain", row);
        const double way = strain - element_bench::driven_strain(now, run.boundary);
        const long steps = std::max(1L, std::lround(std::ceil(way / longest_step)));
        for (long i = 0; row > 0 && i < steps; ++i) {
            const auto trial =
                element_bench::driven(now, run.boundary, way / static_cast<double>(steps), held);
            EXPECT_EQ(trial.outcome, element_bench::Ending::done) << "strain " << strain;
            if (trial.outcome != element_bench::Ending::done) return {1.0};
            now = trial.specimen;
        }
        const norsand::Reading ours = reading(now);
        const mechanics::Voigt sigma = element_bench::stress(now);
        const double p = 1e3 * at("p", row), q = 1e3 * at("q", row);
        const auto widen = [](double& most, double found) {
            most = std::max(most, std::isfinite(found) ? std::abs(found) : 1.0);
        };
        widen(out.p, ours.p / p - 1.0);
        widen(out.q, (ours.q - q) / std::max(q, 0.01 * p));
        widen(out.stress, (-sigma[0] - 1e3 * at("sig_xx", row)) / p);
        widen(out.stress, (-sigma[1] - 1e3 * at("sig_yy", row)) / p);
        widen(out.stress, (-sigma[2] - 1e3 * at("sig_zz", row)) / p);
        widen(out.stress, (std::abs(sigma[3]) - 1e3 * at("tau_xy", row)) / p);
        widen(out.e, state_of(now).e / at("e", row) - 1.0);
        widen(out.p_i, state_of(now).p_i / (1e3 * at("p_i", row)) - 1.0);
        peak = std::max(peak, ours.q);
        wanted_peak = std::max(wanted_peak, q);
    }
    out.peak = std::abs(peak / wanted_peak - 1.0);
    return out;
}

class OpenRows : public ::testing::TestWithParam<std::string> {};

TEST_P(OpenRows, AreMetOnEveryRow) {
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not here";
    const Table table = read_table(folder / (GetParam() + ".csv"));
    ASSERT_GT(table.rows, 100u);
    for (const auto& [tolerance, allowed] : {std::pair{1e-6, 2e-4}, std::pair{1e-4, 1e-3}}) {
        const Deviation found = deviation_of(table, run_of(GetParam(), tolerance));
        std::printf("%-48s %.0e: p %.1e q %.1e stress %.1e e %.1e p_i %.1e peak %.1e / %.0e\n",
                    GetParam().c_str(), tolerance, found.p, found.q, found.stress, found.e,
                    found.p_i, found.peak, allowed);
        EXPECT_LT(found.largest(), allowed) << "tolerance " << tolerance;
    }
}

std::vector<std::string> open_runs() {
    std::vector<std::string> names;
    if (std::filesystem::exists(folder)) {
        for (const auto& entry : std::filesystem::directory_iterator(folder)) {
            const std::string name = entry.path().stem();
            if (name.starts_with("open_") && name != "open_summary") names.push_back(name);
        }
    }
    if (names.empty()) names.emplace_back("none");
    std::sort(names.begin(), names.end());
    return names;
}

INSTANTIATE_TEST_SUITE_P(NorSand, OpenRows, ::testing::ValuesIn(open_runs()), [](const auto& run) {
    std::string name = std::regex_replace(run.param, std::regex("\\+"), "p");
    return std::regex_replace(name, std::regex("[^A-Za-z0-9]"), "_");
});

}  // namespace
}  // namespace breach::testing::open_rows_test
