// The order of an import: check the options, read the drawing, sort outlines by meaning, take
// lines, heal, divide into depth layers, write the scene. A step that fails ends the import where
// later faults would mislead. Called by `breach import` and by POST of the dashboard with bytes; it
// writes no file. Healing and layers are in fit(), the scene in section_scene.cpp.
#include "services/import/steps.hpp"

#include <algorithm>
#include <array>
#include <filesystem>

#include "core/check/check.hpp"
#include "core/words/list.hpp"
#include "core/words/number.hpp"
#include "services/import/csv.hpp"
#include "services/import/depth_layers.hpp"
#include "services/import/dxf.hpp"
#include "services/import/dxf_records.hpp"
#include "services/import/guess.hpp"
#include "services/import/shake.hpp"

namespace breach::importing {

using nlohmann::json;

namespace {

/// Outside of these a drawing was most likely read in a wrong unit.
constexpr double longest_section = 10'000.0, shortest_section = 1.0;  // m
constexpr std::size_t most_faults = 200;

std::set<std::string> names_in(const json& materials) {
    std::set<std::string> names;
    if (materials.is_object())
        for (const auto& [name, material] : materials.items()) names.insert(name);
    return names;
}

/// By the name if it says so, because a CSV file may contain the word SECTION.
/// A DWG counts as one, so that the message about its form is shown instead of that of a table.
bool is_dxf(const Sent& sent) {
    const std::string extension = lower(std::filesystem::path(sent.name).extension().string());
    if (extension == ".dxf" || extension == ".dwg") return true;
    if (extension == ".csv" || extension == ".txt") return false;
    return sent.bytes.starts_with("AutoCAD") || sent.bytes.starts_with("AC10") ||
           sent.bytes.substr(0, 4096).find("SECTION") != std::string::npos;
}

/// For the motion's numbers, whose limits are those of services/earthquake.
bool is_between(const char* option, double value, double least, double most,
                const std::string& unit, Notes& notes) {
    if (value >= least && value <= most) return true;
    notes.refuse(option, "is " + words::text_of(value) + " " + unit,
                 "give " + words::text_of(least) + " to " + words::text_of(most) + " " + unit);
    return false;
}

/// Adds the depth layers and the liquefied regions that are asked for.
/// All options are checked before the drawing is read: a user corrects them in one go.
bool check_request(Section& section, Notes& notes) {
    const Request& request = notes.request;
    const json& materials = materials_in(request.materials);
    bool sound = true;
    if (!materials.is_object() || materials.empty()) {
        notes.refuse("materials", "hold no material",
                     "give a JSON file with a scene's \"materials\": {\"NAME\": {...}}");
        sound = false;
    }
    if (!(request.tolerance > 0.0 && request.tolerance <= 10.0)) {
        notes.refuse("tolerance",
                     std::to_string(request.tolerance) + " m is no distance to heal over",
                     "give more than 0 and at most 10 m");
        sound = false;
    }
    if (request.flatten && !(*request.flatten > 0.0 && *request.flatten <= 10.0)) {
        notes.refuse("flatten", "is no distance that chords may be off",
                     "give more than 0 and at most 10 m");
        sound = false;
    }
    if (!request.unit.empty() && !unit_named(request.unit)) {
        notes.refuse("unit", "\"" + as_utf8(request.unit) + "\" is no unit",
                     "the units are " + unit_names());
        sound = false;
    }
    if (const auto& motion = request.motion) {
        sound &=
            is_between("pga", motion->pga, earthquake::least_pga, earthquake::most_pga, "g", notes);
        sound &= is_between("shaking", motion->shaking, earthquake::least_shaking,
                            earthquake::most_shaking, "s", notes);
    }
    for (const std::string& each : request.layers)
        if (auto wanted = layer_request_from(each, notes.result.faults))
            section.layers.push_back(std::move(*wanted));
    for (const std::string& each : request.liquefied)
        if (auto wanted = liquefied_request_from(each, notes.result.faults))
            section.liquefied.push_back(std::move(*wanted));
    if (request.motion && !request.liquefied.empty())
        notes.refuse("liquefied", "is given with an earthquake, whose FEM finds what liquefies",
                     "leave out --with-fem, or --liquefied");
    return sound;
}

/// Nothing: the bytes are no drawing.
std::optional<Drawing> read_drawing(const LayerMap& map, Notes& notes) {
    const Request& request = notes.request;
    if (auto faults = form_faults(request.drawing.bytes); !faults.empty()) {
        notes.add(faults);
        return std::nullopt;
    }
    const auto unit = unit_named(request.unit);
    Drawing drawing = is_dxf(request.drawing)
                          ? read_dxf(request.drawing.bytes, map, {unit, request.flatten})
                          : read_csv(request.drawing.bytes, map, unit);
    notes.add(drawing);
    notes.result.report["unit"] = drawing.unit;
    notes.result.report["unit_from"] = !request.unit.empty()     ? "asked"
                                       : is_dxf(request.drawing) ? "drawing"
                                       : drawing.says_unit       ? "header"
                                                                 : "default";
    for (const auto& [layer, found] : drawing.unknown)
        notes.refuse(at_line(found.origin.line),
                     "layer " + layer + " has no material: " + std::to_string(found.entities) +
                         (found.entities == 1 ? " entity, " : " entities, the first one ") +
                         found.origin.entity + " at " + text(found.first),
                     "map " + layer + "=MATERIAL, or " + layer +
                         "=phreatic, terrain, ground or none (left out)");
    for (const std::string& each : map.unused(drawing.layers))
        notes.refuse("map", "nothing is drawn on layer \"" + each + "\"",
                     "the layers are " + layers_named(drawing.layers));
    return drawing;
}

/// Whether the section is higher than long, without confirmation.
bool is_turned(const std::vector<Soil>& soils, Notes& notes) {
    if (soils.empty()) return false;
    const geometry::Box box = box_of(soils);
    const Vec2 size = box.high - box.low;
    if (size.y() <= size.x()) return false;
    notes.ask_to_confirm("drawing",
                         "the section is " + extent(size.x()) + " long and " + extent(size.y()) +
                             " high: x and y look swapped, or the levels exaggerated",
                         "give the distance along the section as x and the level as y, both to one "
                         "scale");
    return !notes.request.confirmed;
}

/// A drawing without a known unit has a fault already: here it only ends the import.
bool has_sound_size(const std::vector<Soil>& soils, bool knows_unit, Notes& notes) {
    if (soils.empty()) return false;
    const geometry::Box box = box_of(soils);
    const double length = (box.high - box.low).maxCoeff();
    const std::string size = "the section reaches from " + text(box.low) + " to " + text(box.high) +
                             ": it is " + metres(length) + " long";
    const bool odd = length > longest_section || length < shortest_section;
    if (!odd) return true;
    if (!knows_unit) return false;
    if (length > longest_section) {
        notes.refuse("unit", size + ", as if millimetres were read as metres",
                     "say its unit: with mm it is " + metres(1e-3 * length) + ", with ft " +
                         metres(0.3048 * length) + " long");
    } else {
        notes.refuse("unit", size + ", as if metres were read as a smaller unit",
                     "say its unit, m or ft");
    }
    return false;
}

/// A gap that is open to a side is not a face of the drawing, but not a valley either.
void check_for_air(const std::vector<Soil>& soils, double tolerance, Notes& notes) {
    const auto air = highest_void(soils, tolerance);
    if (!air) return;
    const Soil &above = soils[air->above], &below = soils[air->below];
    notes.refuse(at_line(above.origin.line),
                 "air below " + above.name + " at " + text(air->at) + ": it stands " +
                     metres(air->height) + " above " + below.name,
                 "let both share a border, or draw the soil that lies between them");
}

/// A depth layer has the material with its own name, if there is one. Case does not count.
void choose_materials(std::vector<Soil>& soils, const std::vector<Soil>& drawn,
                      const std::set<std::string>& materials, Notes& notes) {
    std::map<std::string, std::string> own;
    for (const std::string& each : materials) own[lower(each)] = each;
    for (Soil& each : soils) {
        if (std::ranges::find(drawn, each.name, &Soil::name) != drawn.end())
            continue;  // a region as drawn: its layer decides
        const auto found = own.find(lower(each.name));
        if (found == own.end() || found->second == each.material) continue;
        notes.remark("region " + each.name + " is of the material of its name, no longer of " +
                     each.material);
        each.material = found->second;
    }
}

/// The section's length and height [m], also for other units.
void tell_size(const std::vector<Soil>& soils, Notes& notes) {
    const geometry::Box box = box_of(soils);
    const Vec2 size = box.high - box.low;
    notes.result.report["size"] = as_json(size);
    const double own = unit_named(notes.result.report.at("unit")).value_or(Unit{"m", 1.0}).metres;
    notes.result.report["other_units"] =
        words::list_of(std::array{"m", "cm", "mm", "ft"}, [&](const std::string& unit) {
            const Vec2 other = size * (unit_named(unit)->metres / own);
            return extent(other.x()) + " by " + extent(other.y()) + " in " + unit;
        });
}

/// A region cut into layers is summed over its parts, which share its line and layer.
void tell_areas(const std::vector<Soil>& soils, const std::vector<Soil>& drawn, Notes& notes) {
    for (const Soil& before : drawn) {
        double after = 0.0;
        for (const Soil& each : soils)
            if (each.origin.line == before.origin.line && each.layer == before.layer)
                after += geometry::area(each.ring);
        notes.result.report["areas"].push_back(
            {{"region", before.name}, {"drawn", geometry::area(before.ring)}, {"imported", after}});
    }
}

/// Heals the soils, cuts them into layers and writes the scene, up to the first step with faults.
/// `soils` stay as drawn, but straightened for the FEM: give_up() draws them.
void fit(std::vector<Soil>& soils, Section section, Notes& notes) {
    const Request& request = notes.request;
    const std::vector<Soil> drawn = soils;
    const double tolerance = request.tolerance;
    if (request.motion) notes.add(straightened(soils, tolerance));
    Healed healed = importing::healed(soils, tolerance, section.lines.terrain);
    std::erase_if(healed.faults, [&](const Fault& each) {  // open ones are reported already
        return each.cause.ends_with("encloses no area") &&
               std::ranges::find(notes.result.faults, each.pointer, &Fault::pointer) !=
                   notes.result.faults.end();
    });
    notes.add(healed.faults);
    notes.add(healed.changes);
    if (notes.are_clean()) check_for_air(healed.soils, tolerance, notes);
    if (!healed.terrain.empty()) section.lines.terrain = healed.terrain;
    for (const LayerRequest& each : section.layers) {
        if (!notes.are_clean()) return;
        if (section.lines.phreatic.empty())
            return notes.refuse(
                "layers", "there is no phreatic line below which " + each.region + " has depths",
                "draw it on a layer PHREATIC, or give it as a file");
        healed = with_layers(std::move(healed.soils), each, section.lines.phreatic, tolerance);
        notes.add(healed.faults);
        notes.add(healed.changes);
    }
    if (!notes.are_clean()) return;
    if (!section.lines.phreatic.empty()) {
        healed = with_liquefied_parts(std::move(healed.soils), section.liquefied,
                                      section.lines.phreatic, tolerance);
        notes.add(healed.faults);
        notes.add(healed.changes);
        if (!notes.are_clean()) return;
    }
    section.soils = std::move(healed.soils);
    if (!request.motion)
        choose_materials(section.soils, drawn, names_in(materials_in(request.materials)), notes);
    if ((request.motion || !section.liquefied.empty()) && !can_fail(section, notes)) return;
    tell_size(section.soils, notes);
    tell_areas(section.soils, drawn, notes);
    write_scene(section, notes);
}

/// Keeps only the faults and the outlines as sent.
/// An incomplete scene cannot be read. The materials are, for their colours; regions are added
/// after the check, which would refuse them.
void give_up(const std::vector<Soil>& soils, Notes& notes) {
    const Request& request = notes.request;
    notes.result.scene = nullptr;
    auto& faults = notes.result.faults;
    if (faults.size() > most_faults) {
        const std::size_t more = faults.size() - most_faults;
        faults.resize(most_faults);
        notes.refuse("drawing", "has " + std::to_string(more) + " more faults",
                     "correct these, then import it again");
    }
    json draft{{"format", "breachline-scene/1"},
               {"name", scene_name(request)},
               {"title", "What is wrong with " + as_utf8(request.drawing.name)},
               {"materials", materials_in(request.materials)}};
    const std::string dumped = draft.dump(-1, ' ', false, json::error_handler_t::replace);
    notes.result.sketch = check::checked_text(dumped, request.drawing.name, ".", {}).scene;
    notes.result.sketch.section.regions.clear();
    const auto& known = notes.result.sketch.materials;
    for (const Soil& each : soils) {
        scene::Region region{};
        region.name = each.name;
        const auto at = std::ranges::find(known, each.material, &scene::Material::name);
        region.material = static_cast<std::size_t>(at - known.begin());
        region.polygon = each.ring;
        notes.result.sketch.section.regions.push_back(std::move(region));
    }
}

}  // namespace

/// Every way out passes the last two lines, so that a result has either a scene or faults.
Imported import_section(const Request& request) {
    Notes notes{request};
    notes.result.report = {{"unit", request.unit},     {"tolerance", request.tolerance},
                           {"healed", json::array()},  {"areas", json::array()},
                           {"guessed", json::array()}, {"remarks", json::array()}};
    const LayerMap map(request.map, names_in(materials_in(request.materials)), notes.result.faults);
    Sorted found;
    Section section;
    if (check_request(section, notes)) {
        if (auto drawing = read_drawing(map, notes)) {
            found = sorted(*drawing, map, notes);
            if (is_turned(found.soils, notes)) {  // the faults of lines would mislead
                notes.result.faults.push_back(notes.result.to_confirm.front());
            } else {
                section.lines = section_lines(found, drawing->unit, notes);
                if (has_sound_size(found.soils, drawing->knows_unit, notes))
                    fit(found.soils, std::move(section), notes);
            }
        }
    }
    if (!notes.are_clean()) give_up(found.soils, notes);
    return std::move(notes.result);
}

}  // namespace breach::importing
