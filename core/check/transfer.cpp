#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "core/check/measured.hpp"
#include "core/check/section.hpp"
#include "core/check/subjects.hpp"
#include "core/criteria/expression.hpp"
#include "core/scene/ground.hpp"
#include "core/telemetry/columns.hpp"
#include "core/words/number.hpp"

namespace breach::check {

namespace {

std::vector<std::string> recorded_fields() {
    std::vector<std::string> names;
    for (const telemetry::Column& column : telemetry::fem_columns())
        names.emplace_back(column.name);
    return names;
}

void check_window(const scene::Scene& scene, Problems& problems) {
    const scene::AdviceWindow& window = *scene.transfer->window;
    const std::vector<std::string> known = recorded_fields();
    const auto look = [&](const std::string& condition, const std::string& pointer) {
        try {
            const criteria::Expression parsed =
                criteria::parse(condition, criteria::Kind::condition, pointer, known);
            if (!scene.fem) return;
            std::ranges::move(unmeasured(parsed.fields, scene, pointer),
                              std::back_inserter(problems.faults));
        } catch (const fault::BadInput& error) {
            for (const fault::Fault& each : error.faults()) problems.faults.push_back(each);
        }
    };
    look(window.lower, "/transfer/window/lower");
    look(window.upper, "/transfer/window/upper");
}

/// Effective stress without pore pressure is refused: material points would lose the pore pressure.
void check_stress(const scene::Scene& scene, Problems& problems) {
    if (scene.transfer->stress != scene::TransferredStress::effective) return;
    if (!scene.mpm || !scene.fem || !scene.fem->water) return;
    for (const scene::Soil& soil : scene::soils_of(scene)) {
        if (soil.material >= scene.materials.size()) continue;
        const scene::Material& material = scene.materials[soil.material];
        const bool frictional =
            materials::is_for_particles(material.law) && materials::traits(material.law).frictional;
        if (!frictional) continue;
        refuse(problems, "/transfer/stress",
               "is effective, and \"" + material.name +
                   "\" has friction: its points would come with pore pressure, which the MPM does "
                   "not carry",
               "transfer total stress (\"total\"), or leave out /fem/water");
        return;
    }
}

/// Points that fill the section have one material per region. Warns of entries that only a transfer
/// applies.
void warn_about_what_a_transfer_decides(const scene::Scene& scene, Problems& problems) {
    if (scene.fem || !scene.mpm) return;
    const scene::Transfer& transfer = *scene.transfer;
    if (transfer.liquefied)
        warn(problems, "needs_fem", "/transfer/liquefied",
             "asks what has liquefied in an FEM, and the scene has none: in points that fill the "
             "section nothing has; map the region to its liquefied material");
    for (std::size_t i = 0; i < transfer.mapping.size(); ++i)
        if (transfer.mapping[i].saturated)
            warn(problems, "needs_fem", "/transfer/mapping/" + std::to_string(i) + "/saturated",
                 "is used by a transfer alone, and the scene has no FEM: points that fill the "
                 "section become \"to\" everywhere; draw what lies below the line as a region of "
                 "its own");
}

materials::Strength strength_of(const scene::Material& material) {
    if (materials::has_strength_of_points(material.law) && material.strength)
        return materials::strength_at(material.strength->peak, {10.0, 0.0, 1e5});
    return materials::limit_strength(material.law).value_or(materials::Strength{0.0, 0.0});
}

/// The phreatic line of a scene without FEM, from /lem or the mapping.
const std::vector<Vec2>* water_table_of(const scene::Scene& scene) {
    if (scene.transfer && !scene.transfer->phreatic_line.empty())
        return &scene.transfer->phreatic_line;
    const bool everywhere = scene.lem && scene.lem->water && scene.lem->water->regions.empty() &&
                            !scene.lem->water->line.empty();
    return everywhere ? &scene.lem->water->line : nullptr;
}

double degrees(double tan_phi) { return std::atan(tan_phi) * 180.0 / std::numbers::pi; }

/// Warns of friction below the water table with total stress: the water pressure adds to it, so
/// slopes that fail in limit equilibrium may stand. Friction that is reduced for the pore pressure
/// on the region's base, below that of limit_strength, is sound. After a FEM, liquefied soil is
/// flagged instead.
void warn_about_friction_under_water(const scene::Scene& scene,
                                     const std::vector<scene::Soil>& soils, Problems& problems) {
    if (scene.fem || !is_whole(scene) || (scene.mpm && scene.mpm->water)) return;
    const std::vector<Vec2>* line = water_table_of(scene);
    if (line == nullptr) return;
    const scene::Ground ground(scene);
    std::vector<std::size_t> told;
    for (std::size_t r = 0; r < scene.section.regions.size(); ++r) {
        const scene::Region& region = scene.section.regions[r];
        const std::size_t become = soils[r].material;
        if (become >= scene.materials.size()) continue;
        const scene::Material& material = scene.materials[become];
        const materials::Strength strength = strength_of(material);
        if (std::ranges::find(told, become) != told.end() || strength.tan_phi == 0.0) continue;
        if (!scene::is_below_water(scene.section, region, *line)) continue;
        const Depth deepest = deepest_below(region.polygon, *line, level_at);
        const auto& limit = scene.materials[region.material].limit_strength;
        const double drained = limit ? std::tan(limit->phi) : strength.tan_phi;
        const double r_u = ground.r_u_at_base(r), sound = (1.0 - r_u) * drained;
        constexpr double rounding = 1.01;
        if (limit && strength.tan_phi <= rounding * sound) continue;
        told.push_back(become);
        const double c = limit ? limit->c : strength.c;
        warn(problems, "total_stress", "/materials/" + material.name,
             "has friction, and \"" + region.name + "\" reaches " + metres(deepest.below) +
                 " below the water table: material points carry no pore pressure, so that friction "
                 "acts on the total stress there and the soil is too strong; give it the friction "
                 "that the pore pressure on its base leaves (r_u = " +
                 words::text_of(r_u, 2) +
                 "), \"phi_deg\": " + words::text_of(std::floor(10.0 * degrees(sound)) / 10.0) +
                 ", and the LEM \"limit_strength\": {\"c_kPa\": " + text(c / 1e3) +
                 ", \"phi_deg\": " + words::text_of(degrees(drained), 4) +
                 "}; or give what flows an undrained strength (\"phi_deg\": 0)");
    }
}

/// Warns of standing water whose line falls steeply within frictional soil: below it the pressure
/// is hydrostatic and pushes sideways with the whole slope, more than seepage does. A FEM gives the
/// pressure of seepage instead.
void warn_about_steep_pool(const scene::Scene& scene, const std::vector<scene::Soil>& soils,
                           Problems& problems) {
    if (scene.fem || !scene.mpm || !scene.mpm->water || !is_whole(scene)) return;
    constexpr double steep = 0.5;
    const std::vector<Vec2>& line = scene.mpm->water->line;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Vec2 middle = 0.5 * (line[i] + line[i + 1]), run = line[i + 1] - line[i];
        if (std::abs(run.y()) <= steep * run.x()) continue;
        for (std::size_t r = 0; r < scene.section.regions.size(); ++r) {
            const scene::Region& region = scene.section.regions[r];
            if (soils[r].material >= scene.materials.size() ||
                strength_of(scene.materials[soils[r].material]).tan_phi == 0.0 ||
                !geometry::contains(region.polygon, middle))
                continue;
            warn(problems, "steep_water", "/mpm/water/line",
                 "falls by " + metres(std::abs(run.y())) + " over " + metres(run.x()) +
                     " in the frictional soil \"" + region.name +
                     "\": hydrostatic pressure below it pushes sideways by that slope, more than "
                     "seepage does, and the dry side may fail by it; run an FEM with /fem/water, "
                     "whose seepage the transfer brings, or let the line fall over the whole dam");
            return;
        }
    }
}

/// Largest depth of free water [m].
double deepest_pond(const scene::Scene& scene, const std::vector<Vec2>& line) {
    const geometry::Box box = extent(scene.section);
    const double near = 1e-6 * (box.high.x() - box.low.x());
    std::vector<double> xs = abscissae(scene.section);
    for (const Vec2& each : line) xs.push_back(each.x());
    double deepest = 0.0;
    for (const double at : xs)
        for (const double x : {at - near, at + near})  // top and bottom of a vertical face
            if (const double ground = ground_at(scene.section, x); std::isfinite(ground))
                deepest = std::max(deepest, level_at(line, x) - ground);
    return deepest;
}

/// Warns of FEM loads that do not act in the runout.
void warn_about_loads_that_end(const scene::Scene& scene, Problems& problems) {
    if (!scene.fem || !scene.mpm) return;
    const scene::Fem& fem = *scene.fem;
    const auto tell = [&](const std::string& pointer, const std::string& what) {
        warn(problems, "load_ends", pointer,
             what +
                 " ends at the transfer: material points run out under gravity alone; what goes "
                 "with the soil must be drawn as soil");
    };
    std::string of_surcharge = "/fem/surcharge", of_pressures;
    bool loaded = !fem.surcharge.empty(), pressed = false;
    for (std::size_t s = 0; s < fem.stages.size(); ++s) {
        const scene::Stage& stage = fem.stages[s];
        const auto take = [&](const auto& given, const char* name, bool& acts, std::string& where) {
            if (!given) return;
            acts = !given->empty();
            where = "/fem/stages/" + std::to_string(s) + name;
        };
        take(stage.surcharge, "/surcharge", loaded, of_surcharge);
        take(stage.pressures, "/pressures", pressed, of_pressures);
    }
    if (loaded) tell(of_surcharge, "the surcharge");
    if (pressed) tell(of_pressures, "the pressure on the edges");
    if (!fem.water || fem.stages.empty()) return;
    const geometry::Box box = extent(scene.section);
    const double shallow = 0.02 * (box.high.y() - box.low.y());
    const double pond = deepest_pond(scene, fem.water_in(fem.stages.size() - 1)->line);
    if (pond > shallow && !scene.mpm->water)
        warn(problems, "load_ends", "/fem/water/line",
             "free water up to " + metres(pond) +
                 " deep ends at the transfer: the runout is in air; draw it as /mpm/water to keep "
                 "its pressure");
}

/// Warns of a mapping to a material of another density: points keep their mass.
void warn_about_densities(const scene::Scene& scene, const std::vector<scene::Soil>& soils,
                          Problems& problems) {
    std::vector<std::size_t> told;
    for (const scene::Soil& soil : soils) {
        const scene::Material* own = material_of(scene, scene.section.regions[soil.region]);
        if (own == nullptr || soil.material >= scene.materials.size()) continue;
        const scene::Material& become = scene.materials[soil.material];
        if (std::abs(become.density - own->density) <= 1e-3 * own->density) continue;
        if (std::ranges::find(told, soil.material) != told.end()) continue;
        told.push_back(soil.material);
        warn(problems, "unused_density", "/materials/" + become.name + "/density",
             "is not used in \"" + scene.section.regions[soil.region].name +
                 "\": points keep the mass of \"" + own->name + "\", " + text(own->density) +
                 " kg/m3, which the region is drawn of");
    }
}

}  // namespace

