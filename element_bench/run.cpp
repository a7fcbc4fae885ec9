// Runs the tests or the calibration of a document as a phase and writes result.json and
// element_tests.h5. Stresses are pascals in curves and kilopascals in result.json, as people read
// the latter. Called by main.cpp through process::run_phase; report and breachline.plot read the
// curves by the names that label() builds.
#include "element_bench/run.hpp"

#include <spdlog/spdlog.h>

#include <cmath>

#include "core/exchange/archive.hpp"
#include "core/phases/files.hpp"
#include "core/scene/sand.hpp"
#include "element_bench/document.hpp"
#include "element_bench/norsand_run.hpp"

namespace breach::element_bench {

namespace norsand = materials::norsand;
using nlohmann::json;
using process::Outcome;
using process::PlanLine;
using process::Session;
using process::Use;

namespace {

/// The cost of a law is part of the result: it shows whether steps were forced or stresses floored.
json numbers_of(const materials::norsand::Counts& counts, long calls) {
    return {{"calls", calls},
            {"evaluations", counts.evaluations},
            {"sub_steps", counts.sub_steps},
            {"rejected", counts.rejected},
            {"guarded", counts.guarded},
            {"floored", counts.floored},
            {"cut_off", counts.cut_off}};
}

json numbers_of(const materials::pm4sand::Counts& counts, long calls) {
    return {{"calls", calls},
            {"evaluations", counts.evaluations},
            {"sub_steps", counts.sub_steps},
            {"rejected", counts.rejected},
            {"forced", counts.forced},
            {"projected", counts.projected},
            {"softened", counts.softened},
            {"stalled", counts.stalled}};
}

/// Laws without memory have no such counts: zeros of PM4Sand's names stand there.
json cost_of(const Record& record) {
    if (norsand_in(record.last)) return numbers_of(record.counts.norsand, record.calls);
    return numbers_of(record.counts.sand, record.calls);
}

/// What the tests of a document have added so far.
/// Kept in memory until all tests have ended: the archive is one file, written once.
struct Results {
    json numbers = json::object();
    exchange::Archive curves = empty_archive();
};

/// "cu1_sv100kPa_csr0.2": test, confinement and, for cyclic strength, the stress ratio. Each
/// curve's columns follow after a point.
std::string label(const std::string& test, double sigma_v, const char* what = "",
                  double value = 0.0) {
    // %g: 100 kPa is "100" and 62.5 is "62.5", as the document has them.
    char text[64];
    if (*what) {
        std::snprintf(text, sizeof text, "_sv%gkPa_%s%g", sigma_v / 1e3, what, value);
    } else {
        std::snprintf(text, sizeof text, "_sv%gkPa", sigma_v / 1e3);
    }
    return test + text;
}

/// State of a NorSand point at each reading.
void store_memory(Results& results, const std::string& curve, const Record& record) {
    const NorSandPoint* point = norsand_in(record.last);
    if (!point) return;
    const auto add = [&](const char* column, const char* unit, auto of) {
        std::vector<double> values;
        for (const Reading& each : record.readings) {
            values.push_back(of(*each.norsand, norsand::read(point->law, *each.norsand)));
        }
        const std::string name = curve + "." + column;
        results.curves.reals[name] = std::move(values);
        results.curves.units[name] = unit;
    };
    using norsand::State;
    using Seen = norsand::Reading;
    add("p", "Pa", [](const State&, const Seen& seen) { return seen.p; });
    add("q", "Pa", [](const State&, const Seen& seen) { return seen.q; });
    add("theta", "rad", [](const State&, const Seen& seen) { return seen.theta; });
    add("e", "1", [](const State& state, const Seen&) { return state.e; });
    add("psi", "1", [](const State&, const Seen& seen) { return seen.psi; });
    add("psi_i", "1", [](const State&, const Seen& seen) { return seen.psi_i; });
    add("p_i", "Pa", [](const State& state, const Seen&) { return state.p_i; });
    add("p_mx", "Pa", [](const State&, const Seen& seen) { return seen.p_mx; });
    add("M_i", "1", [](const State&, const Seen& seen) { return seen.M_i; });
    add("eta_L", "1", [](const State&, const Seen& seen) { return seen.eta_L; });
    add("D", "1", [](const State&, const Seen& seen) { return seen.D; });
    add("epsilon_q", "1", [](const State& state, const Seen&) { return state.epsilon_q; });
}

/// Response at the critical state of constant volume, in closed form [Pa].
/// To compare an undrained test with: its volume, and so its critical pressure, are constant.
double critical_response(const NorSandPoint& point, Boundary boundary) {
    const norsand::Ready& law = point.law;
    const double p_c = norsand::critical_pressure(law, point.state.e);
    if (boundary == Boundary::undrained_compression) return 0.5 * law.parameters.M_tc * p_c;
    if (boundary == Boundary::undrained_extension) return 0.5 * law.M_te * p_c;
    const double theta = norsand::plane_critical_angle(law);
    return norsand::critical_ratio(law, theta) * std::cos(theta) / std::sqrt(3.0) * p_c;
}

/// Numbers of a monotonic test for NorSand only.
void add_memory(const Record& record, Boundary boundary, json& row) {
    const NorSandPoint* point = norsand_in(record.last);
    if (!point) return;
    const norsand::Reading last = norsand::read(point->law, point->state);
    row["p_kPa"] = last.p / 1e3;
    row["q_kPa"] = last.q / 1e3;
    row["e"] = point->state.e;
    row["psi"] = last.psi;
    row["S"] = point->law.parameters.S;
    if (!is_drained(boundary)) {
        row["critical_response_kPa"] = critical_response(*point, boundary) / 1e3;
    }
}

/// One column per field of Reading; members as pointers, so that name, unit and value stand in one
/// row.
void store(Results& results, const std::string& curve, const Record& record) {
    const struct {
        const char* name;
        double Reading::*member;
        const char* unit;
    } columns[] = {{"strain", &Reading::strain, "1"},       {"response", &Reading::response, "Pa"},
                   {"sigma_xx", &Reading::sigma_xx, "Pa"},  {"sigma_yy", &Reading::sigma_yy, "Pa"},
                   {"sigma_zz", &Reading::sigma_zz, "Pa"},  {"tau", &Reading::tau, "Pa"},
                   {"epsilon_v", &Reading::epsilon_v, "1"}, {"r_u", &Reading::r_u, "1"},
                   {"cycles", &Reading::cycles, "1"}};
    for (const auto& column : columns) {
        std::vector<double> values;
        for (const Reading& each : record.readings) values.push_back(each.*column.member);
        const std::string name = curve + "." + column.name;
        results.curves.reals[name] = std::move(values);
        results.curves.units[name] = column.unit;
    }
    store_memory(results, curve, record);
}

/// Null if the limit was not reached.
/// The programme counts -1 for "never".
json reached(double N) { return N >= 0.0 ? json(N) : json(nullptr); }

void run_test(const Specimen& specimen, const TestPlan& plan, double sigma_v,
              const MonotonicTest& test, Results& results) {
    const Record record = monotonic(specimen, plan.consolidation.boundary, test.strain, test.pace);
    const Reading& last = record.readings.back();
    json row{{"sigma_v_kPa", sigma_v / 1e3},
             {"strain", last.strain},
             {"response_kPa", last.response / 1e3},
             {"peak_kPa", record.peak / 1e3},
             {"peak_strain", record.peak_strain},
             {"r_u", last.r_u},
             {"epsilon_v", last.epsilon_v},
             {"complete", record.outcome == Ending::done},
             {"cost", cost_of(record)}};
    add_memory(record, plan.consolidation.boundary, row);
    results.numbers[plan.name].push_back(std::move(row));
    store(results, label(plan.name, sigma_v), record);
}

void run_test(const Specimen& specimen, const TestPlan& plan, double sigma_v,
              const CyclicStrengthTest& test, Results& results) {
    for (const double CSR : test.CSR) {
        const CyclicResult result =
            cyclic_stress(specimen, plan.consolidation.boundary, {.amplitude = CSR * sigma_v},
                          test.limit, test.pace);
        results.numbers[plan.name].push_back({{"sigma_v_kPa", sigma_v / 1e3},
                                              {"CSR", CSR},
                                              {"N_strain_limit", reached(result.N_strain)},
                                              {"N_1_percent", reached(result.N_1_percent)},
                                              {"N_r_u_0.95", reached(result.N_r_u)},
                                              {"largest_r_u", result.largest_r_u},
                                              {"complete", result.record.outcome == Ending::done},
                                              {"cost", cost_of(result.record)}});
        store(results, label(plan.name, sigma_v, "csr", CSR), result.record);
    }
}

void run_test(const Specimen& specimen, const TestPlan& plan, double sigma_v,
              const CyclicStrainTest& test, Results& results) {
    const Record record = cyclic_strain(specimen, plan.consolidation.boundary, test.amplitude,
                                        test.cycles, test.pace);
    const Reading& last = record.readings.back();
    results.numbers[plan.name].push_back({{"sigma_v_kPa", sigma_v / 1e3},
                                          {"cycles", last.cycles},
                                          {"r_u", last.r_u},
                                          {"epsilon_v", last.epsilon_v},
                                          {"complete", record.outcome == Ending::done},
                                          {"cost", cost_of(record)}});
    store(results, label(plan.name, sigma_v), record);
}

/// An amplitude at which the specimen failed has a row with nulls, and no point on the curve.
void run_test(const Specimen& specimen, const TestPlan& plan, double sigma_v,
              const ModulusReductionTest& test, Results& results) {
    const std::string curve = label(plan.name, sigma_v);
    std::vector<double> amplitude, G, damping;  // of completed loops
    for (const double each : test.amplitudes) {
        const Loop loop =
            hysteresis(specimen, plan.consolidation.boundary, each, test.cycles, test.steps);
        json row{{"sigma_v_kPa", sigma_v / 1e3},
                 {"amplitude", each},
                 {"G_secant_kPa", nullptr},
                 {"damping", nullptr},
                 {"complete", loop.G_secant.has_value()}};
        if (loop.G_secant) row["G_secant_kPa"] = *loop.G_secant / 1e3;
        if (loop.damping) row["damping"] = *loop.damping;
        results.numbers[plan.name].push_back(std::move(row));
        if (!loop.G_secant || !loop.damping) continue;
        amplitude.push_back(each);
        G.push_back(*loop.G_secant);
        damping.push_back(*loop.damping);
    }
    results.curves.reals[curve + ".amplitude"] = amplitude;
    results.curves.reals[curve + ".G_secant"] = G;
    results.curves.units[curve + ".G_secant"] = "Pa";
    results.curves.reals[curve + ".damping"] = damping;
}

/// A stop between two confinements loses the tests so far.
Outcome run_tests(Session& session) {
    const Bench bench = bench_of(session.scene());
    for (fault::Flag& each : warnings_of(bench)) session.flag(std::move(each));
    Results results;
    double done = 0.0;
    for (const TestPlan& plan : bench.tests) {
        session.progress(done / static_cast<double>(bench.tests.size()), plan.name);
        results.numbers[plan.name] = json::array();
        for (const double sigma_v : plan.consolidation.sigma_v) {
            if (session.stop_requested()) return Outcome::stopped;
            const Specimen specimen = consolidated(bench.law, plan.consolidation, sigma_v);
            std::visit([&](const auto& test) { run_test(specimen, plan, sigma_v, test, results); },
                       plan.kind);
        }
        done += 1.0;
    }
    exchange::write_archive(session.output(phases::files::element_tests), results.curves,
                            session.provenance());
    session.announce(session.output(phases::files::element_tests), {{"kind", "element_tests"}});
    session.result()["tests"] = results.numbers;
    session.progress(1.0, "done");
    return Outcome::done;
}

process::Plan tests_plan(const scene::Scene& scene) {
    const Bench bench = bench_of(scene);
    process::Plan plan;
    for (const TestPlan& each : bench.tests) {
        plan.push_back({each.name, Use::on,
                        std::to_string(each.consolidation.sigma_v.size()) + " confinements",
                        "/tests/" + each.name});
    }
    if (bench.tests.empty()) {
        plan.push_back({"tests", Use::left_out, "the document has none", "/tests"});
    }
    return plan;
}

json as_json(const Fit& fit, const CalibrationProblem& problem) {
    json parameters = json::object();
    for (std::size_t i = 0; i < fit.values.size(); ++i) {
        parameters[problem.free[i].name] = fit.values[i];
    }
    json terms = json::array();
    for (const Term& term : fit.terms) {
        terms.push_back({{"name", term.name},
                         {"wanted", term.wanted},
                         {"computed", term.computed},
                         {"deviation", term.deviation},
                         {"share", term.share}});
    }
    return {{"parameters", parameters}, {"misfit", fit.misfit}, {"terms", terms}};
}

/// The path has the misfit of every improvement, without its terms.
Outcome run_calibration(Session& session) {
    if (seeks_norsand(session.scene())) return run_norsand_calibration(session);
    const Bench bench = bench_of(session.scene());
    if (!bench.calibration) {
        throw fault::BadInput(session.scene().name, {{"/calibration", "is missing", "add it"}});
    }
    const Calibration calibration(*bench.calibration);
    const CalibrationProblem& problem = calibration.problem();
    const CalibrationResult result = calibrate(calibration, [&](int evaluation, const Fit& fit) {
        session.progress(static_cast<double>(evaluation) / problem.most_evaluations,
                         "misfit " + std::to_string(fit.misfit));
    });
    json path = json::array();
    for (const Fit& fit : result.path) {
        json line = as_json(fit, problem);
        line.erase("terms");
        path.push_back(line);
    }
    session.result()["calibration"] = {{"first", as_json(result.first, problem)},
                                       {"best", as_json(result.best, problem)},
                                       {"evaluations", result.evaluations},
                                       {"path", path},
                                       {"law", scene::sand_as_json(result.parameters)}};
    spdlog::info("{:<26} {:>10} {:>10} {:>11} {:>10}", "target", "wanted", "computed", "deviation",
                 "misfit");
    for (const Term& term : result.best.terms) {
        spdlog::info("{:<26} {:>10.4g} {:>10.4g} {:>10.2f}% {:>10.4g}", term.name, term.wanted,
                     term.computed, 100.0 * term.deviation, term.share);
    }
    spdlog::info("misfit {:.4g} after {} evaluations, {:.4g} at the start", result.best.misfit,
                 result.evaluations, result.first.misfit);
    return Outcome::done;
}

process::Plan calibration_plan(const scene::Scene& scene) {
    if (seeks_norsand(scene)) return norsand_calibration_plan(scene);
    const Bench bench = bench_of(scene);
    if (!bench.calibration) {
        return {{"calibration", Use::left_out, "the document has none", "/calibration"}};
    }
    process::Plan plan;
    for (const FreeParameter& each : bench.calibration->free) {
        plan.push_back({each.name, Use::on, "free", "/calibration/free/" + each.name});
    }
    return plan;
}

/// A calibration's document has no law to test; the message names the other command.
scene::Scene read_tests(const std::filesystem::path& file,
                        const std::vector<std::string>& overrides) {
    scene::Scene scene = read_document(file, overrides);
    if (seeks_norsand(scene)) {
        throw fault::BadInput(file.string(), {{"/norsand_calibration", "is no test of a law",
                                               "run fem_solver calibrate with this document"}});
    }
    return scene;
}

}  // namespace

process::Phase element_test_phase() {
    return {.name = "fem_solver element-test",
            .purpose = "Laboratory tests on one point of a soil",
            .inputs = {0, 0, "takes no input beside the document"},
            .plan = tests_plan,
            .run = run_tests,
            .read = read_tests};
}

process::Phase calibrate_phase() {
    return {.name = "fem_solver calibrate",
            .purpose =
                "Parameters of PM4Sand from strengths and cyclic strength curves, of NorSand from "
                "triaxial tests",
            .inputs = {0, 0, "takes no input beside the document"},
            .plan = calibration_plan,
            .run = run_calibration,
            .read = read_document};
}

}  // namespace breach::element_bench
