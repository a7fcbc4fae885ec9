// Reads /fem.
#include <algorithm>
#include <functional>
#include <numbers>

#include "core/scene/checks.hpp"
#include "core/scene/file_paths.hpp"
#include "core/words/milliseconds.hpp"

namespace breach::scene {

using nlohmann::json;

namespace {

std::optional<double> if_given(const json& entry, const char* key) {
    return entry.contains(key) ? std::optional<double>(entry.at(key)) : std::nullopt;
}

Stage stage_from(const json& stage) {
    const auto kind = word_at<StageKind>(stage, "type");
    const auto laws = word_at<StageLaws>(stage, "laws");
    const auto permeability = word_at<StagePermeability>(stage, "permeability");
    if (kind == StageKind::static_equilibrium) {
        return {.name = stage.at("name"),
                .kind = kind,
                .laws = laws,
                .permeability = permeability,
                .load_steps = stage.at("load_steps")};
    }
    return {.name = stage.at("name"),
            .kind = kind,
            .laws = laws,
            .permeability = permeability,
            .duration = stage.at("duration"),
            .time_step = stage.at("time_step"),
            .least_time_step = stage.at("least_time_step")};
}

/// Index of `name` in the list; adds a fault and returns the list's size if it is missing.
template <class Named>
std::size_t named_at(Reader& reader, const std::vector<Named>& all, const std::string& name,
                     const std::string& pointer, const std::string& list) {
    const auto found =
        std::ranges::find_if(all, [&](const Named& each) { return each.name == name; });
    if (found == all.end())
        reader.add(pointer, "names \"" + name + "\", which " + list + " does not have",
                   "name one of " + list);
    return static_cast<std::size_t>(found - all.begin());
}

std::vector<Surcharge> loads_from(Reader& reader, const json& loads, const std::string& list) {
    std::vector<Surcharge> result;
    for (const json& load : loads) {
        check_ascending(reader, {load.at("from"), load.at("to")},
                        list + "/" + std::to_string(result.size()));
        result.push_back(
            {load.at("from"), load.at("to"), 1e3 * load.at("pressure_kPa").get<double>()});
    }
    return result;
}

std::vector<PressureBoundary> boundaries_from(const json& boundaries) {
    std::vector<PressureBoundary> result;
    for (const json& each : boundaries)
        result.push_back({each.at("name"), point_from(each.at("from")), point_from(each.at("to")),
                          if_given(each, "level")});
    return result;
}

/// One number for the stage, or by region or material; a region's number takes precedence.
void read_softening(Reader& reader, const Scene& scene, const json& entry,
                    const std::string& pointer, Stage& stage) {
    if (!entry.contains("S")) return;
    const json& S = entry.at("S");
    if (S.is_number()) {
        stage.S = S.get<double>();
        return;
    }
    const auto& regions = scene.section.regions;
    stage.S_of_region.resize(regions.size());
    for (const bool by_material : {true, false}) {
        for (const auto& [name, value] : S.items()) {
            bool found = false;
            for (std::size_t r = 0; r < regions.size(); ++r) {
                const std::size_t material = regions[r].material;
                const bool made_of_it =
                    material < scene.materials.size() && scene.materials[material].name == name;
                found = found || made_of_it || regions[r].name == name;
                if (by_material ? made_of_it : regions[r].name == name)
                    stage.S_of_region[r] = value.get<double>();
            }
            if (!found && by_material)
                reader.add(pointer + "/S/" + name,
                           "names \"" + name + "\", which is no region and no region's material",
                           "name a region of /section/regions, or the material of one");
        }
    }
}

/// Reads a stage's pressures and displacements.
void read_edges(Reader& reader, const json& entry, const std::string& pointer, Stage& stage) {
    for (const json& each : entry.value("displace", json::array())) {
        const std::string here =
            pointer + "/displace/" + std::to_string(stage.displacements.size());
        stage.displacements.push_back({each.at("name"), point_from(each.at("from")),
                                       point_from(each.at("to")), if_given(each, "x"),
                                       if_given(each, "y")});
        if (!each.contains("x") && !each.contains("y"))
            reader.add(here, "moves in no direction", "give x, y or both");
    }
    if (!entry.contains("pressures")) return;
    stage.pressures.emplace();
    for (const json& each : entry.at("pressures"))
        stage.pressures->push_back({each.at("name"), point_from(each.at("from")),
                                    point_from(each.at("to")),
                                    1e3 * each.at("pressure_kPa").get<double>()});
}

/// Reads a stage's changes of regions, supports and loads.
void read_changes(Reader& reader, const Scene& scene, const std::vector<Support>& supports,
                  const json& entry, const std::string& pointer, Stage& stage) {
    const auto names = [&](const char* key, const auto& all, const char* list) {
        std::vector<std::size_t> found;
        if (!entry.contains(key)) return found;
        for (const json& name : entry.at(key)) {
            const std::string here = pointer + "/" + key + "/" + std::to_string(found.size());
            found.push_back(named_at(reader, all, name, here, list));
        }
        return found;
    };
    stage.activates = names("activate", scene.section.regions, "/section/regions");
    stage.removes = names("remove", scene.section.regions, "/section/regions");
    stage.releases = names("release", supports, "/fem/supports");
    if (entry.contains("surcharge"))
        stage.surcharge = loads_from(reader, entry.at("surcharge"), pointer + "/surcharge");
    if (entry.contains("phreatic_line"))
        stage.phreatic_line =
            line_from(reader, entry.at("phreatic_line"), pointer + "/phreatic_line");
    stage.undrained = names("undrained", scene.section.regions, "/section/regions");
    stage.seismic_coefficient = if_given(entry, "seismic_coefficient");
    read_edges(reader, entry, pointer, stage);
    read_softening(reader, scene, entry, pointer, stage);
    if (entry.contains("ramp")) stage.ramp = entry.at("ramp");
    stage.goes_on_at_limit = entry.value("at_limit", "stop") == "go_on";
}

Support support_from(const json& support) {
    const std::string fixes = support.at("fixes");
    return {.name = support.at("name"),
            .from = point_from(support.at("from")),
            .to = point_from(support.at("to")),
            .fixes_x = fixes != "y",
            .fixes_y = fixes != "x"};
}

GroundWater water_from(Reader& reader, const json& water) {
    GroundWater result{
        .line = line_from(reader, water.at("line"), "/fem/water/line"),
        .density = water.at("density"),
        .bulk_modulus = 1e6 * water.at("bulk_modulus_MPa").get<double>(),
        .above = word_at<AboveWater>(water, "above"),
        .pressure_stabilisation = water.at("pressure_stabilisation"),
        .pressure_integration = word_at<PressureIntegration>(water, "pressure_integration"),
        .boundaries = boundaries_from(water.at("boundaries"))};
    return result;
}

ElasticBase base_from(const json& base) {
    return {base.at("density"), base.at("V_s"), word_at<MotionAt>(base, "motion_at")};
}

BaseMotion motion_from(const std::filesystem::path& folder, const json& motion) {
    BaseMotion result{file_at(folder, motion.at("file").get<std::string>()), std::nullopt,
                      word_at<Baseline>(motion, "baseline"), motion.at("reversed")};
    if (motion.contains("scale_to_pga_g")) {
        result.scale_to_pga_g = motion.at("scale_to_pga_g").get<double>();
    }
    return result;
}

FreeField free_field_from(const json& field) {
    return {field.at("width"), field.at("thickness_factor"),
            word_at<FreeFieldSides>(field, "sides")};
}

/// Reads water, base, motion, free-field columns and loads.
void read_surroundings(Reader& reader, const std::filesystem::path& folder, const json& fem,
                       Fem& result) {
    if (fem.contains("water")) result.water = water_from(reader, fem.at("water"));
    if (fem.contains("base")) result.base = base_from(fem.at("base"));
    if (fem.contains("motion")) {
        result.motion = motion_from(folder, fem.at("motion"));
        if (!result.base) {
            reader.add("/fem/motion", "has no base that it could come through",
                       "give /fem/base, the rock below the mesh");
        }
    }
    if (fem.contains("free_field")) result.free_field = free_field_from(fem.at("free_field"));
    result.surcharge = loads_from(reader, fem.at("surcharge"), "/fem/surcharge");
}

void check_fem(Reader& reader, const Scene& scene, const Fem& fem) {
    const double span = fem.duration();
    bool moving = false;
    for (std::size_t i = 0; i < fem.stages.size(); ++i) {
        const Stage& stage = fem.stages[i];
        const std::string pointer = "/fem/stages/" + std::to_string(i);
        if (stage.kind == StageKind::static_equilibrium && moving) {
            reader.add(pointer, "is a static stage after a dynamic one", "put static stages first");
        }
        if (stage.goes_on_at_limit &&
            (i + 1 == fem.stages.size() || fem.stages[i + 1].kind != StageKind::dynamic)) {
            reader.add(pointer + "/at_limit", "goes on, but no dynamic stage follows",
                       "put a dynamic stage behind it, in which the failure runs");
        }
        moving = moving || stage.kind == StageKind::dynamic;
        if (stage.kind == StageKind::dynamic && stage.least_time_step > stage.time_step) {
            reader.add(pointer + "/least_time_step", "is above time_step", "give a smaller one");
        }
    }
    if (!fem.snapshot_times.empty() && fem.snapshot_times.back() > span * (1 + 1e-12)) {
        const std::string in_ms = words::seconds_remedy(fem.snapshot_times.back(), span);
        reader.add("/fem/snapshot_times", "reach beyond the end of the dynamic stages",
                   in_ms.empty() ? "lengthen the last stage, or drop the later times" : in_ms);
    }
    const double stable = 0.25 * (fem.newmark_gamma + 0.5) * (fem.newmark_gamma + 0.5);
    if (fem.newmark_beta < stable - 1e-12) {
        reader.add("/fem/newmark_beta", "makes the scheme unstable at large steps",
                   "give at least (newmark_gamma + 0.5)^2 / 4 = " + std::to_string(stable));
    }
    if (fem.mesh.msh_file) return;
    for (std::size_t i = 0; i < scene.section.regions.size(); ++i) {
        const std::string pointer = "/section/regions/" + std::to_string(i);
        if (reader.document().at(json::json_pointer(pointer)).contains("mesh")) continue;
        reader.add(pointer, "lacks \"mesh\", which the FEM needs",
                   "add a block or unstructured mesh, or give /fem/msh_file");
    }
}

std::optional<LiquefactionWatch> liquefaction_from(Reader& reader, const Scene& scene,
                                                   const json& fem) {
    if (!fem.contains("liquefaction")) return std::nullopt;
    const json& watch = fem.at("liquefaction");
    LiquefactionWatch result{.regions = {},
                             .x = range_from(watch.at("x")),
                             .level = watch.at("level"),
                             .r_u = watch.at("r_u"),
                             .least_stress = 1e3 * watch.at("least_stress_kPa").get<double>()};
    for (std::size_t i = 0; i < watch.at("regions").size(); ++i) {
        const auto& regions = scene.section.regions;
        const std::string name = watch.at("regions")[i];
        const auto found = std::find_if(regions.begin(), regions.end(),
                                        [&](const Region& each) { return each.name == name; });
        if (found == regions.end()) {
            reader.add("/fem/liquefaction/regions/" + std::to_string(i),
                       "names \"" + name + "\", which /section/regions does not have",
                       "name a region that can liquefy");
        }
        result.regions.push_back(static_cast<std::size_t>(found - regions.begin()));
    }
    if (result.x[0] >= result.x[1]) {
        reader.add("/fem/liquefaction/x", "is not ascending", "write [from, to]");
    }
    if (!fem.contains("water")) {
        reader.add("/fem/liquefaction", "needs pore water", "add /fem/water, or leave this out");
    }
    return result;
}

/// The ratio at the frequency f is beta pi f.
void read_damping(Reader& reader, const json& damping, Fem& fem) {
    if (fem.rayleigh_stiffness > 0.0)
        reader.add("/fem/damping", "and /fem/rayleigh_stiffness are the same damping twice",
                   "give one of them");
    fem.damping_frequency = damping.at("frequency_Hz").get<double>();
    fem.rayleigh_stiffness =
        damping.at("ratio").get<double>() / (std::numbers::pi * *fem.damping_frequency);
}

}  // namespace

void read_fem(Reader& reader, const std::filesystem::path& folder, Scene& scene) {
    if (!reader.sound("/fem")) return;
    const json& fem = reader.document().at("fem");
    Fem result{};
    result.element = word_at<ElementKind>(fem, "element");
    result.hourglass = word_at<HourglassKind>(fem, "hourglass");
    if (fem.contains("msh_file")) {
        result.mesh.msh_file = file_at(folder, fem.at("msh_file").get<std::string>());
    }
    for (const json& each : fem.at("supports")) result.supports.push_back(support_from(each));
    for (const json& each : fem.at("stages")) {
        const std::string pointer = "/fem/stages/" + std::to_string(result.stages.size());
        result.stages.push_back(stage_from(each));
        read_changes(reader, scene, result.supports, each, pointer, result.stages.back());
    }
    read_surroundings(reader, folder, fem, result);
    result.largest_step_error = fem.at("largest_step_error");
    result.newmark_beta = fem.at("newmark_beta");
    result.newmark_gamma = fem.at("newmark_gamma");
    result.rayleigh_mass = fem.at("rayleigh_mass");
    result.rayleigh_stiffness = fem.at("rayleigh_stiffness");
    if (fem.contains("damping")) read_damping(reader, fem.at("damping"), result);
    result.force_tolerance = fem.at("force_tolerance");
    result.largest_iterations = fem.at("largest_iterations");
    result.least_jacobian_ratio = fem.at("least_jacobian_ratio");
    result.crest = point_from(fem.at("crest"));
    result.strain_threshold = fem.at("strain_threshold");
    result.liquefaction = liquefaction_from(reader, scene, fem);
    result.failure_strain = fem.at("failure_surfaces").at("epsilon_q");
    result.failure_separation = fem.at("failure_surfaces").at("separation");
    result.snapshot_times = fem.at("snapshot_times").get<std::vector<double>>();
    result.snapshot_interval = fem.at("snapshot_interval");
    result.telemetry_interval = fem.at("telemetry_interval");
    result.strength_interval = if_given(fem, "strength_interval");
    check_order(reader, result.snapshot_times, std::less<>(), "/fem/snapshot_times",
                "list the times in ascending order, each once");
    check_fem(reader, scene, result);
    scene.fem = std::move(result);
}

}  // namespace breach::scene
