// Converts the entry `norsand_calibration`: kilopascals to pascals, engineering strains to
// logarithmic ones, columns of a laboratory (u, p or the cell pressure) to p and q. Checks what one
// row cannot show: where a test begins, how strong the soil is, whether a radial stress is left.
#include "element_bench/norsand_document.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "element_bench/triaxial_file.hpp"

namespace breach::element_bench {

namespace norsand = materials::norsand;
using fault::Fault;
using nlohmann::json;

namespace {

using Column = std::vector<double>;

/// Compression positive: a specimen that shortens by `engineering` has the length 1 - engineering.
double logarithmic(double engineering) { return -std::log1p(-engineering); }

/// p from the radial stress and q, unless the file has it: sigma_3 = cell pressure - u, p =
/// sigma_3 + q / 3. Without a column cell_kPa the cell pressure is that after consolidation.
TriaxialTest test_of(const std::string& name, const json& entry, bool engineering) {
    TriaxialTest test{.name = name,
                      .boundary = words::word_at<Boundary>(entry, "boundary"),
                      .p_0 = 1e3 * entry.at("p_0_kPa").get<double>(),
                      .K0 = entry.at("K0"),
                      .e_0 = entry.at("e_0"),
                      .measured = {}};
    const json& from = entry.at("measured");
    const auto column = [&](const char* key) { return from.value(key, Column{}); };
    const Column q = column("q_kPa"), u = column("u_kPa"), p = column("p_kPa");
    const Column cell = column("cell_kPa"), volume = column("epsilon_v");
    const double radial = radial_stress(test);
    TriaxialCurve& out = test.measured;
    out.epsilon_1 = column("epsilon_1");
    for (std::size_t i = 0; i < q.size(); ++i) {
        out.q.push_back(1e3 * q[i]);
        const double excess = u.empty() ? 0.0 : 1e3 * u[i];
        const double sigma_3 = (cell.empty() ? radial : 1e3 * cell[i]) - excess;
        out.p.push_back(p.empty() ? sigma_3 + out.q[i] / 3.0 : 1e3 * p[i]);
        const double strain = is_drained(test.boundary) ? volume[i] : 0.0;
        out.epsilon_v.push_back(engineering ? logarithmic(strain) : strain);
    }
    if (engineering) std::ranges::transform(out.epsilon_1, out.epsilon_1.begin(), logarithmic);
    return test;
}

/// Laboratories report strains over the first length; the law's are logarithmic. A
/// measured 0.20 becomes 0.22.
bool is_engineering(const json& entry) { return entry.at("strains") == "engineering"; }

/// Checks a test's columns against its entry.
/// A wrong unit shows in these: kilopascals given as pascals, or a back pressure left in u.
void check_test(const std::string& name, const json& entry, bool engineering,
                std::vector<Fault>& faults) {
    constexpr double most_off = 0.25;  // of p_0, with the first load already applied
    constexpr double least_q = 0.05;   // over p_0: weaker than any soil
    const std::string pointer = "/norsand_calibration/tests/" + name;
    const TriaxialTest test = test_of(name, entry, engineering);
    const double begins = test.measured.p.front();
    if (std::abs(begins / test.p_0 - 1.0) > most_off) {
        faults.push_back({pointer + "/p_0_kPa",
                          "is " + std::to_string(test.p_0 / 1e3) + ", and the test begins at p = " +
                              std::to_string(begins / 1e3) + " kPa",
                          "give effective stresses in kPa, u as excess over the back pressure"});
        return;
    }
    const double most_q = std::ranges::max(test.measured.q);
    if (most_q < least_q * test.p_0) {
        faults.push_back({pointer + "/p_0_kPa",
                          "is " + std::to_string(test.p_0 / 1e3) + ", and q reaches only " +
                              std::to_string(most_q / 1e3) + " kPa",
                          "give p_0_kPa and q_kPa in kPa"});
        return;
    }
    for (std::size_t i = 0; i < test.measured.p.size(); ++i) {
        const double p = test.measured.p[i], q = test.measured.q[i];
        if (p > 0.0 && q < 3.0 * p) continue;
        faults.push_back(
            {pointer + "/file",
             "leaves no radial stress at epsilon_1 " +
                 std::to_string(entry.at("measured").at("epsilon_1")[i].get<double>()) + " (row " +
                 std::to_string(i + 1) + "): p = " + std::to_string(p / 1e3) +
                 ", q = " + std::to_string(q / 1e3) + " kPa",
             "check q_kPa, u_kPa and p_0_kPa"});
        return;
    }
}

}  // namespace

void take_in_triaxial_files(json& entry, const std::filesystem::path& folder,
                            std::vector<Fault>& faults) {
    if (entry.at("given").contains("Gamma") != entry.at("given").contains("lambda")) {
        faults.push_back({"/norsand_calibration/given", "has half a critical state line",
                          "give Gamma and lambda, or neither"});
    }
    if (entry.at("tests").size() < 2) {
        faults.push_back({"/norsand_calibration/tests", "has fewer than two tests",
                          "a critical state line needs two, a calibration should have six"});
    }
    for (auto& [name, test] : entry.at("tests").items()) {
        std::filesystem::path file = test.at("file").get<std::string>();
        if (file.is_relative()) file = folder / file;
        // Only a file that was read without fault has columns to check.
        const std::size_t before = faults.size();
        test["measured"] =
            read_triaxial_file(file, words::word_at<Boundary>(test, "boundary"),
                               "/norsand_calibration/tests/" + name + "/file", faults);
        if (faults.size() == before) check_test(name, test, is_engineering(entry), faults);
    }
}

/// A document of read_document() is complete, so that only `given` may lack keys.
NorSandProblem norsand_problem_of(const json& entry) {
    NorSandProblem problem{.law = {}, .options = {.tolerance = 1e-4}, .tests = {}};
    norsand::Parameters& law = problem.law;
    law.G_ref = 1e6 * entry.at("G_ref_MPa").get<double>();
    law.m = entry.at("m");
    law.p_ref = 1e3 * entry.at("p_ref_kPa").get<double>();
    law.nu = entry.at("nu");
    law.S = entry.at("S");
    for (std::size_t k = 0; k < sought::names.size(); ++k) {
        const json& given = entry.at("given");
        if (given.contains(sought::names[k])) problem.given[k] = given.at(sought::names[k]);
    }
    for (const auto& [name, test] : entry.at("tests").items())
        problem.tests.push_back(test_of(name, test, is_engineering(entry)));
    return problem;
}

json law_entry_of(const json& entry, const NorSandFit& fit) {
    json law{{"type", "norsand"}};
    for (std::size_t k = 0; k < sought::names.size(); ++k)
        law[sought::names[k]] = fit.estimates[k].value;
    for (const char* key : {"G_ref_MPa", "m", "p_ref_kPa", "nu", "S"}) law[key] = entry.at(key);
    return law;
}

}  // namespace breach::element_bench
