// What went in: section, materials, water, boundary, motion and every setting, with what nobody set
// marked as such. Every entry that the run's phases read stands in one of the tables.
#include <algorithm>
#include <cmath>

#include "core/phases/phases.hpp"
#include "services/report/chapters/chapters.hpp"
#include "services/report/read/entries.hpp"
#include "services/report/section/section_drawing.hpp"

namespace breach::report {

using nlohmann::json;

namespace {

constexpr const char* default_mark = " *";
constexpr const char* about_marks =
    "* stands at the program's own value: it was left out, or written as what the program takes "
    "then.";
constexpr std::size_t materials_abreast = 5;  // columns that a standing page has room for

/// Entries below any of these pointers.
struct Group {
    const char* name;
    const char* title;
    std::vector<const char*> below;
};

/// The first that fits takes the entry; the last ones take what is left of a phase.
const std::vector<Group>& groups() {
    static const std::vector<Group> all{
        {"water",
         "Water",
         {"/lem/water", "/lem/piezometric_lines", "/lem/pore_pressure_ratios", "/lem/undrained",
          "/lem/liquefaction", "/fem/water", "/fem/liquefaction", "/transfer/phreatic_line",
          "/transfer/liquefied"}},
        {"boundary",
         "Boundary and loads",
         {"/fem/supports", "/fem/base", "/fem/free_field", "/fem/surcharge", "/lem/surcharge",
          "/lem/line_loads", "/mpm/left", "/mpm/right", "/mpm/floor", "/mpm/terrain",
          "/mpm/domain_x", "/mpm/domain_y"}},
        {"motion",
         "Motion and stages",
         {"/fem/motion", "/fem/stages", "/lem/seismic_coefficient", "/mpm/shaking"}},
        {"settings_lem", "Limit equilibrium: all other settings", {"/lem"}},
        {"settings_fem", "Finite elements: all other settings", {"/fem"}},
        {"settings_transfer", "Transfer: all other settings", {"/transfer"}},
        {"settings_mpm", "Material points: all other settings", {"/mpm"}},
        {"settings_scene", "Of the whole scene", {""}},
    };
    return all;
}

bool is_below(const std::string& pointer, const std::string& top) {
    return top.empty() || pointer == top || pointer.starts_with(top + "/");
}

const Group& group_of(const std::string& pointer) {
    return *std::ranges::find_if(groups(), [&](const Group& group) {
        return std::ranges::any_of(group.below,
                                   [&](const char* top) { return is_below(pointer, top); });
    });
}

std::string marked(const SceneEntry& entry) {
    return entry.value + (entry.is_default ? default_mark : "");
}

std::vector<Table> tables_of(const std::vector<SceneEntry>& entries) {
    std::vector<Table> tables;
    for (const Group& group : groups()) {
        Table table{
            group.name, group.title, {"entry of the scene", "value", "unit"}, {}, about_marks};
        for (const SceneEntry& each : entries) {
            if (is_below(each.pointer, "/materials") ||
                is_below(each.pointer, "/section/regions") || &group_of(each.pointer) != &group)
                continue;
            table.rows.push_back({each.pointer, marked(each), each.unit});
        }
        if (!table.rows.empty()) tables.push_back(std::move(table));
    }
    return tables;
}

/// Of the polygon's corners, by the shoelace formula [m2].
double area_of(const json& polygon) {
    double twice = 0.0;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const json &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
        twice += a.at(0).get<double>() * b.at(1).get<double>() -
                 b.at(0).get<double>() * a.at(1).get<double>();
    }
    return 0.5 * std::abs(twice);
}

std::string corners_of(const json& polygon) {
    std::string text;
    for (const json& corner : polygon)
        text +=
            (text.empty() ? "(" : " (") + corner.at(0).dump() + ", " + corner.at(1).dump() + ")";
    return text;
}

Table section_of(const json& scene, const std::vector<SceneEntry>& entries) {
    Table table{"section",
                "Section",
                {"region", "material", "area [m2]", "corners (x, y) [m]", "mesh"},
                {},
                about_marks};
    const json& regions = scene.at("section").at("regions");
    for (std::size_t i = 0; i < regions.size(); ++i) {
        std::string mesh;
        const std::string at = "/section/regions/" + std::to_string(i) + "/";
        for (const SceneEntry& each : entries) {
            if (!each.pointer.starts_with(at)) continue;
            const std::string key = each.pointer.substr(at.size());
            if (key == "name" || key == "material" || key == "polygon") continue;
            mesh += (mesh.empty() ? "" : "; ") + key + " " + marked(each);
        }
        const json& polygon = regions[i].at("polygon");
        table.rows.push_back({regions[i].value("name", "-"), regions[i].value("material", "-"),
                              rounded(area_of(polygon), 6), corners_of(polygon),
                              mesh.empty() ? "-" : mesh});
    }
    return table;
}

std::vector<std::string> pointers_set(const json& overrides) {
    std::vector<std::string> pointers;
    for (const json& each : overrides) {
        const std::string text = each;
        pointers.push_back(text.substr(0, text.find('=')));
    }
    return pointers;
}

/// The transfer's part is completed in every scene, also where nothing is transferred.
std::vector<SceneEntry> entries_read(const Run& run, const json& scene) {
    const json overrides =
        run.study.is_object() ? run.study.value("overrides", json::array()) : json::array();
    std::vector<SceneEntry> entries = entries_of(scene, pointers_set(overrides));
    if (is_static(run))
        std::erase_if(entries,
                      [](const SceneEntry& each) { return is_below(each.pointer, "/transfer"); });
    return entries;
}

/// Some materials side by side, one row per entry that one of them has.
Table materials_abreast_of(const std::vector<std::string>& names,
                           const std::vector<SceneEntry>& entries, std::size_t number) {
    Table table{"materials" + (number > 0 ? "_" + std::to_string(number + 1) : ""),
                number > 0 ? "Materials, continued" : "Materials",
                {"entry of the material", "unit"},
                {},
                about_marks};
    table.columns.insert(table.columns.end(), names.begin(), names.end());
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::string at = "/materials/" + names[i] + "/";
        for (const SceneEntry& each : entries) {
            if (!each.pointer.starts_with(at)) continue;
            const std::string key = each.pointer.substr(at.size());
            auto row = std::ranges::find(table.rows, key, [](const auto& r) { return r.front(); });
            if (row == table.rows.end()) {
                std::vector<std::string> fresh(2 + names.size(), "-");
                fresh[0] = key;
                fresh[1] = each.unit;
                row = table.rows.insert(row, std::move(fresh));
            }
            (*row)[2 + i] = marked(each);
        }
    }
    return table;
}

