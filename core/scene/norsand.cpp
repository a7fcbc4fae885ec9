#include "core/scene/norsand.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/words/number.hpp"
#include "core/words/words.hpp"

namespace breach::materials::norsand {

static constexpr auto words_of(FlowRule) {
    using enum FlowRule;
    return words::in_order<FlowRule>({{js, "js"}, {radial, "radial"}, {normal, "normal"}});
}
static constexpr auto words_of(Unloading) {
    using enum Unloading;
    return words::in_order<Unloading>({{elastic, "elastic"}, {capped, "cap"}});
}

}  // namespace breach::materials::norsand

namespace breach::scene {

namespace norsand = materials::norsand;
using fault::Fault;
using nlohmann::json;

namespace {

double number(const json& law, const char* key, double unit = 1.0) {
    return unit * law.at(key).get<double>();
}

bool has_any(const json& entry, std::initializer_list<const char*> keys) {
    for (const char* key : keys)
        if (entry.contains(key)) return true;
    return false;
}

std::string three_digits(double value) { return words::text_of(value, 3); }

/// All keys of a critical state line or none; exactly one of the two lines.
std::vector<Fault> check_line(const json& law, const std::string& pointer) {
    const bool semi_log = has_any(law, {"Gamma", "lambda"});
    const bool curved = has_any(law, {"C_a", "C_b", "C_c"});
    const char* remedy = "give Gamma and lambda, or C_a, C_b and C_c";
    if (semi_log == curved) {
        const char* what = semi_log
                               ? "given together with C_a, C_b or C_c: two critical state lines"
                               : "is missing: the law has no critical state line";
        return {{pointer + "/Gamma", what, remedy}};
    }
    std::vector<Fault> faults;
    for (const char* key : {"Gamma", "lambda"})
        if (semi_log && !law.contains(key))
            faults.push_back({pointer + "/" + key, "is missing", remedy});
    for (const char* key : {"C_a", "C_b", "C_c"})
        if (curved && !law.contains(key))
            faults.push_back({pointer + "/" + key, "is missing", remedy});
    return faults;
}

/// A Gamma for another stress unit gives impossible void ratios.
std::vector<Fault> check_void_ratios(const norsand::Ready& law, double e_max,
                                     const std::string& pointer) {
    constexpr double p = 100e3;
    constexpr double least = 0.2;
    const double e_c = norsand::critical_void_ratio(law, p);
    if (e_c >= least && e_c <= e_max) return {};
    const std::string what = "makes the critical void ratio at 100 kPa " + three_digits(e_c) +
                             ", not within " + three_digits(least) + " to " + three_digits(e_max);
    if (law.parameters.curved) {
        return {{pointer + "/C_a", what,
                 "give e_c = C_a - C_b (p / p_csl_kPa)^C_c, or raise e_max if it is so loose"}};
    }
    const auto& line = *law.parameters.semi_log;
    const double for_1_kPa = line.Gamma - line.lambda * std::log(1000.0);
    return {
        {pointer + "/Gamma", what,
         "Gamma belongs to 1 kPa and lambda to the natural logarithm: a Gamma for 1 Pa becomes " +
             three_digits(for_1_kPa) + "; raise e_max if the soil is so loose"}};
}

}  // namespace

norsand::Parameters norsand_parameters(const json& law) {
    norsand::Parameters out{};
    if (law.contains("Gamma")) {
        out.semi_log = {.Gamma = law.at("Gamma"), .lambda = law.at("lambda")};
    } else {
        out.curved = {.C_a = law.at("C_a"),
                      .C_b = law.at("C_b"),
                      .C_c = law.at("C_c"),
                      .p_ref = number(law, "p_csl_kPa", 1e3)};
    }
    out.M_tc = law.at("M_tc");
    out.N = law.at("N");
    out.chi_tc = law.at("chi_tc");
    out.H_0 = law.at("H_0");
    out.H_psi = law.at("H_psi");
    out.G_ref = number(law, "G_ref_MPa", 1e6);
    out.m = law.at("m");
    out.p_ref = number(law, "p_ref_kPa", 1e3);
    out.nu = law.at("nu");
    out.flow = words::word_at<norsand::FlowRule>(law, "flow");
    out.unloading = words::word_at<norsand::Unloading>(law, "unloading");
    out.p_min = number(law, "p_min_kPa", 1e3);
    return out;
}

norsand::Options norsand_options(const json& law) { return {.tolerance = law.at("tolerance")}; }

NorSandStart norsand_start(const json& entry, const json& law) {
    const json& from = has_any(entry, {"psi_0", "e_0"}) ? entry : law;
    NorSandStart out{};
    if (from.contains("psi_0")) out.psi_0 = from.at("psi_0");
    if (from.contains("e_0")) out.e_0 = from.at("e_0");
    out.R = entry.contains("R") ? entry.at("R") : law.at("R");
    return out;
}

std::vector<Fault> check_norsand(const json& law, const std::string& pointer) {
    std::vector<Fault> faults = check_line(law, pointer);
    if (!faults.empty()) return faults;
    const norsand::Ready ready = norsand::ready(norsand_parameters(law));
    faults = check_void_ratios(ready, law.at("e_max"), pointer);
    const double slope = norsand::critical_slope(ready, 100e3);
    const norsand::Parameters& par = ready.parameters;
    if (slope * par.chi_tc >= norsand::most_chi_lambda * par.M_tc) {
        const double most = norsand::most_chi_lambda * par.M_tc / slope;
        faults.push_back({pointer + "/chi_tc",
                          "makes lambda chi_tc / M_tc " +
                              three_digits(slope * par.chi_tc / par.M_tc) +
                              ": at 1 the image state is singular",
                          "give chi_tc below " + three_digits(most) + ", or check lambda"});
    }
    return faults;
}

namespace {

std::optional<materials::Table> profile_from(const json& law) {
    if (!law.contains("psi_0_profile")) return std::nullopt;
    const json& profile = law.at("psi_0_profile");
    return materials::Table{
        profile.at("by") == "elevation" ? materials::Along::elevation : materials::Along::depth,
        profile.at("points").get<std::vector<std::array<double, 2>>>()};
}

/// Stress of level ground with this K_0 at p' = 100 kPa [Pa, tension positive].
mechanics::Voigt level_ground(double K_0) {
    const double sigma_v = 300e3 / (1.0 + 2.0 * K_0);
    return {-K_0 * sigma_v, -sigma_v, -K_0 * sigma_v, 0.0};
}

/// Faults of level ground with this initial state; `loose`: entry to name if it is too loose.
std::vector<Fault> check_start(const materials::NorSand& made, double K_0, const std::string& loose,
                               const std::string& pointer) {
    const norsand::Beginning begun = beginning(made, level_ground(K_0));
    if (!(begun.state.e > 0.0))
        return {{loose, "makes the void ratio " + three_digits(begun.state.e) + " at 100 kPa",
                 "raise it"}};
    if (begun.eta_limit <= 0.0) {
        const norsand::Parameters& par = made.ready.parameters;
        const double most = par.M_tc / (begun.state.chi_i * (1.0 + par.N)) +
                            norsand::critical_slope(made.ready, 100e3);
        return {{loose,
                 "is a state parameter of " +
                     three_digits(begun.state.e - norsand::critical_void_ratio(made.ready, 100e3)) +
                     " at 100 kPa: so loose that the law has no stable stress ratio",
                 "give a state parameter below " + three_digits(most) +
                     ", or check chi_tc and the critical state line"}};
    }
    if (!begun.shrunk) return {};
    const double limit = begun.eta_limit;
    return {{pointer + "/K_0",
             "makes q/p " + three_digits(begun.eta) +
                 " in level ground, outside the yield surface: at most " + three_digits(limit) +
                 " stands there",
             "give K_0 above " + three_digits((3.0 - limit) / (3.0 + 2.0 * limit))}};
}

}  // namespace

std::vector<Fault> check_norsand_in_scene(const json& law, const std::string& pointer) {
    std::vector<Fault> faults = check_norsand(law, pointer);
    if (!faults.empty()) return faults;
    int given = 0;
    for (const char* key : {"psi_0", "psi_0_profile", "e_0"}) given += law.contains(key) ? 1 : 0;
    if (given != 1) {
        return {{pointer + "/psi_0",
                 given > 1 ? "is one of several initial states"
                           : "is missing: NorSand must know how loose it is",
                 "give psi_0, psi_0_profile or e_0, one of them"}};
    }
    if (!law.contains("psi_0_profile")) {
        const std::string loose = pointer + (law.contains("e_0") ? "/e_0" : "/psi_0");
        return check_start(norsand_law(law), law.at("K_0"), loose, pointer);
    }
    const json& points = law.at("psi_0_profile").at("points");
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::string row = pointer + "/psi_0_profile/points/" + std::to_string(i);
        if (i > 0 && points[i - 1][0] >= points[i][0])
            faults.push_back({row, "is out of order", "give ascending places, each once"});
        materials::NorSand there = norsand_law(law);
        there.psi_0_profile.reset();
        there.psi_0 = points[i][1].get<double>();
        const auto found = check_start(there, law.at("K_0"), row, pointer);
        faults.insert(faults.end(), found.begin(), found.end());
    }
    return faults;
}

materials::NorSand norsand_law(const json& law) {
    norsand::Parameters parameters = norsand_parameters(law);
    parameters.S = law.at("S");
    const double K_0 = law.at("K_0");
    const double nu = K_0 / (1.0 + K_0);
    const NorSandStart start = norsand_start(law, law);
    return {.elasticity = {2.0 * (1.0 + nu) * parameters.G_ref, nu},
            .ready = norsand::ready(parameters),
            .options = norsand_options(law),
            .psi_0 = start.psi_0,
            .e_0 = start.e_0,
            .R = start.R,
            .psi_0_profile = profile_from(law)};
}

}  // namespace breach::scene
