#include "fem_solver/element_bench/document.hpp"

#include <algorithm>
#include <fstream>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "core/scene/sand.hpp"
#include "core/scene/schema.hpp"

namespace breach::element_bench {

namespace pm4sand = materials::pm4sand;
using fault::Fault;
using nlohmann::json;

namespace {

constexpr double degree = std::numbers::pi / 180.0;

SandLaw sand_of(const json& law) { return {scene::sand_parameters(law), scene::sand_options(law)}; }

/// Completes a PM4Sand entry and says what contradicts.
void complete_sand(json& law, const std::string& pointer, std::vector<Fault>& faults) {
    scene::complete_sand(law);
    if (law.value("type", "") != "pm4sand" || law.at("e_max") > law.at("e_min")) return;
    faults.push_back({pointer + "/e_max", "is not above e_min", "give e_max > e_min"});
}

TestLaw law_of(const json& law) {
    const std::string type = law.at("type");
    if (type == "pm4sand") return sand_of(law);
    const mechanics::Elasticity elasticity{1e6 * law.at("E_MPa").get<double>(), law.at("nu")};
    if (type == "linear_elastic") return PlainLaw{materials::LinearElastic{elasticity}};
    const double c = 1e3 * law.at("c_kPa").get<double>();
    const double phi = degree * law.at("phi_deg").get<double>();
    const double psi = degree * law.at("psi_deg").get<double>();
    const double cut_off = 1e3 * law.at("tension_cutoff_kPa").get<double>();
    if (type == "mohr_coulomb")
        return PlainLaw{materials::MohrCoulomb{elasticity, c, phi, psi, cut_off, std::nullopt}};
    if (type == "drucker_prager")
        return PlainLaw{materials::DruckerPrager{elasticity, c, phi, psi, cut_off}};
    throw std::logic_error("the schema knows a law \"" + type + "\" that nothing reads");
}

std::vector<double> scaled(const json& numbers, double unit) {
    std::vector<double> out;
    for (const json& each : numbers) out.push_back(unit * each.get<double>());
    return out;
}

Pace pace_of(const json& test) { return {.step = test.at("step"), .every = test.at("every")}; }

TestPlan plan_of(const std::string& name, const json& test) {
    TestPlan plan{name,
                  {.boundary = words::word_at<Boundary>(test, "boundary"),
                   .sigma_v = scaled(test.at("sigma_v_kPa"), 1e3),
                   .K0 = test.at("K0"),
                   .static_shear = test.value("static_shear", 0.0)},
                  {}};
    const std::string type = test.at("type");
    if (type == "monotonic") {
        plan.kind = MonotonicTest{test.at("strain"), pace_of(test)};
    } else if (type == "cyclic_strength") {
        plan.kind = CyclicStrengthTest{scaled(test.at("CSR"), 1.0),
                                       {.strain = test.at("strain_limit"),
                                        .r_u = test.at("r_u_limit"),
                                        .cycles = test.at("most_cycles")},
                                       pace_of(test)};
    } else if (type == "cyclic_strain") {
        plan.kind = CyclicStrainTest{test.at("amplitude"), test.at("cycles"), pace_of(test)};
    } else {
        plan.kind = ModulusReductionTest{scaled(test.at("amplitudes"), 1.0), test.at("cycles"),
                                         test.at("steps")};
    }
    return plan;
}

CalibrationProblem problem_of(const json& entry, const SandLaw& start) {
    CalibrationProblem problem{.start = start.parameters,
                               .reference = sand_of(entry.at("reference")).parameters,
                               .free = {},
                               .strength = {},
                               .cyclic = {},
                               .strength_spread = entry.at("strength_spread"),
                               .cyclic_spread = entry.at("cyclic_spread"),
                               .options = start.options,
                               .most_evaluations = entry.at("most_evaluations")};
    for (const auto& [name, bound] : entry.at("free").items()) {
        problem.free.push_back({name, bound.at("least"), bound.at("most")});
    }
    for (const json& each : entry.at("strength")) {
        problem.strength.push_back({1e3 * each.at("sigma_v_kPa").get<double>(), each.at("K0"),
                                    each.at("strain"), 1e3 * each.at("s_u_kPa").get<double>()});
    }
    const json& cyclic = entry.at("cyclic");
    for (const double sigma_v : scaled(cyclic.at("sigma_v_kPa"), 1e3)) {
        for (const double CSR : scaled(cyclic.at("CSR"), 1.0)) {
            problem.cyclic.push_back({sigma_v, cyclic.at("K0"), CSR, cyclic.at("strain_limit")});
        }
    }
    return problem;
}

void check_calibration(const json& document, std::vector<Fault>& faults) {
    if (!document.contains("calibration")) return;
    if (document.at("law").at("type") != "pm4sand") {
        faults.push_back({"/calibration", "needs PM4Sand", "set /law/type to \"pm4sand\""});
    }
    const auto names = parameter_names();
    for (const auto& [name, bound] : document.at("calibration").at("free").items()) {
        const std::string pointer = "/calibration/free/" + name;
        if (std::find(names.begin(), names.end(), name) == names.end()) {
            std::string known;
            for (const std::string& each : names) known += (known.empty() ? "" : ", ") + each;
            faults.push_back({pointer, "is not a parameter that can be free", "use " + known});
        }
        if (bound.at("least") >= bound.at("most")) {
            faults.push_back({pointer, "has least >= most", "give least < most"});
        }
    }
}

}  // namespace

scene::Scene read_document(const std::filesystem::path& file,
                           const std::vector<std::string>& overrides) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    if (!stream || std::filesystem::is_directory(file)) {
        throw fault::IoError(file.string() + ": cannot be read; check the path");
    }
    json document = scene::parse_json(text.str(), file.string());
    std::vector<Fault> faults;
    for (const std::string& each : overrides) {
        for (Fault& found : scene::apply_override(document, each)) faults.push_back(found);
    }
    for (Fault& found : scene::complete_and_check(document, scene::element_test_schema())) {
        faults.push_back(found);
    }
    if (!faults.empty()) throw fault::BadInput(file.string(), faults);
    complete_sand(document.at("law"), "/law", faults);
    if (document.contains("calibration")) {
        complete_sand(document.at("calibration").at("reference"), "/calibration/reference", faults);
    }
    check_calibration(document, faults);
    if (!faults.empty()) throw fault::BadInput(file.string(), faults);
    scene::Scene scene{};
    scene.name = document.at("name");
    scene.title = document.at("title");
    scene.completed = document.dump();
    return scene;
}

Bench bench_of(const scene::Scene& scene) {
    const json document = json::parse(scene.completed);
    Bench bench{law_of(document.at("law")), {}, std::nullopt};
    if (document.contains("tests")) {
        for (const auto& [name, test] : document.at("tests").items()) {
            bench.tests.push_back(plan_of(name, test));
        }
    }
    if (document.contains("calibration")) {
        bench.calibration = problem_of(document.at("calibration"), std::get<SandLaw>(bench.law));
    }
    return bench;
}

Specimen consolidated(const TestLaw& law, const Voigt& sigma) {
    if (const auto* plain = std::get_if<PlainLaw>(&law)) {
        return {PlainPoint{*plain, {sigma, 0.0}}};
    }
    const auto& sand = std::get<SandLaw>(law);
    const pm4sand::Ready ready = pm4sand::ready(sand.parameters);
    return {SandPoint{ready, sand.options, pm4sand::initialise(ready, sigma)}};
}

}  // namespace breach::element_bench
