// Runs NorSand's calibration for run.cpp and writes each test twice, measured and computed, so that
// figures need no other file. The number of rounds is not known before: progress approaches 1 with
// every round.
#include "element_bench/norsand_run.hpp"

#include <spdlog/spdlog.h>

#include "core/phases/files.hpp"
#include "element_bench/norsand_document.hpp"

namespace breach::element_bench {

using nlohmann::json;

exchange::Archive empty_archive() {
    exchange::Archive archive;
    archive.kind = "element_tests";
    archive.version = 1;
    return archive;
}

namespace {

const char* const entry_key = "norsand_calibration";

json entry_of(const scene::Scene& scene) { return json::parse(scene.completed).at(entry_key); }

/// Names "TEST.measured.q"; e and u are derived from the columns, as figures show them.
void store(exchange::Archive& archive, const TriaxialTest& test, const std::string& kind,
           const TriaxialCurve& curve) {
    const auto add = [&](const char* column, const char* unit, std::vector<double> values) {
        const std::string name = test.name + "." + kind + "." + column;
        archive.reals[name] = std::move(values);
        archive.units[name] = unit;
    };
    std::vector<double> e, u;
    for (std::size_t i = 0; i < curve.q.size(); ++i) {
        e.push_back(void_ratio(test, curve.epsilon_v[i]));
        u.push_back(is_drained(test.boundary) ? 0.0
                                              : excess_pressure(test, curve.q[i], curve.p[i]));
    }
    add("strain", "1", curve.epsilon_1);
    add("q", "Pa", curve.q);
    add("p", "Pa", curve.p);
    add("epsilon_v", "1", curve.epsilon_v);
    add("e", "1", std::move(e));
    add("u", "Pa", std::move(u));
}

json as_json(const PeakReading& peak) {
    return {{"epsilon_1", peak.epsilon_1},
            {"eta", peak.eta},
            {"D_min", peak.D},
            {"p_kPa", peak.p / 1e3},
            {"e", peak.e}};
}

/// Null where a test has no peak, or the law no curve.
json as_json(const TriaxialTest& test, const TestFit& fit) {
    const EndReading& end = fit.measured.end;
    json out{{"boundary", words::name_of(test.boundary)},
             {"p_0_kPa", test.p_0 / 1e3},
             {"e_0", test.e_0},
             {"psi_0", fit.psi_0},
             {"end",
              {{"p_kPa", end.p / 1e3},
               {"q_kPa", end.q / 1e3},
               {"e", end.e},
               {"eta", end.eta},
               {"D", end.D}}},
             {"critical_state", end.critical},
             {"peak", nullptr},
             {"computed", fit.curve.has_value()},
             {"misfit", nullptr}};
    if (const auto& peak = fit.measured.peak) {
        out["peak"] = as_json(*peak);
        out["peak"]["psi"] = *fit.psi_peak;
    }
    if (fit.curve) {
        const char* other = is_drained(test.boundary) ? "epsilon_v" : "p_over_p_0";
        out["misfit"] = {{"q_over_peak", fit.q_misfit}, {other, fit.volume_misfit}};
    }
    return out;
}

json as_json(const Estimate& estimate, const std::vector<TriaxialTest>& tests) {
    json names = json::array();
    for (const std::size_t i : estimate.tests) names.push_back(tests[i].name);
    return {{"value", estimate.value},
            {"standard_error", estimate.error ? json(*estimate.error) : json(nullptr)},
            {"origin", words::name_of(estimate.origin)},
            {"tests", names}};
}

void log(const NorSandProblem& problem, const NorSandFit& fit) {
    spdlog::info("{:<10} {:>10} {:>10} {:>9} {:>6}", "parameter", "value", "error", "", "tests");
    for (std::size_t k = 0; k < sought::names.size(); ++k) {
        const Estimate& each = fit.estimates[k];
        spdlog::info("{:<10} {:>10.4g} {:>10} {:>9} {:>6}", sought::names[k], each.value,
                     each.error ? fmt::format("{:.2g}", *each.error) : "-",
                     words::name_of(each.origin), each.tests.size());
    }
    for (std::size_t i = 0; i < fit.tests.size(); ++i) {
        const TestFit& each = fit.tests[i];
        spdlog::info(
            "{:<26} psi_0 {:>7.3f}, {}, q within {:.1f} % of its peak (rms)", problem.tests[i].name,
            each.psi_0,
            each.measured.end.critical ? "ends at critical state" : "does not reach critical state",
            100.0 * each.q_misfit);
    }
}

}  // namespace

bool seeks_norsand(const scene::Scene& scene) {
    return json::parse(scene.completed).contains(entry_key);
}

/// What is given is listed too: one sees from the plan what the tests must determine.
process::Plan norsand_calibration_plan(const scene::Scene& scene) {
    const json entry = entry_of(scene);
    process::Plan plan;
    for (const char* name : sought::names) {
        const bool given = entry.at("given").contains(name);
        plan.push_back({name, given ? process::Use::left_out : process::Use::on,
                        given ? "given" : "sought", "/norsand_calibration/given"});
    }
    return plan;
}

process::Outcome run_norsand_calibration(process::Session& session) {
    const json entry = entry_of(session.scene());
    const NorSandProblem problem = norsand_problem_of(entry);
    NorSandFit fit = calibrate(problem, [&](int round, double moved) {
        session.progress(round / (round + 5.0),
                         "round " + std::to_string(round) + ", moved by " + std::to_string(moved));
    });
    for (fault::Flag& each : fit.flags) session.flag(std::move(each));
    exchange::Archive archive = empty_archive();
    json tests = json::object(), parameters = json::object();
    for (std::size_t i = 0; i < problem.tests.size(); ++i) {
        const TriaxialTest& test = problem.tests[i];
        store(archive, test, "measured", test.measured);
        if (fit.tests[i].curve) store(archive, test, "computed", *fit.tests[i].curve);
        tests[test.name] = as_json(test, fit.tests[i]);
    }
    for (std::size_t k = 0; k < sought::names.size(); ++k)
        parameters[sought::names[k]] = as_json(fit.estimates[k], problem.tests);
    exchange::write_archive(session.output(phases::files::element_tests), archive,
                            session.provenance());
    session.announce(session.output(phases::files::element_tests), {{"kind", "element_tests"}});
    session.result()["norsand_calibration"] = {{"law", law_entry_of(entry, fit)},
                                               {"parameters", parameters},
                                               {"tests", tests},
                                               {"rounds", fit.rounds}};
    log(problem, fit);
    session.progress(1.0, "done");
    return process::Outcome::done;
}

}  // namespace breach::element_bench