void check_soils(const scene::Scene& scene, Problems& problems) {
    // /transfer always exists by default: the MPM or a mapping shows that points are used.
    if (!scene.mpm && (!scene.transfer || scene.transfer->mapping.empty())) return;
    const std::vector<scene::Soil> soils = scene::soils_of(scene);
    warn_about_friction_under_water(scene, soils, problems);
    warn_about_steep_pool(scene, soils, problems);
    warn_about_loads_that_end(scene, problems);
    warn_about_densities(scene, soils, problems);
    for (std::size_t r = 0; r < scene.section.regions.size(); ++r) {
        if (soils[r].material >= scene.materials.size()) continue;
        const scene::Material& material = scene.materials[soils[r].material];
        if (materials::is_for_particles(material.law)) continue;
        const std::string& name = scene.section.regions[r].name;
        refuse(problems, region_pointer(r, "/material"),
               "\"" + name + "\" is of \"" + material.name + "\", whose law is " +
                   materials::traits(material.law).type + ", which material points cannot have",
               "map it in /transfer/mapping to a material of " +
                   materials::types_of_laws_that(materials::is_for_particles) +
                   ": {\"region\": \"" + name + "\", \"to\": ...}");
    }
}

void check_transfer(const scene::Scene& scene, Problems& problems) {
    const scene::Transfer& transfer = *scene.transfer;
    check_stress(scene, problems);
    warn_about_what_a_transfer_decides(scene, problems);
    if (transfer.liquefied && scene.fem && !scene.fem->water)
        refuse(problems, "/transfer/liquefied",
               "asks what has liquefied, and the FEM has no pore water",
               "add /fem/water, or leave this out");
    if (!transfer.phreatic_line.empty()) {
        const Depth deepest = deepest_below(scene.section, transfer.phreatic_line, level_at);
        if (deepest.below <= 0.0)
            refuse(problems, "/transfer/phreatic_line",
                   "runs below all soil, by at least " + metres(-deepest.below) +
                       ": nothing would be saturated",
                   "raise the line above the section's lowest level, " +
                       metres(extent(scene.section).low.y()) + ", or leave it out");
    }
    if (transfer.window) check_window(scene, problems);
}

}  // namespace breach::check
