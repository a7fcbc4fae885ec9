// Reads /lem.
#include <algorithm>

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

void read_loads(Reader& reader, const Scene& scene, const json& lem, Lem& result) {
    for (const json& load : lem.at("surcharge")) {
        const std::string pointer = "/lem/surcharge/" + std::to_string(result.surcharge.size());
        check_ascending(reader, {load.at("from"), load.at("to")}, pointer);
        result.surcharge.push_back(
            {load.at("from"), load.at("to"), load.at("pressure_kPa").get<double>() * kPa});
    }
    for (std::size_t i = 0; i < lem.at("pore_pressure_ratios").size(); ++i) {
        const json& each = lem.at("pore_pressure_ratios")[i];
        const std::string pointer = "/lem/pore_pressure_ratios/" + std::to_string(i) + "/region";
        const auto region = region_named(reader, scene, each.at("region"), pointer);
        if (region) result.pore_pressure_ratios.push_back({*region, each.at("r_u")});
    }
}

Water water_from(Reader& reader, const Scene& scene, const json& water,
                 const std::string& pointer) {
    Water result{line_from(reader, water.at("line"), pointer + "/line"),
                 water.at("density"),
                 word_at<PhreaticCorrection>(water, "correction"),
                 {}};
    if (!water.contains("regions")) return result;
    for (std::size_t i = 0; i < water.at("regions").size(); ++i) {
        const auto region = region_named(reader, scene, water.at("regions")[i],
                                         pointer + "/regions/" + std::to_string(i));
        if (region) result.regions.push_back(*region);
    }
    return result;
}

/// Refuses several phreatic lines for a region.
void check_lines(Reader& reader, const Lem& lem) {
    std::vector<std::size_t> named;
    const auto check = [&](const Water& water, const std::string& pointer) {
        for (std::size_t i = 0; i < water.regions.size(); ++i) {
            if (std::find(named.begin(), named.end(), water.regions[i]) != named.end())
                reader.add(pointer + "/regions/" + std::to_string(i), "is named twice",
                           "give every region one line");
            named.push_back(water.regions[i]);
        }
    };
    if (lem.water) check(*lem.water, "/lem/water");
    for (std::size_t i = 0; i < lem.piezometric_lines.size(); ++i)
        check(lem.piezometric_lines[i], "/lem/piezometric_lines/" + std::to_string(i));
}

void read_water(Reader& reader, const Scene& scene, const json& lem, Lem& result) {
    if (lem.contains("water"))
        result.water = water_from(reader, scene, lem.at("water"), "/lem/water");
    for (const json& line : lem.at("piezometric_lines")) {
        const std::string pointer =
            "/lem/piezometric_lines/" + std::to_string(result.piezometric_lines.size());
        result.piezometric_lines.push_back(water_from(reader, scene, line, pointer));
    }
    check_lines(reader, result);
}

std::optional<double> number_in(const json& part, const char* key) {
    if (!part.contains(key)) return std::nullopt;
    return part.at(key).get<double>();
}

TensionCrack crack_from(Reader& reader, const json& crack) {
    TensionCrack result{number_in(crack, "depth"), number_in(crack, "level"), crack.at("filled")};
    if (result.depth.has_value() == result.level.has_value())
        reader.add("/lem/tension_crack",
                   result.depth ? "has a depth and a level" : "has neither a depth nor a level",
                   "give one of them");
    return result;
}

NonCircular non_circular_from(Reader& reader, const json& part) {
    NonCircular result{{}, part.at("vertices")};
    const std::string pointer = "/lem/non_circular";
    if (part.contains("given"))
        result.given = line_from(reader, part.at("given"), pointer + "/given");
    if (result.vertices > 0 && result.vertices < 4)
        reader.add(pointer + "/vertices", "are too few for a surface that can bend",
                   "give 4 or more, or 0 to optimise nothing");
    if (result.given.empty() && result.vertices == 0)
        reader.add(pointer, "has neither a given surface nor vertices", "give one of them");
    return result;
}

