// Called after the scene is whole, because it needs the water and the regions as the solver reads
// them. The material points of the runout carry no pore pressure, so wet fill would have its full
// friction; what liquefies is left out, because its strength is residual already.
#include "services/templates/wet_fill.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "core/geometry/section.hpp"
#include "core/scene/ground.hpp"
#include "core/scene/reading.hpp"
#include "core/words/number.hpp"

namespace breach::templates {

using Json = nlohmann::ordered_json;

namespace {

/// Rounded down to a tenth of a degree.
/// Down, the safe side.
double reduced(double phi_deg, double r_u) {
    constexpr double degree = std::numbers::pi / 180.0;
    const double phi = std::atan((1.0 - r_u) * std::tan(phi_deg * degree)) / degree;
    return std::floor(10.0 * phi) / 10.0;
}

/// A profile has its own rule below water, and soil without friction has nothing to reduce.
bool is_drained(const Json& material) {
    return !material.contains("strength") && material.at("law").value("phi_deg", 0.0) > 0.0;
}

/// A material that nothing names any more would only confuse the scene's author.
void drop_unused(Json& scene, const std::string& material) {
    const auto names = [&](const Json& list, const char* entry) {
        return std::ranges::any_of(list, [&](const Json& each) { return each[entry] == material; });
    };
    if (names(scene["section"]["regions"], "material")) return;
    if (scene.contains("transfer") && names(scene["transfer"]["mapping"], "to")) return;
    scene["materials"].erase(material);
}

}  // namespace

void reduce_friction_of_wet_fill(Json& scene, const std::string& suffix) {
    const scene::Reading reading = scene::read_text(scene.dump(), "scene", ".", {});
    // check_made() reports them next.
    if (!reading.faults.empty()) return;
    if (reading.scene.mpm->water) return;  // its pressure acts: friction is on the effective stress
    const scene::Scene& read = reading.scene;
    const scene::Ground ground(read);
    const auto& regions = read.section.regions;
    const std::vector<scene::Soil> soils = scene::soils_of(read);
    const std::vector<std::size_t> liquefy = read.transfer && read.transfer->liquefied
                                                 ? read.transfer->liquefied->regions
                                                 : std::vector<std::size_t>{};
    for (std::size_t r = 0; r < regions.size(); ++r) {
        const std::string before = read.materials[soils[r].material].name;
        Json wet = scene["materials"][before];
        if (!is_drained(wet) || std::ranges::count(liquefy, r) > 0) continue;
        if (!scene::is_below_water(read.section, regions[r], read.lem->water->line)) continue;
        const double r_u = ground.r_u_at_base(r);
        if (!wet.contains("limit_strength"))
            wet["limit_strength"] = {{"c_kPa", wet["law"]["c_kPa"]},
                                     {"phi_deg", wet["law"]["phi_deg"]}};
        Json& law = wet["law"];
        law["phi_deg"] = reduced(law["phi_deg"], r_u);
        if (law.contains("softening"))
            law["softening"]["phi_residual_deg"] =
                reduced(law["softening"]["phi_residual_deg"], r_u);
        wet["notes"].push_back(
            "assumed: the law's friction is what the pore pressure leaves, tan phi = (1 - r_u) tan "
            "phi', with r_u = " +
            words::text_of(r_u, 2) + " on the base of " + regions[r].name +
            " (Bishop & Morgenstern 1960): material points carry no pore pressure; fill that "
            "dilates gets no credit for suction (Duncan, Wright & Brandon 2014)");
        // Of the region, not of the soil: r_u differs from place to place.
        const std::string after = regions[r].name + (read.fem ? "_runout" : suffix);
        scene["materials"][after] = wet;
        if (read.fem) {
            for (Json& each : scene["transfer"]["mapping"])
                if (each["region"] == regions[r].name) each["to"] = after;
        } else {
            scene["section"]["regions"][r]["material"] = after;
        }
        drop_unused(scene, before);
    }
}

}  // namespace breach::templates