std::vector<Table> materials_of(const json& scene, const std::vector<SceneEntry>& entries) {
    std::vector<std::string> names;
    const json materials = scene.value("materials", json::object());
    for (const auto& [name, material] : materials.items()) names.push_back(name);
    std::vector<Table> tables;
    for (std::size_t first = 0; first < names.size(); first += materials_abreast) {
        const auto begin = names.begin() + static_cast<std::ptrdiff_t>(first);
        const auto end = names.begin() + static_cast<std::ptrdiff_t>(
                                             std::min(first + materials_abreast, names.size()));
        tables.push_back(materials_abreast_of({begin, end}, entries, tables.size()));
    }
    return tables;
}

/// The section that the study asks about. It was computed: a file that is not there any more, such as
/// a motion on another machine, is only not drawn.
std::string drawing_of(const Run& run) {
    BaseScene base{run.scene, {}, ""};
    check::Checked checked = check::checked_document(base.scene, "scene", run.folder, {});
    checked.faults.clear();
    const Draft draft = draft_of(std::move(base), std::move(checked));
    return can_be_drawn(draft) ? as_svg(draft, {}) : "";
}

}  // namespace

void add_inputs(const Material& from, Document& document) {
    const json& scene = from.run.scene;
    const std::vector<SceneEntry> entries = entries_read(from.run, scene);
    const auto defaults = std::ranges::count_if(entries, &SceneEntry::is_default);
    Chapter chapter{"Inputs",
                    "The scene as it was computed, whole: " + std::to_string(entries.size()) +
                        " entries, " + std::to_string(defaults) +
                        " of them at the program's own value (*). What variants change stands in "
                        "their table."};
    chapter.drawing = drawing_of(from.run);
    chapter.tables.push_back(section_of(scene, entries));
    for (Table& each : materials_of(scene, entries)) chapter.tables.push_back(std::move(each));
    for (Table& each : tables_of(entries)) chapter.tables.push_back(std::move(each));
    document.chapters.push_back(std::move(chapter));
}

}  // namespace breach::report
