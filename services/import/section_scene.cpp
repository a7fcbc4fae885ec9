// Makes a scene of the healed section and runs the scene's own check on it. Faults of
// regions are moved back to lines of the drawing, where the user can correct them. Called by fit()
// in steps.cpp after all healing; only give_up() replaces what is written here.

#include <algorithm>
#include <filesystem>
#include <limits>

#include "core/check/check.hpp"
#include "services/import/numbers.hpp"
#include "services/import/shake.hpp"
#include "services/import/steps.hpp"

namespace breach::importing {

using nlohmann::json;

namespace {

/// Without the motion, whose file is not written yet.
/// The folder does not matter: an imported scene names no other file.
check::Checked checked(json document, const Request& request) {
    if (document.contains("fem")) document["fem"].erase("motion");
    return check::checked_document(std::move(document), request.drawing.name, ".", {});
}

/// The first layer reaches from the phreatic line to its depth.
double thinnest_of(const std::vector<LayerRequest>& layers) {
    double thinnest = std::numeric_limits<double>::infinity();
    for (const LayerRequest& each : layers)
        for (std::size_t i = 0; i < each.depths.size(); ++i)
            thinnest = std::min(thinnest, each.depths[i] - (i ? each.depths[i - 1] : 0.0));
    return thinnest;
}

/// `share`: of the usual cell size, see with_sound_cells().
Document made(const Section& section, const Request& request, double share) {
    Document document =
        document_of(scene_name(request), request.materials, section.soils, section.lines, share);
    if (!section.terrain_from.empty())
        document.guessed.push_back({{"pointer", "/mpm/terrain"},
                                    {"value", document.scene["mpm"]["terrain"]},
                                    {"from", section.terrain_from}});
    if (!section.liquefied.empty())
        add_liquefaction(section.liquefied, section.soils, section.lines, document);
    if (request.motion)
        add_earthquake({*request.motion, thinnest_of(section.layers)}, section.soils, section.lines,
                       document);
    return document;
}

/// Replaces the regions' pointers by lines of the drawing in the reader's faults.
/// Regions in the scene have the order of the soils, hence the index.
std::vector<Fault> seen_from_drawing(std::vector<Fault> faults, const std::vector<Soil>& soils) {
    constexpr std::string_view regions = "/section/regions/";
    for (Fault& each : faults) {
        if (!each.pointer.starts_with(regions)) continue;
        const auto index = number_in(each.pointer.substr(
            regions.size(), each.pointer.find('/', regions.size()) - regions.size()));
        if (!index || *index >= static_cast<double>(soils.size())) continue;
        const Soil& soil = soils[static_cast<std::size_t>(*index)];
        each.pointer = at_line(soil.origin.line);
        each.cause = "region " + soil.name + " " + each.cause;
    }
    return faults;
}

/// Halves the cells for thin layers until the scene's check accepts them, at most to an eighth
/// of an element. The report names layers that are still too thin.
std::pair<Document, check::Checked> with_sound_cells(const Section& section,
                                                     const Request& request) {
    const auto is_coarse = [](const Fault& each) { return each.pointer == "/mpm/cell_size"; };
    constexpr double finest = 0.125;
    for (double share = 1.0;; share *= 0.5) {
        Document document = made(section, request, share);
        check::Checked read = checked(document.scene, request);
        const auto coarse = std::ranges::find_if(read.faults, is_coarse);
        if (coarse == read.faults.end()) return {std::move(document), std::move(read)};
        if (share > finest) continue;
        document = made(section, request, 1.0);
        document.scene["mpm"]["allow_coarse_cells"] = true;
        document.remarks.push_back("/mpm/cell_size " + coarse->cause +
                                   ": runouts will be questionable; merge thin layers, or give "
                                   "them fewer depths");
        read = checked(document.scene, request);
        return {std::move(document), std::move(read)};
    }
}

/// Sizes and shapes that suggest a mistake.
void check_shape(const std::vector<Soil>& soils, const std::optional<Slope>& slope, Notes& notes) {
    // Dams and slopes outside of these exist, but wrong units are far more frequent: hence a
    // question.
    constexpr double least = 3.0, most = 500.0;  // m
    const geometry::Box box = box_of(soils);
    const Vec2 size = box.high - box.low;
    const double height = slope ? slope->fall() : size.y();
    if (height < least || height > most)
        notes.ask_to_confirm(
            "unit",
            std::string(slope ? "the slope" : "the section") + " is " + extent(height) +
                (height < least ? " high only, read in " : " high, read in ") +
                notes.result.report.at("unit").get<std::string>() + "; the section would be " +
                notes.result.report.at("other_units").get<std::string>(),
            "say its unit: --unit m, cm, mm or ft");
    if (looks_upside_down(soils))
        notes.ask_to_confirm(
            "drawing",
            "the section's top is level and its bottom has a slope: the drawing looks "
            "as if depths were given as levels",
            "give levels as y, positive upwards: -depth");
}

}  // namespace

std::string scene_name(const Request& request) {
    const std::string stem = std::filesystem::path(request.drawing.name).stem().string();
    std::string name = lower(as_name(request.name.empty() ? stem : request.name, "section"));
    if (name.front() == '_' || name.front() == '-') name.insert(0, "s");
    return name;
}

bool can_fail(Section& section, Notes& notes) {
    const Request& request = notes.request;
    const std::vector<Soil>& soils = section.soils;
    // Materials first: later steps need their entries.
    Document bare = document_of(scene_name(request), request.materials, soils, {});
    bare.scene.erase("lem");
    notes.result.faults = seen_from_drawing(checked(bare.scene, request).faults, soils);
    if (!notes.are_clean()) return false;
    const json& materials = materials_in(request.materials);
    notes.result.faults =
        request.motion ? faults_of_shaking(soils, section.lines, materials)
                       : faults_of_liquefying(section.liquefied, soils, section.lines, materials);
    if (!notes.are_clean()) return false;
    if (section.lines.terrain.empty()) {
        Terrain terrain = guessed_terrain(soils, section.lines.ground);
        section.lines.terrain = std::move(terrain.line);
        section.terrain_from = std::move(terrain.from);
    } else {
        notes.remark("the runout's terrain is the line that is drawn for it");
    }
    return true;
}

/// A scene without /lem is better than none: it is left out where the search that was guessed is
/// at fault and there is no water to lose.
void write_scene(const Section& section, Notes& notes) {
    const Request& request = notes.request;
    auto [document, read] = with_sound_cells(section, request);
    if (!read.faults.empty() && section.lines.phreatic.empty() && document.scene.contains("lem")) {
        json without = document.scene;
        without.erase("lem");
        check::Checked again = checked(without, request);
        if (again.faults.empty()) {
            document.remarks.push_back("the scene has no /lem: " + read.faults.front().pointer +
                                       " " + read.faults.front().cause);
            std::erase_if(document.guessed.get_ref<json::array_t&>(), [](const json& each) {
                return each.at("pointer").get<std::string>().starts_with("/lem");
            });
            document.scene = std::move(without);
            read = std::move(again);
        }
    }
    for (std::string& each : document.remarks) notes.remark(std::move(each));
    // Guessed entries are listed as such; what a check thinks of them is shown with the scene.
    for (const fault::Flag& each : read.scene.warnings)
        if (std::ranges::none_of(document.guessed, [&](const json& guess) {
                return guess.at("pointer") == each.pointer;
            }))
            notes.remark(each.pointer + ": " + each.message);
    notes.result.report["guessed"] = document.guessed;
    if (document.slope)
        notes.result.report["slope"] = {{"crest", as_json(document.slope->crest)},
                                        {"toe", as_json(document.slope->toe)}};
    notes.result.faults = seen_from_drawing(std::move(read.faults), section.soils);
    check_shape(section.soils, document.slope, notes);
    notes.add(notes.result.to_confirm);
    notes.result.scene = std::move(document.scene);
    notes.result.study = std::move(document.study);
    if (request.motion) {
        notes.result.study = {{"format", "breachline-study/1"}, {"name", scene_name(request)}};
        notes.result.study.update(json(earthquake::transfers_of(*request.motion)));
        notes.result.motion = earthquake::text_of(*request.motion);
    }
    notes.result.sketch = std::move(read.scene);
}

}  // namespace breach::importing
