// Materials as JSON, from a soil's numbers. Rounding happens here, so that scenes are readable
// and the same options give the same scene, to the last digit: the cache compares scenes.
#include "services/earthquake/soils.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/words/number.hpp"

namespace breach::earthquake {

namespace {

Json law_of(const Soil& soil, double c_kPa, double phi_deg, double nu) {
    Json law{{"type", "mohr_coulomb"},
             {"E_MPa", soil.E_MPa},
             {"nu", nu},
             {"c_kPa", c_kPa},
             {"phi_deg", phi_deg}};
    if (soil.c_residual_kPa != soil.c_kPa && phi_deg > 0.0)
        law["softening"] = {{"epsilon_q_start", 0.01},
                            {"epsilon_q_end", 0.05},
                            {"c_residual_kPa", soil.c_residual_kPa},
                            {"phi_residual_deg", soil.phi_residual_deg}};
    return law;
}

}  // namespace

double millimetres(double value) { return std::round(value * 1e3) / 1e3; }
double nanometres(double value) { return std::round(value * 1e9) / 1e9; }
double rounded(double value) {
    if (value == 0.0) return 0.0;
    const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 2.0);
    return std::stod(words::text_of(std::round(value / unit) * unit));
}

Json corner(const Vec2& place) { return {nanometres(place.x()), nanometres(place.y())}; }
Json points(const std::vector<Vec2>& line) {
    Json all = Json::array();
    for (const Vec2& each : line) all.push_back({millimetres(each.x()), millimetres(each.y())});
    return all;
}

static Json material(const Soil& soil, const std::string& note, Json law) {
    return {{"notes", {note}},
            {"density", soil.density},
            {"viscosity", 1000},
            {"limit_strength", {{"c_kPa", soil.c_kPa}, {"phi_deg", soil.phi_deg}}},
            {"law", std::move(law)}};
}

Json frictional(const Soil& soil, const std::string& note) {
    return material(soil, note, law_of(soil, soil.c_kPa, soil.phi_deg, soil.nu));
}

Json undrained(const Soil& soil, double c_kPa, const std::string& note) {
    return material(soil, note, law_of(soil, c_kPa, 0.0, 0.49));
}

Json sand(const Soil& soil, const std::string& note) {
    Json law{{"type", "pm4sand"}, {"D_R", soil.D_R}, {"G_0", soil.G_0}, {"h_po", soil.h_po}};
    if (soil.D_R < 0.5) {
        law["Q"] = 11.998;
        law["R"] = 3.75;
    }
    return {{"notes",
             {note,
              "assumed: PM4Sand, void ratio and permeability; calibrate them ("
              "docs/how-to/calibrate_a_sand.md)"}},
            {"density", soil.density},
            {"void_ratio", soil.void_ratio},
            {"permeability", {soil.permeability, soil.permeability}},
            {"limit_strength", {{"c_kPa", soil.c_kPa}, {"phi_deg", soil.phi_deg}}},
            {"law", law}};
}

Json liquefied(const Soil& soil, double residual_ratio) {
    return undrained(soil, rounded(residual_ratio * atmosphere),
                     "what liquefied layers are made like: their s_r comes from "
                     "/transfer/liquefied/residual_strength");
}

}  // namespace breach::earthquake
