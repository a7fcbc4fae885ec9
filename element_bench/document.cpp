// Reads an element-test document: the schema completes it, this file checks what a schema cannot
// express, and converts kilopascals and degrees. Faults are collected, so that one pass shows all.
// run.cpp calls read_document() before the plan, and bench_of() in plan and run: a document that
// was read is complete, so that .at() needs no defaults here.
#include "element_bench/document.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "core/scene/sand.hpp"
#include "core/scene/schema.hpp"
#include "core/words/list.hpp"
#include "element_bench/norsand_document.hpp"

namespace breach::element_bench {

namespace norsand = materials::norsand;
namespace pm4sand = materials::pm4sand;
using fault::Fault;
using nlohmann::json;

namespace {

constexpr double degree = std::numbers::pi / 180.0;

SandLaw sand_of(const json& law) { return {scene::sand_parameters(law), scene::sand_options(law)}; }

/// Completes a PM4Sand entry and reports contradictions.
/// The schema gives each of e_max and e_min a range, but not their order.
void complete_sand(json& law, const std::string& pointer, std::vector<Fault>& faults) {
    scene::complete_sand(law);
    if (law.value("type", "") != "pm4sand" || law.at("e_max") > law.at("e_min")) return;
    faults.push_back({pointer + "/e_max", "is not above e_min", "give e_max > e_min"});
}

/// Associated flow (psi = phi) dissipates no friction work; more would create energy.
void check_dilatancy(const json& law, std::vector<Fault>& faults) {
    if (!law.contains("psi_deg") || law.at("psi_deg") <= law.at("phi_deg")) return;
    faults.push_back({"/law/psi_deg", "is above phi_deg",
                      "such a soil would create energy; give psi_deg <= phi_deg"});
}

/// E in MPa, strengths in kPa, angles in degrees: converted here only.
TestLaw law_of(const json& law) {
    const std::string type = law.at("type");
    if (type == "pm4sand") return sand_of(law);
    if (type == "norsand")
        return NorSandLaw{scene::norsand_parameters(law), scene::norsand_options(law)};
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

/// The test is complete: the schema gave defaults, check_norsand_tests() gave S.
TestPlan plan_of(const std::string& name, const json& test, const json& law) {
    TestPlan plan{name,
                  {.boundary = words::word_at<Boundary>(test, "boundary"),
                   .sigma_v = scaled(test.at("sigma_v_kPa"), 1e3),
                   .K0 = test.at("K0"),
                   .static_shear = test.value("static_shear", 0.0),
                   .norsand = {}},
                  {}};
    if (law.at("type") == "norsand")
        plan.consolidation.norsand = {scene::norsand_start(test, law), test.at("S")};
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

/// Stress after consolidation; the static shear is applied before the test. zz elastic.
Voigt initial_stress(const Consolidation& at, double sigma_v) {
    const double sigma_h = at.K0 * sigma_v;
    return {-sigma_h, -sigma_v, -sigma_h, at.static_shear * sigma_v};
}

/// S belongs to the test, not to the law: drained and undrained tests of one soil differ in it.
norsand::Ready ready_for(const NorSandLaw& law, const Consolidation& consolidation) {
    norsand::Parameters parameters = law.parameters;
    parameters.S = consolidation.norsand->S;
    return norsand::ready(parameters);
}

/// Of sigma_v and twice K0 sigma_v.
double mean_stress(const Consolidation& at, double sigma_v) {
    return (1.0 + 2.0 * at.K0) / 3.0 * sigma_v;
}

/// The void ratio as given, or from psi_0 at this confinement: tests at several confinements then
/// begin at several void ratios.
norsand::Beginning begin(const norsand::Ready& law, const Consolidation& at, double sigma_v) {
    const scene::NorSandStart& start = at.norsand->start;
    const double p = mean_stress(at, sigma_v);
    const double e_0 = start.e_0 ? *start.e_0 : *start.psi_0 + norsand::critical_void_ratio(law, p);
    return norsand::initialise(law, initial_stress(at, sigma_v), e_0, start.R);
}

/// Enough where repetitions follow each other.
void add_name(std::string& names, const std::string& name) {
    if (names.ends_with(name)) return;
    names += (names.empty() ? "" : ", ") + name;
}

std::string three_digits(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

/// Refuses a confinement from which the law cannot start.
void check_beginning(const norsand::Ready& law, const TestPlan& plan, double sigma_v,
                     const std::string& stress_pointer, std::vector<Fault>& faults) {
    const Consolidation& at = plan.consolidation;
    const norsand::Parameters& par = law.parameters;
    const std::string pointer = "/tests/" + plan.name;
    const double p = mean_stress(at, sigma_v);
    // Each check needs the one before: a state below p_min or on a steep line has no beginning to
    // look at.
    if (p < par.p_min) {
        faults.push_back({stress_pointer,
                          "is a mean stress of " + three_digits(p / 1e3) + " kPa, below p_min of " +
                              three_digits(par.p_min / 1e3) + " kPa",
                          "raise it or lower /law/p_min_kPa"});
        return;
    }
    const double slope = norsand::critical_slope(law, p);
    if (slope * par.chi_tc >= norsand::most_chi_lambda * par.M_tc) {
        faults.push_back(
            {stress_pointer,
             "lies where the critical state line is so steep that lambda chi_tc / M_tc is " +
                 three_digits(slope * par.chi_tc / par.M_tc),
             "keep it below " + three_digits(norsand::most_chi_lambda)});
        return;
    }
    const norsand::Beginning begun = begin(law, at, sigma_v);
    if (!(begun.state.e > 0.0)) {
        faults.push_back({pointer + "/psi_0",
                          "makes the void ratio " + three_digits(begun.state.e) + " at " +
                              three_digits(p / 1e3) + " kPa",
                          "raise psi_0 (or e_0)"});
        return;
    }
    // Written out as a state parameter, since that is what the user can change.
    if (begun.eta_limit <= 0.0) {
        const double most = par.M_tc / (begun.state.chi_i * (1.0 + par.N)) + slope;
        faults.push_back(
            {pointer + "/psi_0",
             "is " + three_digits(begun.state.e - norsand::critical_void_ratio(law, p)) + " at " +
                 three_digits(p / 1e3) + " kPa: so loose that the law has no stable stress ratio",
             "give a state parameter below " + three_digits(most) +
                 ", or check chi_tc and the critical state line"});
        return;
    }
    if (!begun.shrunk) return;
    const double limit = begun.eta_limit;
    // q / p of a stress with the ratio K0, solved for K0: compression below 1, extension above.
    const double K0 =
        at.K0 < 1.0 ? (3.0 - limit) / (3.0 + 2.0 * limit) : (3.0 + limit) / (3.0 - 2.0 * limit);
    const bool sheared = at.static_shear > 0.0;
    faults.push_back(
        {pointer + (sheared ? "/static_shear" : "/K0"),
         "makes q/p " + three_digits(begun.eta) + ", outside the yield surface: at most " +
             three_digits(limit) + " stands there",
         sheared ? "lower the static shear or the difference of stresses"
                 : (at.K0 < 1.0 ? "give K0 above " : "give K0 below ") + three_digits(K0)});
}

/// Checks NorSand tests against the law and each other.
void check_norsand_tests(json& document, std::vector<Fault>& faults) {
    json& law = document.at("law");
    for (Fault& each : scene::check_norsand(law, "/law")) faults.push_back(each);
    if (law.contains("psi_0") && law.contains("e_0")) {
        faults.push_back({"/law/e_0", "given together with psi_0", "give one of the two"});
    }
    if (!document.contains("tests") || !faults.empty()) return;
    for (auto& [name, test] : document.at("tests").items()) {
        const std::string pointer = "/tests/" + name;
        if (test.at("type") != "monotonic") {
            faults.push_back({pointer + "/type", "is cyclic, and NorSand is for monotonic loading",
                              "use \"monotonic\", or PM4Sand"});
            continue;
        }
        if (test.contains("psi_0") && test.contains("e_0")) {
            faults.push_back(
                {pointer + "/e_0", "given together with psi_0", "give one of the two"});
        }
        const bool begins = test.contains("psi_0") || test.contains("e_0") ||
                            law.contains("psi_0") || law.contains("e_0");
        if (!begins) {
            faults.push_back({pointer + "/psi_0", "is missing: NorSand must know how loose it is",
                              "give psi_0 or e_0 here or in /law"});
        }
        // S stands for undrained softening; a drained test that took it over would be flagged.
        if (!test.contains("S")) {
            const bool drained = is_drained(words::word_at<Boundary>(test, "boundary"));
            test["S"] = drained ? json(0.0) : law.at("S");
        }
    }
    if (!faults.empty()) return;
    const NorSandLaw read{scene::norsand_parameters(law), scene::norsand_options(law)};
    for (const auto& [name, test] : document.at("tests").items()) {
        const TestPlan plan = plan_of(name, test, law);
        const norsand::Ready ready = ready_for(read, plan.consolidation);
        for (std::size_t i = 0; i < plan.consolidation.sigma_v.size(); ++i) {
            check_beginning(ready, plan, plan.consolidation.sigma_v[i],
                            "/tests/" + name + "/sigma_v_kPa/" + std::to_string(i), faults);
        }
    }
}

/// Refuses tests that the law does not support.
void check_tests(const json& document, std::vector<Fault>& faults) {
    if (!document.contains("tests")) return;
    const std::string law = document.at("law").at("type");
    for (const auto& [name, test] : document.at("tests").items()) {
        const std::string pointer = "/tests/" + name;
        for (const char* key : {"psi_0", "e_0", "R", "S"}) {
            if (law == "norsand" || !test.contains(key)) continue;
            faults.push_back({pointer + "/" + key, "is an entry of NorSand alone",
                              "leave it out, or set /law/type to \"norsand\""});
        }
        const auto boundary = words::word_at<Boundary>(test, "boundary");
        if (is_triaxial(boundary) && law == "pm4sand") {
            faults.push_back({pointer + "/boundary",
                              "is triaxial, and PM4Sand knows plane strain alone",
                              "use a shear or biaxial boundary, or another law"});
        }
        if (drives(boundary) != Drives::shear && test.value("static_shear", 0.0) != 0.0) {
            const std::string what = is_triaxial(boundary) ? "triaxial" : "biaxial";
            faults.push_back({pointer + "/static_shear", "has no place in a " + what + " test",
                              is_triaxial(boundary) ? "leave it out, or use a shear boundary"
                                                    : "leave it out, or use a shear boundary; K0 "
                                                      "is what a biaxial test begins with"});
        }
    }
}

/// Measured curves come first, then targets of the reference soil, which have no N.
CalibrationProblem problem_of(const json& entry, const SandLaw& start) {
    CalibrationProblem problem{.start = start.parameters,
                               .reference = {},
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
    for (const json& curve : entry.at("cyclic_strength")) {
        for (const json& point : curve.at("points")) {
            problem.cyclic.push_back({.sigma_v = 1e3 * curve.at("sigma_v_kPa").get<double>(),
                                      .K0 = curve.at("K0"),
                                      .CSR = point.at("CSR"),
                                      .strain = curve.at("strain_limit"),
                                      .N = point.at("N").get<double>(),
                                      .weight = point.at("weight")});
        }
    }
    if (!entry.contains("cyclic")) return problem;
    problem.reference = sand_of(entry.at("reference")).parameters;
    const json& cyclic = entry.at("cyclic");
    for (const double sigma_v : scaled(cyclic.at("sigma_v_kPa"), 1e3)) {
        for (const double CSR : scaled(cyclic.at("CSR"), 1.0)) {
            problem.cyclic.push_back(
                {sigma_v, cyclic.at("K0"), CSR, cyclic.at("strain_limit"), {}, 1.0});
        }
    }
    return problem;
}

/// A measured curve: CSR, N and optionally weight per line; the first line may have names, '#'
/// starts a comment.
/// Semicolons and tabs count as commas, and a line of names is skipped: files come from
/// spreadsheets.
json points_of_file(const std::filesystem::path& file, const std::string& pointer,
                    std::vector<Fault>& faults) {
    std::ifstream stream(file);
    json points = json::array();
    const auto fault = [&](int line, const std::string& what) {
        faults.push_back({pointer, file.string() + ", line " + std::to_string(line) + " " + what,
                          "write CSR,N or CSR,N,weight: 0.12,15"});
    };
    if (!stream) {
        faults.push_back({pointer, "names " + file.string() + ", which cannot be read",
                          "give a path from the document's folder, or an absolute one"});
        return points;
    }
    std::string text;
    for (int line = 1; std::getline(stream, text); ++line) {
        text = text.substr(0, text.find('#'));
        std::ranges::replace_if(
            text, [](char c) { return c == ',' || c == ';' || c == '\t' || c == '\r'; }, ' ');
        std::istringstream words(text);
        std::vector<double> numbers;
        bool sound = true;
        for (std::string word; words >> word;) {
            char* end = nullptr;
            const double value = std::strtod(word.c_str(), &end);
            sound = sound && *end == '\0' && std::isfinite(value);
            numbers.push_back(value);
        }
        // A line with digits is data: a typing error there must be a fault and not pass for a
        // title.
        const bool names =
            !sound && points.empty() && text.find_first_of("0123456789") == std::string::npos;
        if (numbers.empty() || names) continue;
        if (!sound || numbers.size() < 2 || numbers.size() > 3) {
            fault(line, "is not two or three numbers");
        } else if (numbers[0] <= 0.0 || numbers[0] > 2.0) {
            fault(line, "has a CSR that is not in (0, 2]");
        } else if (numbers[1] < 0.25 || numbers[1] > 10000.0) {
            // A stress cycle has its first peak at a quarter.
            fault(line, "has an N that is not in [0.25, 10000]");
        } else if (numbers.size() == 3 && numbers[2] < 0.0) {
            fault(line, "has a negative weight");
        } else {
            points.push_back({{"CSR", numbers[0]},
                              {"N", numbers[1]},
                              {"weight", numbers.size() == 3 ? numbers[2] : 1.0}});
        }
    }
    if (points.empty() && faults.empty())
        faults.push_back({pointer, file.string() + " holds no points", "give at least one"});
    return points;
}

/// Replaces file names by points.
void take_in_curves(json& document, const std::filesystem::path& folder,
                    std::vector<Fault>& faults) {
    json& curves = document.at("calibration").at("cyclic_strength");
    for (std::size_t i = 0; i < curves.size(); ++i) {
        json& curve = curves[i];
        const std::string pointer = "/calibration/cyclic_strength/" + std::to_string(i);
        const bool from_file = curve.contains("file");
        if (from_file == curve.contains("points"))
            faults.push_back({pointer, from_file ? "has points and a file" : "has no points",
                              "give \"points\", or \"file\" with lines CSR,N"});
        if (!from_file || curve.contains("points")) continue;
        std::filesystem::path file = curve.at("file").get<std::string>();
        if (file.is_relative()) file = folder / file;
        curve["points"] = points_of_file(file, pointer + "/file", faults);
    }
}

/// All three kinds of target are optional in the schema; a calibration without any would end at
/// once.
void check_calibration(const json& document, std::vector<Fault>& faults) {
    if (!document.contains("calibration")) return;
    const json& calibration = document.at("calibration");
    if (calibration.contains("cyclic") != calibration.contains("reference"))
        faults.push_back({"/calibration",
                          calibration.contains("cyclic") ? "has cyclic and no reference soil"
                                                         : "has a reference soil and no cyclic",
                          "give both, or neither of them"});
    if (!calibration.contains("cyclic") && calibration.at("strength").empty() &&
        calibration.at("cyclic_strength").empty())
        faults.push_back({"/calibration", "has no targets",
                          "give strength, cyclic_strength, or cyclic with a reference"});
    if (document.at("law").at("type") != "pm4sand") {
        faults.push_back({"/calibration", "needs PM4Sand", "set /law/type to \"pm4sand\""});
    }
    const auto names = parameter_names();
    for (const auto& [name, bound] : document.at("calibration").at("free").items()) {
        const std::string pointer = "/calibration/free/" + name;
        if (std::find(names.begin(), names.end(), name) == names.end()) {
            faults.push_back(
                {pointer, "is not a parameter that can be free", "use " + words::list_of(names)});
        }
        if (bound.at("least") >= bound.at("most")) {
            faults.push_back({pointer, "has least >= most", "give least < most"});
        }
    }
}

/// A document has a law with tests, or a calibration.
void check_what_it_is(const json& document, std::vector<Fault>& faults) {
    if (!document.contains("norsand_calibration")) {
        if (!document.contains("law"))
            faults.push_back({"/law", "is missing", "give a law, or norsand_calibration"});
        return;
    }
    for (const char* key : {"law", "tests", "calibration"}) {
        if (document.contains(key))
            faults.push_back({std::string("/") + key, "given together with norsand_calibration",
                              "leave it out: the law is what is sought"});
    }
}

/// Completes before it checks: PM4Sand's defaults and the points of files are checked like given
/// ones.
void complete_law_and_tests(json& document, const std::filesystem::path& folder,
                            std::vector<Fault>& faults) {
    complete_sand(document.at("law"), "/law", faults);
    check_dilatancy(document.at("law"), faults);
    if (document.contains("calibration")) {
        json& calibration = document.at("calibration");
        if (calibration.contains("reference"))
            complete_sand(calibration.at("reference"), "/calibration/reference", faults);
        take_in_curves(document, folder, faults);
    }
    check_calibration(document, faults);
    check_tests(document, faults);
    if (document.at("law").at("type") == "norsand") check_norsand_tests(document, faults);
}

}  // namespace

/// Faults are thrown stage by stage (overrides and schema, kind of document, contents), as each
/// stage relies on the one before.
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
    for (Fault& found :
         scene::complete_and_check(document, scene::element_test_schema(), file.string())) {
        faults.push_back(found);
    }
    if (!faults.empty()) throw fault::BadInput(file.string(), faults);
    check_what_it_is(document, faults);
    if (!faults.empty()) throw fault::BadInput(file.string(), faults);
    if (document.contains("norsand_calibration"))
        take_in_triaxial_files(document.at("norsand_calibration"), file.parent_path(), faults);
    else
        complete_law_and_tests(document, file.parent_path(), faults);
    if (!faults.empty()) throw fault::BadInput(file.string(), faults);
    scene::Scene scene{};
    scene.name = document.at("name");
    scene.title = document.at("title");
    scene.completed = document.dump();
    return scene;
}

/// Only for documents with a law: NorSand's calibration has norsand_problem_of() instead.
Bench bench_of(const scene::Scene& scene) {
    const json document = json::parse(scene.completed);
    Bench bench{law_of(document.at("law")), {}, std::nullopt};
    if (document.contains("tests")) {
        for (const auto& [name, test] : document.at("tests").items()) {
            bench.tests.push_back(plan_of(name, test, document.at("law")));
        }
    }
    if (document.contains("calibration")) {
        bench.calibration = problem_of(document.at("calibration"), std::get<SandLaw>(bench.law));
    }
    return bench;
}

Specimen consolidated(const TestLaw& law, const Consolidation& consolidation, double sigma_v) {
    const Voigt sigma = initial_stress(consolidation, sigma_v);
    if (const auto* plain = std::get_if<PlainLaw>(&law)) {
        return {PlainPoint{*plain, {sigma, 0.0}}};
    }
    if (const auto* loose = std::get_if<NorSandLaw>(&law)) {
        const norsand::Ready ready = ready_for(*loose, consolidation);
        return {NorSandPoint{ready, loose->options, begin(ready, consolidation, sigma_v).state}};
    }
    const auto& sand = std::get<SandLaw>(law);
    const pm4sand::Ready ready = pm4sand::ready(sand.parameters);
    return {SandPoint{ready, sand.options,
                      pm4sand::initialise(ready, sigma, 0.0, sand.options.scheme)}};
}

namespace {

/// How far the initial stress lies outside the yield surface [Pa].
double outside(const PlainPoint& point) {
    const double excess = std::visit(
        [&](const auto& law) { return materials::yield_excess(law, point.state); }, point.law);
    const double round_off = 1e-9 * point.state.sigma.cwiseAbs().maxCoeff();
    return excess > round_off ? excess : 0.0;
}
double outside(const SandPoint& point) {
    return materials::stress_outside(materials::PM4Sand{{}, point.law, point.options}, point.state);
}
double outside(const NorSandPoint&) { return 0.0; }  // refused earlier

/// Flags tests that start outside the yield surface.
std::vector<fault::Flag> warnings_of_starts(const Bench& bench) {
    std::string names;
    double largest = 0.0;
    for (const TestPlan& plan : bench.tests) {
        for (const double sigma_v : plan.consolidation.sigma_v) {
            const Specimen specimen = consolidated(bench.law, plan.consolidation, sigma_v);
            const double excess =
                std::visit([](const auto& point) { return outside(point); }, specimen.point);
            if (excess > 0.0) add_name(names, plan.name);
            largest = std::max(largest, excess);
        }
    }
    if (names.empty()) return {};
    const char* then = std::holds_alternative<SandLaw>(bench.law)
                           ? "what is outside stays on as a stress without strength, and the "
                             "response has it in it"
                           : "the first step takes it back, and a peak at strain 0 is the start's";
    return {{"starts_outside", fault::Severity::warning,
             "in " + names + " the stress at the start lies outside the law's surface, by up to " +
                 three_digits(largest / 1e3) + " kPa: " + then +
                 "; give K0 nearer to 1, or less static_shear",
             "/tests"}};
}

}  // namespace

std::vector<fault::Flag> warnings_of(const Bench& bench) {
    const auto* law = std::get_if<NorSandLaw>(&bench.law);
    if (!law) return warnings_of_starts(bench);
    std::vector<fault::Flag> flags;
    std::string drained, held, clipped;
    for (const TestPlan& plan : bench.tests) {
        const Consolidation& at = plan.consolidation;
        const norsand::Ready ready = ready_for(*law, at);
        if (is_drained(at.boundary) && at.norsand->S > 0.0) add_name(drained, plan.name);
        for (const double sigma_v : at.sigma_v) {
            const norsand::Beginning begun = begin(ready, at, sigma_v);
            if (begun.clipped) add_name(clipped, plan.name);
            const double p_c = norsand::critical_pressure(ready, begun.state.e);
            if (!is_drained(at.boundary) && p_c < 2.0 * ready.parameters.p_min)
                add_name(held, plan.name);
        }
    }
    using fault::Severity;
    if (!drained.empty()) {
        flags.push_back({"drained_softening", Severity::questionable,
                         "S > 0 in the drained tests " + drained +
                             ": it softens loose and hardens dense soil without reason there; set "
                             "their S to 0",
                         "/tests"});
    }
    if (!held.empty()) {
        flags.push_back({"strength_of_floor", Severity::warning,
                         "in " + held +
                             " the critical state lies below twice p_min: the residual strength is "
                             "that of /law/p_min_kPa, not the soil's",
                         "/law/p_min_kPa"});
    }
    if (!clipped.empty()) {
        flags.push_back({"clipped_overconsolidation", Severity::warning,
                         "in " + clipped +
                             " R asks for a surface beyond the limiting hardness; it was taken as "
                             "large as that",
                         "/tests"});
    }
    return flags;
}

}  // namespace breach::element_bench
