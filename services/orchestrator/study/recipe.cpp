#include "services/orchestrator/study/recipe.hpp"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <map>

#include "core/exchange/provenance.hpp"
#include "core/fault/fault.hpp"
#include "core/phases/phases.hpp"
#include "core/scene/file_paths.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

enum class Regions { whole, names_and_materials };
enum class Materials {
    of_regions,  ///< those that a region is made of
    all,         ///< also those that soil becomes in the transfer
};

struct Reading {
    std::vector<std::string> parts;
    Materials materials;
    Regions regions;
};

/// Water of the stability analysis: by it strengths that go by stress are told in every phase.
constexpr const char* water_of_lem[]{"/lem/water", "/lem/piezometric_lines",
                                     "/lem/pore_pressure_ratios"};

const std::map<std::string, Reading> readings{
    {phases::lem.program, {{"/gravity", "/lem"}, Materials::of_regions, Regions::whole}},
    {phases::fem.program,
     {{"/gravity", "/thickness", "/fem"}, Materials::of_regions, Regions::whole}},
    {phases::transfer.program,
     {{"/gravity", "/transfer", "/mpm/cell_size", "/mpm/domain_x", "/mpm/domain_y", "/mpm/left",
       "/mpm/right", "/mpm/floor", "/mpm/terrain", "/mpm/kernel", "/mpm/gimp_half_size"},
      Materials::all,
      Regions::names_and_materials}},
    {phases::mpm.program,
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

/// What a phase reads. Without a FEM the MPM fills the section itself, as its ground and water lie.
Reading reading_of(const std::string& phase, const json& scene) {
    Reading reading = readings.at(phase);
    const bool fills = phase == phases::mpm.program && !scene.contains("fem");
    if (fills) {
        reading.regions = Regions::whole;
        reading.parts.emplace_back("/transfer");
    }
    const bool by_stress = std::ranges::any_of(
        scene.at("materials"), [](const json& each) { return each.contains("strength"); });
    if (by_stress && (fills || phase == phases::transfer.program))
        reading.parts.insert(reading.parts.end(), std::begin(water_of_lem), std::end(water_of_lem));
    return reading;
}

json section_part(const json& scene, Regions wanted) {
    if (wanted == Regions::whole) return scene.at("section");
    json regions = json::array();
    for (const json& each : scene.at("section").at("regions"))
        regions.push_back({{"name", each.at("name")}, {"material", each.at("material")}});
    return {{"regions", std::move(regions)}};
}

json content_of(const std::string& file) {
    if (const auto reference = scene::file_reference(file)) return {{"sha256", reference->sha256}};
    try {
        return {{"sha256", exchange::sha256_of_file(file)}};
    } catch (const fault::IoError&) {
        return file;  // the phase will say what is wrong with it; such a failure is never reused
    }
}

std::string escaped(const std::string& key) {
    std::string text;
    for (const char each : key) {
        if (each == '~')
            text += "~0";
        else if (each == '/')
            text += "~1";
        else
            text += each;
    }
    return text;
}

void collect(const json& a, const json& b, const std::string& at, std::vector<std::string>& found) {
    if (a == b) return;
    if (a.is_object() && b.is_object()) {
        for (const auto& [key, value] : a.items()) {
            if (b.contains(key)) {
                collect(value, b.at(key), at + "/" + escaped(key), found);
            } else {
                found.push_back(at + "/" + escaped(key));
            }
        }
        for (const auto& [key, value] : b.items())
            if (!a.contains(key)) found.push_back(at + "/" + escaped(key));
        return;
    }
    if (a.is_array() && b.is_array() && a.size() == b.size()) {
        for (std::size_t i = 0; i < a.size(); ++i)
            collect(a[i], b[i], at + "/" + std::to_string(i), found);
        return;
    }
    found.push_back(at);
}

}  // namespace

Recipe recipe_of(const std::string& phase, const json& scene, std::int64_t numerics) {
    const Reading reading = reading_of(phase, scene);
    json part{{"section", section_part(scene, reading.regions)},
              {"materials", materials_part(scene, reading.materials)}};
    for (const std::string& each : reading.parts) {
        const json::json_pointer at(each);
        if (scene.contains(at)) part[at] = scene.at(at);
    }
    for (const std::string& key : scene::file_entries) {
        const json::json_pointer at(key);
        if (part.contains(at) && part[at].is_string())
            part[at] = content_of(part[at].get<std::string>());
    }
    Recipe recipe{.hash = {}, .phase = phase, .cache_version = numerics, .part = part.dump()};
    recipe.hash =
        exchange::sha256_of_text(phase + "\n" + std::to_string(numerics) + "\n" + recipe.part);
    return recipe;
}

std::vector<std::string> differences(const json& a, const json& b) {
    std::vector<std::string> found;
    collect(a, b, "", found);
    return found;
}

}  // namespace breach::orchestrator