/// JSON pointers to the parts of a strength in /lem/<list>.
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

/// Strength by state needs a law with a state parameter and excludes other strengths.
void check_by_state(Reader& reader, const Scene& scene, std::size_t region,
                    const UndrainedStrength& strength, const std::string& pointer) {
    if (!strength.on_path) return;
    const std::size_t material = scene.section.regions[region].material;
    if (!materials::has_state_parameter(scene.materials[material].law))
        reader.add(pointer + "/norsand", "asks for NorSand's strength of a region without that law",
                   "set the material's law to norsand, or give a strength");
    if (strength.constant > 0.0 || strength.coefficient > 0.0)
        reader.add(pointer + "/norsand", "given together with a strength", "give one of the two");
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
        UndrainedStrength strength{each.at(keys.constant).get<double>() * kPa,
                                   each.at(keys.coefficient).get<double>() * kPa,
                                   each.at(keys.exponent)};
        if (each.contains("norsand"))
            strength.on_path = word_at<materials::OnPath>(each, "norsand");
        check_by_state(reader, scene, *region, strength, pointer);
        result.push_back({*region, strength, levels});
    }
    return result;
}

std::size_t layers_liquefied(Reader& reader, const json& part, const Lem& lem) {
    const std::size_t count = part.at("layers_liquefied");
    if (count > lem.liquefaction.size()) {
        reader.add("/lem/probability/layers_liquefied", "is more than /lem/liquefaction has",
                   "give at most " + std::to_string(lem.liquefaction.size()));
    }
    return count;
}

/// Index for RandomVariable::of.
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
        if (soil.limit_strength || soil.strength || materials::traits(soil.law).c_and_phi) {
            return material;
        }
        reader.add(pointer, "has no cohesion or friction",
                   "name a " + materials::types_of_laws_that(materials::has_c_and_phi) +
                       " material, or give it a limit_strength");
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

void read_probability(Reader& reader, const Scene& scene, const json& lem, Lem& result) {
    if (!lem.contains("probability")) return;
    const json& part = lem.at("probability");
    Probability probability{part.at("samples"),
                            part.at("seed"),
                            word_at<VariedSurface>(part, "surface"),
                            layers_liquefied(reader, part, result),
                            {}};
    for (std::size_t i = 0; i < part.at("variables").size(); ++i) {
        const json& each = part.at("variables")[i];
        const auto parameter = word_at<Parameter>(each, "parameter");
        const auto of = varied(reader, scene, result, parameter, each.at("of"),
                               "/lem/probability/variables/" + std::to_string(i) + "/of");
        if (!of) continue;
        probability.variables.push_back({parameter, *of,
                                         word_at<Distribution>(each, "distribution"),
                                         each.at("coefficient_of_variation")});
    }
    result.probability = std::move(probability);
}

/// Entry and exit may be points: from = to.
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
    read_water(reader, scene, lem, result);
    if (lem.contains("floor")) result.floor = line_from(reader, lem.at("floor"), "/lem/floor");
    if (lem.contains("tension_crack")) {
        result.tension_crack = crack_from(reader, lem.at("tension_crack"));
    }
    if (lem.contains("non_circular"))
        result.non_circular = non_circular_from(reader, lem.at("non_circular"));
    result.undrained = undrained_from(reader, scene, lem,
                                      {"undrained", "strength_kPa", "coefficient_kPa", "exponent"});
    result.liquefaction = undrained_from(
        reader, scene, lem,
        {"liquefaction", "residual_strength_kPa", "residual_coefficient_kPa", "residual_exponent"});
    for (std::size_t i = 0; i < lem.at("unconsolidated").size(); ++i) {
        const auto region = region_named(reader, scene, lem.at("unconsolidated")[i],
                                         "/lem/unconsolidated/" + std::to_string(i));
        if (region) result.unconsolidated.push_back(*region);
    }
    read_probability(reader, scene, lem, result);
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
