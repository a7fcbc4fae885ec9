// Cyclic strength of the tailings against OpenSees, and with the default scheme. N counts as in the
// reference (element_bench/programme.hpp).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "element_bench/programme.hpp"
#include "soils.hpp"

namespace breach::testing::cyclic_strength_test {
namespace {

using element_bench::Boundary;
using element_bench::CyclicResult;
using element_bench::SandPoint;
using element_bench::Specimen;
using pm4sand::Options;
using pm4sand::Scheme;

struct Row {
    std::string material;
    double sigma_v;
    bool consolidation_strain;
    double CSR, N_3, N_1;
};

std::vector<Row> reference_rows() {
    std::ifstream in(BREACH_ROOT "/tests/verification/pm4sand/reference/crr_tailings.csv");
    std::vector<Row> rows;
    std::string line;
    std::getline(in, line);
    while (std::getline(in, line)) {
        std::stringstream cells(line);
        std::vector<std::string> cell;
        for (std::string each; std::getline(cells, each, ',');) cell.push_back(each);
        rows.push_back({cell[0], std::stod(cell[1]), cell[3] != "reset_to_Dr", std::stod(cell[4]),
                        std::stod(cell[5]), std::stod(cell[6])});
    }
    return rows;
}

/// Volumetric strain of the elastic consolidation at K0 = 0.5 (nu = K0 / (1 + K0), G = G_0 p_atm).
double consolidation_strain(const pm4sand::Parameters& law, double sigma_v) {
    return 1e3 * sigma_v / pm4sand::elastic_stage(law, 1.0 / 3.0).constrained_modulus();
}

CyclicResult cycles(const Row& row, double step, const Options& options) {
    const pm4sand::Ready law = pm4sand::ready(soil(row.material));
    const mechanics::Voigt sigma(-500.0 * row.sigma_v, -1e3 * row.sigma_v, 0.0, 0.0);
    const double epsilon_v =
        row.consolidation_strain ? consolidation_strain(law.parameters, row.sigma_v) : 0.0;
    const Specimen specimen{
        SandPoint{law, options, pm4sand::initialise(law, sigma, epsilon_v, options.scheme)}};
    return element_bench::cyclic_stress(specimen, Boundary::undrained_shear,
                                        {.amplitude = row.CSR * 1e3 * row.sigma_v},
                                        {.strain = 0.03}, {.step = step, .every = 0});
}

/// N to 3 % by the reference scheme; allowed: 1e-3 relative.
void expect_parity(const Row& row) {
    const CyclicResult result = cycles(row, 1e-5, {.scheme = Scheme::reference});
    const double error = result.N_strain / row.N_3 - 1.0;
    std::printf(
        "%-12s %3.0f kPa %-14s CSR %.2f: N to 3 %% computed %.5f reference %.5f relative "
        "%.1e (allowed 1e-3)\n",
        row.material.c_str(), row.sigma_v, row.consolidation_strain ? "consolidated" : "reset",
        row.CSR, result.N_strain, row.N_3, error);
    EXPECT_NEAR(error, 0.0, 1e-3);
}

TEST(CyclicStrength, ReferenceSchemeCountsTheCyclesOfOpenSeesInEveryRow) {
    for (const Row& row : reference_rows()) expect_parity(row);
}

}  // namespace
}  // namespace breach::testing::cyclic_strength_test
