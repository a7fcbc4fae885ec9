#include "core/phases/reads.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace breach::phases {

using nlohmann::json;

namespace {

enum class Regions { whole, names_and_materials };
enum class Materials {
    of_regions,  ///< materials of the regions
    all,         ///< also those of soil after the transfer
};

struct Reading {
    std::vector<std::string> parts;
    Materials materials;
    Regions regions;
};

const std::map<std::string_view, Reading> readings{
    {lem.program, {{"/gravity", "/lem"}, Materials::of_regions, Regions::whole}},
    {fem.program, {{"/gravity", "/thickness", "/fem"}, Materials::of_regions, Regions::whole}},
    // All of the FEM: its series of snapshots does not tell one FEM from another.
    {post_seismic.program,
     {{"/gravity", "/thickness", "/lem", "/fem", "/transfer/mapping", "/transfer/phreatic_line",
       "/transfer/liquefied", "/mpm/water"},
      Materials::all,
      Regions::whole}},
    {transfer.program,
     {{"/gravity", "/transfer", "/mpm/cell_size", "/mpm/domain_x", "/mpm/domain_y", "/mpm/left",
       "/mpm/right", "/mpm/floor", "/mpm/water", "/mpm/terrain", "/mpm/gimp_half_size"},
      Materials::all,
      Regions::names_and_materials}},
    {mpm.program,
     {{"/gravity", "/thickness", "/mpm"}, Materials::all, Regions::names_and_materials}},
};

json materials_part(const json& scene, Materials wanted) {
    const json& all = scene.at("materials");
    if (wanted == Materials::all) return all;
    json used = json::object();
    for (const json& each : scene.at("section").at("regions")) {
        const auto& name = each.at("material").get_ref<const std::string&>();
        used[name] = all.at(name);
        const json::json_pointer like("/strength/like");  // another material's profile
        if (!all.at(name).contains(like)) continue;
        const auto& other = all.at(name).at(like).get_ref<const std::string&>();
        if (all.contains(other)) used[other] = all.at(other);
    }
    return used;
}

json section_part(const json& scene, Regions wanted) {
    if (wanted == Regions::whole) return scene.at("section");
    json regions = json::array();
    for (const json& each : scene.at("section").at("regions"))
        regions.push_back({{"name", each.at("name")}, {"material", each.at("material")}});
    return {{"regions", std::move(regions)}};
}

bool is(const Phase& phase, const Phase& other) {
    return std::string_view(phase.program) == other.program;
}

/// Without a FEM the MPM fills the section, with the ground and water in the scene. Strengths that
/// depend on stress use the water of /lem.
Reading reading_of(const Phase& phase, const json& scene) {
    Reading reading = readings.at(phase.program);
    const bool fills = is(phase, mpm) && !scene.contains("fem");
    if (fills) {
        reading.regions = Regions::whole;
        reading.parts.emplace_back("/transfer");
    }
    const bool by_stress = std::ranges::any_of(
        scene.at("materials"), [](const json& each) { return each.contains("strength"); });
    if (by_stress && (fills || is(phase, transfer))) reading.parts.emplace_back("/lem");
    return reading;
}

void copy(const std::vector<std::string>& parts, const json& scene, json& known) {
    for (const std::string& each : parts) {
        const json::json_pointer at(each);
        if (scene.contains(at)) known[at] = scene.at(at);
    }
}

/// The phases that provide its input.
std::vector<Phase> before(const Phase& phase, const json& scene) {
    if (is(phase, transfer) || is(phase, post_seismic)) return {fem};
    if (is(phase, mpm) && scene.contains("fem")) return {fem, transfer};
    return {};
}

}  // namespace

json part_read_by(const Phase& phase, const json& scene) {
    const Reading reading = reading_of(phase, scene);
    json part{{"section", section_part(scene, reading.regions)},
              {"materials", materials_part(scene, reading.materials)}};
    copy(reading.parts, scene, part);
    return part;
}

json scene_known_to(const Phase& phase, const json& scene) {
    json known{{"section", scene.at("section")},
               {"materials", materials_part(scene, readings.at(phase.program).materials)}};
    copy({"/format", "/name", "/title"}, scene, known);
    for (const Phase& each : before(phase, scene))
        copy(reading_of(each, scene).parts, scene, known);
    copy(reading_of(phase, scene).parts, scene, known);
    if (scene.contains("mpm") && (is(phase, transfer) || is(phase, post_seismic)))
        known["mpm"] = scene.at("mpm");
    return known;
}

}  // namespace breach::phases
