// Reads /transfer and the soils that it creates.
#include <algorithm>
#include <cmath>

#include "core/mechanics/atmosphere.hpp"
#include "core/scene/checks.hpp"
#include "core/scene/reader.hpp"

namespace breach::scene {

using nlohmann::json;

namespace {

template <class List>
std::optional<std::size_t> named(Reader& reader, const List& list, const std::string& name,
                                 const std::string& pointer, const std::string& where) {
    const auto found =
        std::find_if(list.begin(), list.end(), [&](const auto& each) { return each.name == name; });
    if (found != list.end()) return static_cast<std::size_t>(found - list.begin());
    reader.add(pointer, "names \"" + name + "\", which " + where + " does not have",
               "give the name of one of " + where);
    return std::nullopt;
}

std::optional<std::size_t> point_material(Reader& reader, const Scene& scene,
                                          const std::string& name, const std::string& pointer) {
    const auto material = named(reader, scene.materials, name, pointer, "/materials");
    if (!material || materials::is_for_particles(scene.materials[*material].law)) return material;
    const std::string type = materials::traits(scene.materials[*material].law).type;
    reader.add(
        pointer, "names a " + type + " material, which particles cannot have",
        "name a " + materials::types_of_laws_that(materials::is_for_particles) + " material");
    return std::nullopt;
}

void read_mapping(Reader& reader, const Scene& scene, const json& transfer, Transfer& result) {
    for (std::size_t i = 0; i < transfer.at("mapping").size(); ++i) {
        const json& each = transfer.at("mapping")[i];
        const std::string pointer = "/transfer/mapping/" + std::to_string(i);
        const auto region = named(reader, scene.section.regions, each.at("region"),
                                  pointer + "/region", "/section/regions");
        const auto material = point_material(reader, scene, each.at("to"), pointer + "/to");
        std::optional<std::size_t> saturated;
        if (each.contains("saturated"))
            saturated = point_material(reader, scene, each.at("saturated"), pointer + "/saturated");
        if (!region || !material) continue;
        if (std::ranges::find(result.mapping, *region, &SoilMapping::region) !=
            result.mapping.end())
            reader.add(pointer + "/region", "is mapped twice", "give every region once");
        if (each.contains("saturated") && result.phreatic_line.empty())
            reader.add(pointer + "/saturated", "needs the phreatic line",
                       "give /transfer/phreatic_line");
        result.mapping.push_back({*region, *material, saturated});
    }
}

/// s_r = coefficient (sigma'_v0 / standard atmosphere)^exponent, at the middle of each layer.
struct StrengthFunction {
    std::size_t like;    ///< material for all other properties
    double coefficient;  ///< [Pa]
    double exponent;
};

std::optional<StrengthFunction> strength_function(Reader& reader, const Scene& scene,
                                                  const json& liquefied) {
    if (!liquefied.contains("residual_strength")) return std::nullopt;
    const json& function = liquefied.at("residual_strength");
    const std::string pointer = "/transfer/liquefied/residual_strength/like";
    const auto like = point_material(reader, scene, function.at("like"), pointer);
    if (!like) return std::nullopt;
    const auto& law = scene.materials[*like].law;
    const auto strength = materials::limit_strength(law);
    if (materials::has_strength_of_points(law)) {
        reader.add(
            pointer, "takes its strength from a profile, which every layer would keep",
            "give the layers materials of their own with \"strength\", or name here one with "
            "c_kPa in its law");
        return std::nullopt;
    }
    const bool undrained =
        materials::traits(law).c_and_phi && strength->tan_phi == 0.0 && strength->c > 0.0;
    if (!undrained) {
        reader.add(pointer, "has no undrained strength to be replaced",
                   "name a " + materials::types_of_laws_that(materials::has_c_and_phi) +
                       " material with phi_deg 0 and c_kPa above 0");
        return std::nullopt;
    }
    return StrengthFunction{*like, function.at("coefficient_kPa").get<double>() * kPa,
                            function.at("exponent")};
}

std::string layer_name(const Material& like, std::size_t layer) {
    return like.name + std::string("_") + std::to_string(layer + 1);
}

/// Creates a layer's material from the function; the residual cohesion keeps its ratio to the peak.
std::size_t made_material(Scene& scene, const StrengthFunction& s_r, std::size_t layer,
                          const std::array<double, 2>& sigma_v0) {
    Material made = scene.materials[s_r.like];
    made.name = layer_name(made, layer);
    double& peak = *materials::strength_entries(made.law).c;
    const double middle = 0.5 * (sigma_v0[0] + sigma_v0[1]);
    const double c =
        s_r.coefficient * std::pow(middle / mechanics::standard_atmosphere, s_r.exponent);
    if (materials::Softening* softening = materials::softening(made.law))
        softening->c_residual *= c / peak;
    peak = c;
    scene.materials.push_back(std::move(made));
    return scene.materials.size() - 1;
}

/// Material of a layer: its own entry, or from the function.
std::optional<std::size_t> layer_material(Reader& reader, Scene& scene, const json& layer,
                                          const std::optional<StrengthFunction>& s_r, std::size_t i,
                                          const std::array<double, 2>& sigma_v0) {
    const std::string pointer = "/transfer/liquefied/layers/" + std::to_string(i);
    if (layer.contains("material"))
        return point_material(reader, scene, layer.at("material"), pointer + "/material");
    if (s_r) {
        const std::string name = layer_name(scene.materials[s_r->like], i);
        if (std::ranges::find(scene.materials, name, &Material::name) == scene.materials.end())
            return made_material(scene, *s_r, i, sigma_v0);
        reader.add(pointer, "would make a material \"" + name + "\", which /materials has already",
                   "rename that material, or name it in this layer's \"material\"");
        return std::nullopt;
    }
    if (!reader.document().contains(json::json_pointer("/transfer/liquefied/residual_strength")))
        reader.add(pointer, "has no material",
                   "give \"material\", or residual_strength for all layers");
    return std::nullopt;
}

/// Without layers, every soil that can liquefy needs a profile with a residual strength: what a
/// mapping keeps above the phreatic line cannot.
void check_residuals(Reader& reader, const Scene& scene, const json& liquefied,
                     const Transfer& transfer, const LiquefiedZone& zone) {
    if (liquefied.contains("residual_strength")) {
        reader.add("/transfer/liquefied/layers", "are missing, and residual_strength is for them",
                   "give the layers, or leave residual_strength out");
    }
    for (std::size_t i = 0; i < zone.regions.size(); ++i) {
        const std::size_t region = zone.regions[i];
        std::vector<std::size_t> materials{scene.section.regions[region].material};
        for (const SoilMapping& each : transfer.mapping) {
            if (each.region != region) continue;
            materials = {each.saturated.value_or(each.material)};
        }
        for (const std::size_t index : materials) {
            if (index >= scene.materials.size()) continue;
            const Material& soil = scene.materials[index];
            if (soil.strength && soil.strength->residual &&
                materials::has_strength_of_points(soil.law))
                continue;
            reader.add("/transfer/liquefied/regions/" + std::to_string(i),
                       "becomes \"" + soil.name +
                           "\", which has no residual strength, and no layers are given",
                       "give /transfer/liquefied/layers, or that mohr_coulomb material a strength "
                       "with a residual in place of its law's c_kPa and phi_deg");
        }
    }
}

std::vector<LiquefiedLine> lines_from(Reader& reader, const json& liquefied) {
    std::vector<LiquefiedLine> lines;
    for (std::size_t i = 0; i < liquefied.at("line").size(); ++i) {
        const json& each = liquefied.at("line")[i];
        const std::string pointer = "/transfer/liquefied/line/" + std::to_string(i);
        const std::vector<Vec2> points = line_from(reader, each.at("points"), pointer + "/points");
        const double time = each.at("transfer_time");
        if (std::ranges::find(lines, time, &LiquefiedLine::transfer_time) != lines.end())
            reader.add(pointer + "/transfer_time", "has a line already", "give one line per time");
        if (points.size() == 2) lines.push_back({time, {points[0], points[1]}});
    }
    return lines;
}

/// Refuses entries of columns where points decide, and the other way round.
void check_by(Reader& reader, const LiquefiedZone& zone) {
    const bool by_point = zone.by == LiquefiedBy::point;
    const auto refuse = [&](const char* key, const char* cause) {
        reader.add(std::string("/transfer/liquefied/") + key, cause,
                   by_point ? "leave it out, or set \"by\" to \"column\""
                            : "leave it out, or set \"by\" to \"point\"");
    };
    if (!by_point && zone.shear_strain)
        refuse("shear_strain", "belongs to single points, and columns decide here");
    if (!by_point) return;
    if (!zone.lines.empty()) refuse("line", "divides columns, and points decide here");
    if (zone.narrowest_wall > 0.0)
        refuse("narrowest_wall", "closes columns, and points decide here");
    if (zone.when == LiquefiedWhen::at_transfer)
        refuse("when", "is \"at_transfer\", and points keep their largest values only");
}

void read_liquefied(Reader& reader, Scene& scene, const json& transfer, Transfer& result) {
    if (!transfer.contains("liquefied")) return;
    const json& liquefied = transfer.at("liquefied");
    LiquefiedZone zone{.regions = {},
                       .r_u = liquefied.at("r_u"),
                       .when = word_at<LiquefiedWhen>(liquefied, "when"),
                       .by = word_at<LiquefiedBy>(liquefied, "by"),
                       .layers = {},
                       .narrowest_wall = liquefied.at("narrowest_wall")};
    for (std::size_t i = 0; i < liquefied.at("regions").size(); ++i) {
        const auto region =
            named(reader, scene.section.regions, liquefied.at("regions")[i],
                  "/transfer/liquefied/regions/" + std::to_string(i), "/section/regions");
        if (region) zone.regions.push_back(*region);
    }
    zone.lines = lines_from(reader, liquefied);
    if (liquefied.contains("shear_strain")) zone.shear_strain = liquefied.at("shear_strain");
    check_by(reader, zone);
    const auto s_r = strength_function(reader, scene, liquefied);
    if (liquefied.at("layers").empty()) check_residuals(reader, scene, liquefied, result, zone);
    double reached = 0.0;
    for (std::size_t i = 0; i < liquefied.at("layers").size(); ++i) {
        const json& layer = liquefied.at("layers")[i];
        const std::string pointer =
            "/transfer/liquefied/layers/" + std::to_string(i) + "/sigma_v0_kPa";
        const std::array<double, 2> sigma_v0{kPa * layer.at("sigma_v0_kPa")[0].get<double>(),
                                             kPa * layer.at("sigma_v0_kPa")[1].get<double>()};
        check_ascending(reader, sigma_v0, pointer);
        if (sigma_v0[0] != reached)
            reader.add(pointer, i == 0 ? "does not begin at 0" : "leaves a gap to the layer before",
                       "let the first layer begin at 0 and every other one where the last ended");
        reached = sigma_v0[1];
        const auto material = layer_material(reader, scene, layer, s_r, i, sigma_v0);
        if (material) zone.layers.push_back({sigma_v0[0], sigma_v0[1], *material});
    }
    result.liquefied = std::move(zone);
}

std::optional<AdviceWindow> window_from(const json& transfer) {
    if (!transfer.contains("window")) return std::nullopt;
    const json& window = transfer.at("window");
    return AdviceWindow{window.at("lower"), window.at("upper"), window.at("hold_s"),
                        window.at("pick")};
}

}  // namespace

void read_transfer(Reader& reader, Scene& scene) {
    if (!reader.sound("/transfer")) return;
    const json& transfer = reader.document().at("transfer");
    Transfer result{
        .points_per_direction = transfer.at("points_per_direction"),
        .interpolation = word_at<Interpolation>(transfer, "interpolation"),
        .neighbours = transfer.at("neighbours"),
        .entangled = word_at<Entangled>(transfer, "entangled"),
        .stress = word_at<TransferredStress>(transfer, "stress"),
        .base_displacement = word_at<BaseDisplacement>(transfer, "base_displacement"),
        .sigma_zz = word_at<OutOfPlaneStress>(transfer, "sigma_zz"),
        .largest_mass_loss = transfer.at("largest_mass_loss"),
        .largest_momentum_loss = transfer.at("largest_momentum_loss"),
        .largest_kinetic_energy_loss = transfer.at("largest_kinetic_energy_loss"),
        .window = window_from(transfer),
    };
    if (transfer.contains("points_per_cell")) {
        result.points_per_cell = transfer.at("points_per_cell").get<int>();
        if (!reader.document().contains("mpm"))
            reader.add("/transfer/points_per_cell", "needs the MPM's cells",
                       "give /mpm, or leave points_per_cell out");
    }
    if (result.sigma_zz == OutOfPlaneStress::zero && result.interpolation != Interpolation::paper)
        reader.add("/transfer/sigma_zz", "is zero only as the paper's transfer leaves it",
                   "set /transfer/interpolation to paper, or leave sigma_zz out");
    result.point_shift = range_from(transfer.at("point_shift"));
    if (result.points_per_direction < 2 && result.point_shift != std::array<double, 2>{})
        reader.add("/transfer/point_shift", "moves the only point of an element, which loses mass",
                   "give /transfer/points_per_direction 2 or more, or leave point_shift out");
    if (transfer.contains("phreatic_line"))
        result.phreatic_line =
            line_from(reader, transfer.at("phreatic_line"), "/transfer/phreatic_line");
    read_mapping(reader, scene, transfer, result);
    read_liquefied(reader, scene, transfer, result);
    scene.transfer = std::move(result);
}

std::vector<Soil> soils_of(const Scene& scene) {
    std::vector<Soil> soils;
    for (std::size_t r = 0; r < scene.section.regions.size(); ++r)
        soils.push_back({r, scene.section.regions[r].material});
    if (!scene.transfer) return soils;
    const Transfer& transfer = *scene.transfer;
    const auto add = [&](const Soil& soil) {
        if (std::ranges::find(soils, soil) == soils.end()) soils.push_back(soil);
    };
    for (const SoilMapping& each : transfer.mapping) soils[each.region].material = each.material;
    for (const SoilMapping& each : transfer.mapping)
        if (each.saturated) add({each.region, *each.saturated});
    if (!transfer.liquefied) return soils;
    for (const std::size_t region : transfer.liquefied->regions)
        for (const LiquefiedLayer& layer : transfer.liquefied->layers)
            add({region, layer.material});
    return soils;
}

}  // namespace breach::scene
