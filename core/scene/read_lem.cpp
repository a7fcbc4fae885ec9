// What lem_tool does with the scene: /lem.
#include "core/scene/checks.hpp"

namespace breach::scene {

using nlohmann::json;

namespace {

template <class List>
std::optional<std::size_t> index_of(Reader& reader, const List& list, const json& name,
                                    const std::string& pointer, const std::string& remedy) {
    if (!reader.sound("/section") || !reader.sound("/materials")) return std::nullopt;
    for (std::size_t i = 0; i < list.size(); ++i) {
        if (json(list[i].name) == name) return i;
    }
    reader.add(pointer, "is " + name.dump() + ", which does not exist", remedy);
    return std::nullopt;
}

std::optional<std::size_t> region_named(Reader& reader, const Scene& scene, const json& name,
                                        const std::string& pointer) {
    return index_of(reader, scene.section.regions, name, pointer,
                    "give the name of one of /section/regions");
}

constexpr double kPa = 1e3;
constexpr double kN = 1e3;

void read_loads(Reader& reader, const Scene& scene, const json& lem, Lem& result) {
    for (const json& load : lem.at("surcharge")) {
        const std::string pointer = "/lem/surcharge/" + std::to_string(result.surcharge.size());
        check_ascending(reader, {load.at("from"), load.at("to")}, pointer);
        result.surcharge.push_back(
            {load.at("from"), load.at("to"), load.at("pressure_kPa").get<double>() * kPa});
    }
    for (const json& load : lem.at("line_loads")) {
        result.line_loads.push_back({load.at("x"), load.at("down_kN").get<double>() * kN,
                                     load.at("right_kN").get<double>() * kN});
    }
    for (std::size_t i = 0; i < lem.at("pore_pressure_ratios").size(); ++i) {
        const json& each = lem.at("pore_pressure_ratios")[i];
        const std::string pointer = "/lem/pore_pressure_ratios/" + std::to_string(i) + "/region";
        const auto region = region_named(reader, scene, each.at("region"), pointer);
        if (region) result.pore_pressure_ratios.push_back({*region, each.at("r_u")});
    }
    if (lem.contains("water")) {
        const json& water = lem.at("water");
        result.water = Water{
            line_from(reader, water.at("line"), "/lem/water/line"), water.at("density"),
            water.at("correction") == "cos2" ? PhreaticCorrection::cos2 : PhreaticCorrection::none};
    }
}

/// Where the entry of /lem/<list> keeps the parts of its strength.
struct StrengthKeys {
    const char* list;
    const char* constant;
    const char* coefficient;
    const char* exponent;
};

std::optional<std::array<double, 2>> levels_from(Reader& reader, const json& entry,
                                                 const std::string& pointer) {
    if (!entry.contains("levels")) return std::nullopt;
    const std::array<double, 2> levels = range_from(entry.at("levels"));
    if (levels[0] >= levels[1]) {
        reader.add(pointer + "/levels", "is not ascending", "write [lower level, upper level]");
    }
    return levels;
}

std::vector<UndrainedRegion> undrained_from(Reader& reader, const Scene& scene, const json& lem,
                                            const StrengthKeys& keys) {
    std::vector<UndrainedRegion> result;
    for (std::size_t i = 0; i < lem.at(keys.list).size(); ++i) {
        const json& each = lem.at(keys.list)[i];
        const std::string pointer = "/lem/" + std::string(keys.list) + "/" + std::to_string(i);
        const auto region = region_named(reader, scene, each.at("region"), pointer + "/region");
        if (!region) continue;
        const auto levels = levels_from(reader, each, pointer);
        for (const UndrainedRegion& other : result) {
            if (other.region != *region || (levels && other.levels)) continue;
            reader.add(pointer + "/region", "is named twice",
                       "give every region once, or the levels of its layers");
        }
        result.push_back({*region,
                          {each.at(keys.constant).get<double>() * kPa,
                           each.at(keys.coefficient).get<double>() * kPa, each.at(keys.exponent)},
                          levels});
    }
    return result;
}

VariedSurface varied_surface(const json& part) {
    return part.at("surface") == "fixed" ? VariedSurface::fixed : VariedSurface::searched;
}

std::size_t layers_liquefied(Reader& reader, const json& part, const Lem& lem,
                             const std::string& pointer) {
    const std::size_t count = part.at("layers_liquefied");
    if (count > lem.liquefaction.size()) {
        reader.add(pointer + "/layers_liquefied", "is more than /lem/liquefaction has",
                   "give at most " + std::to_string(lem.liquefaction.size()));
    }
    return count;
}

Parameter parameter_from(const std::string& text) {
    if (text == "cohesion") return Parameter::cohesion;
    if (text == "friction_angle") return Parameter::friction_angle;
    if (text == "density") return Parameter::density;
    if (text == "undrained_strength") return Parameter::undrained_strength;
    if (text == "residual_strength") return Parameter::residual_strength;
    return Parameter::seismic_coefficient;
}

/// What `of` counts: see RandomVariable.
std::optional<std::size_t> varied(Reader& reader, const Scene& scene, const Lem& lem,
                                  Parameter parameter, const json& name,
                                  const std::string& pointer) {
    if (parameter == Parameter::seismic_coefficient) return std::size_t{0};
    const bool of_region =
        parameter == Parameter::undrained_strength || parameter == Parameter::residual_strength;
    if (!of_region) {
        const auto material =
            index_of(reader, scene.materials, name, pointer, "give the name of one of /materials");
        if (!material || parameter == Parameter::density) return material;
        const Material& soil = scene.materials[*material];
        if (soil.limit_strength || materials::traits(soil.law).c_and_phi) {
            return material;
        }
        reader.add(pointer, "has no cohesion or friction",
                   "name a Mohr-Coulomb material, or give it a limit_strength");
        return std::nullopt;
    }
    const auto region = region_named(reader, scene, name, pointer);
    const auto& list =
        parameter == Parameter::undrained_strength ? lem.undrained : lem.liquefaction;
    const auto is_meant = [&](const UndrainedRegion& each) { return each.region == *region; };
    const auto entries = region ? std::count_if(list.begin(), list.end(), is_meant) : 0;
    if (entries == 1) return std::find_if(list.begin(), list.end(), is_meant) - list.begin();
    if (entries > 1) {
        reader.add(pointer, "names a region of several layers",
                   "make the layer a region of its own to vary it");
    } else if (region) {
        reader.add(pointer, "has no such strength",
                   "name a region of /lem/undrained (undrained_strength) or /lem/liquefaction "
                   "(residual_strength)");
    }
    return std::nullopt;
}

void read_variations(Reader& reader, const Scene& scene, const json& lem, Lem& result) {
    if (lem.contains("sensitivity")) {
        const json& part = lem.at("sensitivity");
        result.sensitivity =
            Sensitivity{part.at("change"), varied_surface(part),
                        layers_liquefied(reader, part, result, "/lem/sensitivity")};
    }
    if (!lem.contains("probability")) return;
    const json& part = lem.at("probability");
    Probability probability{part.at("samples"),
                            part.at("seed"),
                            varied_surface(part),
                            layers_liquefied(reader, part, result, "/lem/probability"),
                            {}};
    for (std::size_t i = 0; i < part.at("variables").size(); ++i) {
        const json& each = part.at("variables")[i];
        const Parameter parameter = parameter_from(each.at("parameter"));
        const auto of = varied(reader, scene, result, parameter, each.at("of"),
                               "/lem/probability/variables/" + std::to_string(i) + "/of");
        if (!of) continue;
        probability.variables.push_back(
            {parameter, *of,
             each.at("distribution") == "normal" ? Distribution::normal : Distribution::lognormal,
             each.at("coefficient_of_variation")});
    }
    result.probability = std::move(probability);
}

/// Entry and exit may also be points.
void check_end_range(Reader& reader, const std::array<double, 2>& range,
                     const std::string& pointer) {
    if (range[0] > range[1]) reader.add(pointer, "is not ascending", "write [from, to]");
}

SlipSearch search_from(Reader& reader, const json& search) {
    SlipSearch result{.entry = range_from(search.at("entry")),
                      .exit = range_from(search.at("exit")),
                      .entry_points = search.at("entry_points"),
                      .exit_points = search.at("exit_points"),
                      .depths = search.at("depths"),
                      .minimum_depth = search.at("minimum_depth")};
    if (search.contains("lowest_level")) {
        result.lowest_level = search.at("lowest_level").get<double>();
    }
    check_end_range(reader, result.entry, "/lem/search/entry");
    check_end_range(reader, result.exit, "/lem/search/exit");
    return result;
}

}  // namespace

void read_lem(Reader& reader, Scene& scene) {
    if (!reader.sound("/lem")) return;
    const json& lem = reader.document().at("lem");
    Lem result{};
    result.slices = lem.at("slices");
    result.seismic_coefficient = lem.at("seismic_coefficient");
    read_loads(reader, scene, lem, result);
    if (lem.contains("floor")) result.floor = line_from(reader, lem.at("floor"), "/lem/floor");
    if (lem.contains("tension_crack")) {
        result.tension_crack =
            TensionCrack{lem.at("tension_crack").at("depth"), lem.at("tension_crack").at("filled")};
    }
    result.undrained = undrained_from(reader, scene, lem,
                                      {"undrained", "strength_kPa", "coefficient_kPa", "exponent"});
    result.liquefaction = undrained_from(
        reader, scene, lem,
        {"liquefaction", "residual_strength_kPa", "residual_coefficient_kPa", "residual_exponent"});
    read_variations(reader, scene, lem, result);
    if (lem.contains("circle")) {
        result.circle =
            Circle{point_from(lem.at("circle").at("center")), lem.at("circle").at("radius")};
    }
    if (lem.contains("search")) result.search = search_from(reader, lem.at("search"));
    if (!result.circle && !result.search) {
        reader.add("/lem", "has neither a circle nor a search", "give one of them, or both");
    }
    if (!result.liquefaction.empty() && !result.search) {
        reader.add("/lem/liquefaction", "needs a search: every stage has its own critical circle",
                   "give /lem/search");
    }
    scene.lem = std::move(result);
}

}  // namespace breach::scene
