#include "core/scene/sand.hpp"

#include <nlohmann/json.hpp>
#include <numbers>

#include "core/words/words.hpp"

namespace breach::materials::pm4sand {

/// Scheme by the key "compat".
static constexpr auto words_of(Scheme) {
    using enum Scheme;
    return words::in_order<Scheme>({{reference, "opensees"}, {adaptive, "corrected"}});
}

}  // namespace breach::materials::pm4sand

namespace breach::scene {

namespace pm4sand = materials::pm4sand;
using nlohmann::json;
using pm4sand::Parameters;

namespace {

constexpr double degree = std::numbers::pi / 180.0;

struct Key {
    const char* key;
    double Parameters::*member;
    double unit = 1.0;  ///< SI value of one unit of the key
};

constexpr Key keys[] = {
    {"D_R", &Parameters::D_R},
    {"G_0", &Parameters::G_0},
    {"h_po", &Parameters::h_po},
    {"p_atm_kPa", &Parameters::p_atm, 1e3},
    {"h_0", &Parameters::h_0},
    {"e_max", &Parameters::e_max},
    {"e_min", &Parameters::e_min},
    {"n_b", &Parameters::n_b},
    {"n_d", &Parameters::n_d},
    {"c_z", &Parameters::c_z},
    {"c_epsilon", &Parameters::c_epsilon},
    {"phi_cv_deg", &Parameters::phi_cv, degree},
    {"nu", &Parameters::nu},
    {"C_GD", &Parameters::C_GD},
    {"C_DR", &Parameters::C_DR},
    {"C_Kaf", &Parameters::C_Kaf},
    {"Q", &Parameters::Q},
    {"R", &Parameters::R},
    {"m", &Parameters::m},
    {"F_sed_min", &Parameters::F_sed_min},
    {"p_sedo_kPa", &Parameters::p_sedo, 1e3},
};

}  // namespace

Parameters sand_parameters(const json& law) {
    const double D_R = law.at("D_R");
    Parameters out = pm4sand::defaults(D_R, law.at("G_0"), pm4sand::default_h_po(D_R));
    if (law.contains("p_atm_kPa")) out.p_sedo = 1e3 * law.at("p_atm_kPa").get<double>() / 5.0;
    for (const Key& each : keys) {
        if (law.contains(each.key)) {
            out.*each.member = each.unit * law.at(each.key).get<double>();
        }
    }
    if (law.contains("A_do")) out.A_do = law.at("A_do");
    if (law.contains("z_max")) out.z_max = law.at("z_max");
    out.reconsolidation = law.at("reconsolidation").get<bool>() ? pm4sand::Reconsolidation::on
                                                                : pm4sand::Reconsolidation::off;
    return out;
}

pm4sand::Options sand_options(const json& law) {
    return {.scheme = words::word_at<pm4sand::Scheme>(law, "compat"),
            .tolerance = law.at("tolerance")};
}

json sand_as_json(const Parameters& parameters) {
    json out{{"type", "pm4sand"}};
    for (const Key& each : keys) out[each.key] = parameters.*each.member / each.unit;
    if (parameters.A_do) out["A_do"] = *parameters.A_do;
    if (parameters.z_max) out["z_max"] = *parameters.z_max;
    return out;
}

void complete_sand(json& law) {
    if (!law.is_object() || law.value("type", "") != "pm4sand") return;
    const json whole = sand_as_json(sand_parameters(law));
    for (const auto& [key, value] : whole.items()) {
        if (!law.contains(key)) law[key] = value;
    }
}

}  // namespace breach::scene
