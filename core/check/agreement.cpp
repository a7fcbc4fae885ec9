// What one phase has and another one lacks: soil that liquefies, and water.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/check/region_strengths.hpp"
#include "core/check/section.hpp"
#include "core/check/subjects.hpp"

namespace breach::check {

namespace {

std::string quoted(const std::string& name) { return "\"" + name + "\""; }

std::string listed(const std::vector<std::string>& names) {
    std::string all;
    for (const std::string& each : names) all += (all.empty() ? "" : ", ") + quoted(each);
    return all;
}

// ---------------------------------------------------------------- soil that liquefies

/// Mean residual strength of the runout's soil, as entries of a layer.
std::string residual_entry(const scene::Scene& scene, const scene::Ground& ground, std::size_t r,
                           const RegionStrengths& region, const std::array<double, 2>& levels) {
    if (materials::has_state_parameter(material_of(scene, scene.section.regions[r])->law))
        return "\"norsand\": \"residual\"";
    double sum = 0.0, n = 0.0;
    for (const View& view : region.residuals()) {
        if (view.phase == "LEM" || n > 0.0) continue;
        for (const Vec2& each : spread_over(scene.section.regions[r].polygon))
            if (const auto shear = view.at(ground.at(each, r));
                shear && each.y() >= levels[0] && each.y() <= levels[1])
                sum += shear->high, ++n;
    }
    if (n == 0.0) return "\"residual_strength_kPa\": ...";
    return "\"residual_strength_kPa\": " + text(std::round(sum / n / 100.0) / 10.0);
}

/// Largest range of levels of a region's wet soil that no layer of /lem/liquefaction includes.
std::optional<std::array<double, 2>> left_out(const scene::Scene& scene, std::size_t r) {
    constexpr double few = 0.1;  // of the wet soil
    const geometry::Polygon& polygon = scene.section.regions[r].polygon;
    const geometry::Box box = geometry::bounding_box(polygon);
    std::array<double, 2> gap{box.low.y(), box.high.y()};
    double wet = 0.0, out = 0.0;
    for (const Vec2& each : spread_over(polygon)) {
        const auto& water = scene.lem->water;
        if (water && !water->line.empty() && level_at(water->line, each.x()) < each.y()) continue;
        ++wet;
        std::array<double, 2> around{box.low.y(), box.high.y()};
        bool included = false;
        for (const scene::UndrainedRegion& layer : scene.lem->liquefaction) {
            if (layer.region != r) continue;
            if (!layer.levels) return std::nullopt;
            const auto& [low, high] = *layer.levels;
            included = included || (each.y() >= low && each.y() <= high);
            if (high <= each.y()) around[0] = std::max(around[0], high);
            if (low >= each.y()) around[1] = std::min(around[1], low);
        }
        if (included) continue;
        ++out;
        gap = around;
    }
    if (out <= few * wet) return std::nullopt;
    return gap;
}

/// To be pasted into /lem/liquefaction.
std::string layer_entry(const scene::Scene& scene, const scene::Ground& ground, std::size_t r,
                        const RegionStrengths& region,
                        const std::optional<std::array<double, 2>>& levels = {}) {
    constexpr double any = std::numeric_limits<double>::infinity();
    const std::string range =
        levels ? "\"levels\": [" + text((*levels)[0]) + ", " + text((*levels)[1]) + "], " : "";
    return "{\"region\": " + quoted(region.name()) + ", " + range +
           residual_entry(scene, ground, r, region,
                          levels.value_or(std::array<double, 2>{-any, any})) +
           "}";
}

void warn_about_lem(const scene::Scene& scene, const scene::Ground& ground, std::size_t r,
                    const RegionStrengths& region, const std::string& liquefies,
                    Problems& problems) {
    std::optional<std::array<double, 2>> gap;
    if (region.is_liquefied_in_lem()) {
        gap = left_out(scene, r);
        if (!gap) return;
    }
    warn(problems, "layers_differ", "/lem/liquefaction",
         (gap ? "leaves out a part of " : "has no layer of ") + quoted(region.name()) +
             ", which liquefies in the runout (" + liquefies +
             "): the LEM keeps its drained strength there, and its factor of safety after "
             "liquefaction is too high; add " +
             layer_entry(scene, ground, r, region, gap) + " in its order from the top down");
}

/// One flag for a LEM without layers, however many regions liquefy.
void warn_about_sound_lem(const scene::Scene& scene, const scene::Ground& ground,
                          const std::vector<std::size_t>& liquefied,
                          const std::vector<RegionStrengths>& strengths, Problems& problems) {
    std::string names, layers;
    for (const std::size_t r : liquefied) {
        names += (names.empty() ? "" : ", ") + quoted(strengths[r].name());
        layers += (layers.empty() ? "" : ", ") + layer_entry(scene, ground, r, strengths[r]);
    }
    warn(problems, "layers_differ", "/lem/liquefaction",
         "has no layer, and soil of " + names +
             " liquefies in the runout: the LEM's factor of safety is that of the sound dam; " +
             (scene.fem ? "give the study \"post_seismic\": true, or " : "") +
             "add, in their order from the top down, [" + layers + "]");
}

void warn_about_runout(const scene::Scene& scene, const RegionStrengths& region,
                       Problems& problems) {
    warn(problems, "layers_differ", scene.fem ? "/transfer/liquefied" : "/transfer/mapping",
         "does not liquefy " + quoted(region.name()) +
             ", which a layer of /lem/liquefaction does: its soil keeps its drained strength, and "
             "the runout is too short; " +
             (scene.fem ? "add " + quoted(region.name()) + " to /transfer/liquefied/regions"
                        : "add {\"region\": " + quoted(region.name()) +
                              ", \"to\": ...} with a material of phi_deg 0 and its residual "
                              "strength as c_kPa") +
             ", or leave the layer out");
}

// ---------------------------------------------------------------- water

struct Table {
    const char* pointer;
    const std::vector<Vec2>* line;
};

std::vector<Table> tables_besides_lem(const scene::Scene& scene) {
    std::vector<Table> tables;
    if (scene.fem && scene.fem->water) {
        tables.push_back({"/fem/water", &scene.fem->water->line});
        for (const scene::Stage& each : scene.fem->stages)
            if (each.phreatic_line) tables.push_back({"/fem/stages", &*each.phreatic_line});
    }
    if (scene.transfer && !scene.transfer->phreatic_line.empty())
        tables.push_back({"/transfer/phreatic_line", &scene.transfer->phreatic_line});
    return tables;
}

/// Degree of saturation by density and void ratio, of grains of 2700 kg/m3; 0: unknown [-].
double saturation(const scene::Material& soil) {
    if (!soil.void_ratio || *soil.void_ratio <= 0.0) return 0.0;
    const double e = *soil.void_ratio;
    return (soil.density * (1.0 + e) / 1000.0 - 2.7) / e;
}

/// Why a region's soil is wet, by entries other than /lem's water; empty: no sign of water.
std::string sign_of_water(const scene::Scene& scene, std::size_t r, const RegionStrengths& region) {
    const scene::Region& drawn = scene.section.regions[r];
    const std::string soil_here = quoted(region.name());
    if (region.is_liquefied_in_lem()) return "/lem/liquefaction names " + soil_here;
    for (const Table& each : tables_besides_lem(scene))
        if (scene::is_below_water(scene.section, drawn, *each.line))
            return std::string(each.pointer) + " has a line in " + soil_here;
    if (const auto liquefies = region.liquefied_in_runout())
        return *liquefies + " has " + soil_here + " undrained in the runout";
    const auto peak = region.lem_peak();
    const auto shear = peak ? peak->at({10.0, 0.0, 1e5}) : std::nullopt;
    if (shear && shear->undrained)
        return peak->pointer + " has " + soil_here + " undrained, by sigma'_v0";
    const scene::Material& soil = *material_of(scene, drawn);
    if (saturation(soil) > 0.8)
        return "density and void ratio of " + quoted(soil.name) + " are those of saturated soil";
    return "";
}

bool lem_knows_water_of(const scene::Lem& lem, std::size_t region) {
    return lem.water ||
           std::ranges::any_of(
               lem.piezometric_lines,
               [&](const auto& each) { return std::ranges::count(each.regions, region) > 0; }) ||
           std::ranges::count(lem.pore_pressure_ratios, region, &scene::PorePressureRatio::region) >
               0;
}

std::string as_entry(const std::vector<Vec2>& line) {
    std::string points;
    for (const Vec2& each : line)
        points += (points.empty() ? "[" : ", [") + text(each.x()) + ", " + text(each.y()) + "]";
    return "\"water\": {\"line\": [" + points + "]}";
}

/// The ground, where it is below `level`, else that level: the highest water without a pond.
std::vector<Vec2> highest_water(const scene::Scene& scene, double level) {
    const geometry::Box box = extent(scene.section);
    std::vector<Vec2> line;
    for (const auto& piece : geometry::ground_between(scene.section, box.low.x(), box.high.x()))
        for (const Vec2& each : piece) {
            const Vec2 point(each.x(), std::min(each.y(), level));
            if (!line.empty() && point.x() <= line.back().x()) {
                line.back().y() = std::min(line.back().y(), point.y());
                continue;
            }
            if (line.size() > 1 && line.back().y() == point.y() &&
                line[line.size() - 2].y() == point.y())
                line.pop_back();
            line.push_back(point);
        }
    return line;
}

/// Refuses layers that liquefy without water, and warns of other soil that is wet elsewhere.
void check_dry_lem(const scene::Scene& scene, const std::vector<RegionStrengths>& strengths,
                   Problems& problems) {
    const scene::Lem& lem = *scene.lem;
    const bool refused = !lem.liquefaction.empty() && !lem.has_water();
    std::vector<std::string> names;
    std::string why, ratios;
    double top = -std::numeric_limits<double>::infinity();
    for (std::size_t r = 0; r < strengths.size(); ++r) {
        const RegionStrengths& region = strengths[r];
        if (lem_knows_water_of(lem, r) || !region.lem_depends_on_water()) continue;
        const std::string sign = sign_of_water(scene, r, region);
        if (sign.empty()) continue;
        if (names.empty()) why = sign;
        names.push_back(region.name());
        ratios += (ratios.empty() ? "" : ", ") +
                  ("{\"region\": " + quoted(region.name()) + ", \"r_u\": 0}");
        top = std::max(top, geometry::bounding_box(scene.section.regions[r].polygon).high.y());
    }
    if (names.empty()) return;
    const std::vector<Table> tables = tables_besides_lem(scene);
    const std::string cause = "is missing, so the LEM has no pore pressure in " + listed(names) +
                              ", although " + why +
                              ": the factor of safety is too high (that of a dam rose from 1.41 "
                              "to 1.68)";
    const std::string remedy =
        "add " + as_entry(tables.empty() ? highest_water(scene, top) : *tables.front().line) +
        " to /lem, or, ";
    if (refused)
        refuse(problems, "/lem/water", cause,
               remedy +
                   "if the soil is dry, leave /lem/liquefaction out: dry soil does not "
                   "liquefy");
    else
        warn(problems, "missing_water", "/lem/water",
             cause + "; " + remedy + "if this soil is dry, \"pore_pressure_ratios\": [" + ratios +
                 "]");
}

void warn_about_dry_fem(const scene::Scene& scene, Problems& problems) {
    std::vector<Table> tables = tables_besides_lem(scene);
    if (scene.lem && scene.lem->water) tables.push_back({"/lem/water", &scene.lem->water->line});
    if (tables.empty()) return;
    std::vector<std::string> names;
    for (const scene::Region& region : scene.section.regions) {
        const materials::Law& law = material_of(scene, region)->law;
        if (materials::traits(law).frictional &&
            scene::is_below_water(scene.section, region, *tables.front().line))
            names.push_back(region.name);
    }
    if (names.empty()) return;
    warn(problems, "missing_water", "/fem/water",
         "is missing, so the FEM has no pore pressure in " + listed(names) + ", although " +
             tables.front().pointer +
             " has a line there: the soil is too strong, and nothing liquefies; add " +
             as_entry(*tables.front().line) +
             " to /fem, and void_ratio and permeability to its materials");
}

}  // namespace

void check_agreement(const scene::Scene& scene, Problems& problems) {
    if (!is_whole(scene)) return;
    if (scene.fem && !scene.fem->water) warn_about_dry_fem(scene, problems);
    if (!scene.lem) return;
    const scene::Ground ground(scene);
    std::vector<RegionStrengths> strengths;
    for (std::size_t r = 0; r < scene.section.regions.size(); ++r)
        strengths.emplace_back(scene, ground, r);
    check_dry_lem(scene, strengths, problems);
    if (!scene.mpm) return;
    std::vector<std::size_t> sound;
    for (std::size_t r = 0; r < strengths.size(); ++r) {
        const RegionStrengths& region = strengths[r];
        const auto liquefies = region.liquefied_in_runout();
        if (liquefies && !region.is_undrained_in_lem()) {
            if (scene.lem->liquefaction.empty())
                sound.push_back(r);
            else
                warn_about_lem(scene, ground, r, region, *liquefies, problems);
        } else if (region.is_liquefied_in_lem() && !region.is_weak_in_runout())
            warn_about_runout(scene, region, problems);
    }
    if (!sound.empty()) warn_about_sound_lem(scene, ground, sound, strengths, problems);
}

}  // namespace breach::check
