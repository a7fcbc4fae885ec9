// The inputs: the section, its soils and its water; and the annex with every entry that the run's
// phases read, defaults marked.
#include <algorithm>
#include <cmath>

#include "core/phases/phases.hpp"
#include "services/report/chapters/chapters.hpp"
#include "services/report/read/entries.hpp"
#include "services/report/section/section_drawing.hpp"

namespace breach::report {

using nlohmann::json;
using namespace nlohmann::literals;

namespace {

constexpr const char* default_mark = " *";
constexpr const char* about_marks = "* default value, left out of the scene or equal to it.";
constexpr std::size_t materials_abreast = 5;  // limit of a portrait page

/// Entries below any of these pointers.
struct Group {
    const char* name;
    const char* title;
    std::vector<const char*> below;
};

/// An entry goes to the first group that matches; the last groups take the rest of a phase.
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
          "/mpm/left", "/mpm/right", "/mpm/floor", "/mpm/terrain", "/mpm/domain_x",
          "/mpm/domain_y"}},
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

/// Area of a polygon by the shoelace formula [m2].
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

Table regions_of(const json& scene, const std::vector<SceneEntry>& entries) {
    Table table{"section",
                "Regions",
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

/// Without the transfer's entries where nothing is transferred: every completed scene has them.
std::vector<SceneEntry> entries_read(const Run& run, const json& scene) {
    const json overrides =
        run.study.is_object() ? run.study.value("overrides", json::array()) : json::array();
    std::vector<SceneEntry> entries = entries_of(scene, pointers_set(overrides));
    if (is_static(run))
        std::erase_if(entries,
                      [](const SceneEntry& each) { return is_below(each.pointer, "/transfer"); });
    return entries;
}

/// Materials side by side, one row per entry that one of them has.
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

/// The study's section. Its faults are ignored: it was computed, and a missing file (a motion on
/// another machine) is only not drawn.
std::string drawing_of(const Run& run) {
    BaseScene base{run.scene, {}, ""};
    check::Checked checked = check::checked_document(base.scene, "scene", run.folder, {});
    checked.faults.clear();
    const Draft draft = draft_of(std::move(base), std::move(checked));
    return can_be_drawn(draft) ? as_svg(draft, {}) : "";
}

/// "drained c' = 5 kPa, phi' = 30 deg", "s_u = 0.22 sigma'_v0"; "-": the law has no strength.
std::string strength_in_words(const json& strength) {
    const auto number = [&](const char* key) { return rounded(strength.value(key, 0.0), 3); };
    const std::string type = strength.value("type", "");
    if (type == "effective" || type == "mohr_coulomb") {
        if (strength.value("phi_deg", 0.0) == 0.0) return "s_u = " + number("c_kPa") + " kPa";
        return "c' = " + number("c_kPa") + " kPa, phi' = " + number("phi_deg") + " deg";
    }
    if (type == "undrained") return "s_u = " + number("s_u_kPa") + " kPa";
    if (type == "undrained_by_depth")
        return "s_u = " + number("at_ground_kPa") + " kPa + " + number("per_metre_kPa") +
               " kPa/m of depth";
    if (type == "undrained_ratio") return "s_u = " + number("ratio") + " sigma'_v0";
    if (type == "relation") return "s_r by " + strength.value("relation", "");
    if (type == "pm4sand")
        return "D_R = " + number("D_R") + ", G_0 = " + number("G_0") + ", h_po = " + number("h_po");
    if (type == "norsand") return "psi_0 = " + number("psi_0");
    return type.starts_with("undrained") ? "s_u by " + type.substr(10) : "-";
}

std::string peak_of(const json& material) {
    if (const json profile = material.value("/strength/peak"_json_pointer, json());
        profile.is_object())
        return strength_in_words(profile);
    return strength_in_words(material.at("law"));
}

std::string residual_of(const json& material) {
    if (const json profile = material.value("/strength/residual"_json_pointer, json());
        profile.is_object())
        return strength_in_words(profile);
    const json softening = material.at("law").value("softening", json());
    if (!softening.is_object()) return "-";
    const double phi =
        softening.value("phi_residual_deg", material.at("law").value("phi_deg", 0.0));
    return strength_in_words({{"type", "mohr_coulomb"},
                              {"c_kPa", softening.value("c_residual_kPa", 0.0)},
                              {"phi_deg", phi}});
}

/// One row per soil of a region or of the transfer.
Table soils_of(const json& scene) {
    Table table{
        "soils",
        "Soils",
        {"soil", "law", "density [kg/m3]", "strength", "after softening", "E [MPa]", "nu",
         "permeability [m/s]"},
        {},
        "Strength before failure, and what the soil softens to. The annex has every entry."};
    const json materials = scene.value("materials", json::object());
    for (const auto& [name, soil] : materials.items()) {
        const json& law = soil.at("law");
        const auto entry = [](const json& of, const char* key) {
            const json value = of.value(key, json());
            return value.is_number() ? rounded(value.get<double>(), 4) : std::string("-");
        };
        const json k = soil.value("permeability", json());
        std::string type = law.value("type", "");
        std::ranges::replace(type, '_', ' ');
        table.rows.push_back({name, type, entry(soil, "density"), peak_of(soil), residual_of(soil),
                              entry(law, "E_MPa"), entry(law, "nu"),
                              k.is_array() ? rounded(k.at(0).get<double>(), 3) : "-"});
    }
    return table;
}

Table assumptions_of(const json& scene) {
    Table table{"assumptions", "Notes of the scene", {"of", "note"}, {}};
    const auto add = [&](const std::string& of, const json& part) {
        if (!part.is_object()) return;
        const json notes = part.value("notes", json::array());
        for (const json& each : notes.is_array() ? notes : json::array({notes}))
            if (each.is_string()) table.rows.push_back({of, each});
    };
    add("scene", scene);
    const json materials = scene.value("materials", json::object());
    for (const auto& [name, soil] : materials.items()) add(name, soil);
    for (const auto& [key, title] :
         {std::pair("lem", "limit equilibrium"), std::pair("fem", "finite elements"),
          std::pair("transfer", "transfer"), std::pair("mpm", "runout")})
        add(title, scene.value(key, json()));
    return table;
}

}  // namespace

void add_inputs(const Material& from, Document& document) {
    const json& scene = from.run.scene;
    Chapter chapter{"Inputs", "The table of variants lists their changes, the annex every entry."};
    chapter.drawing = drawing_of(from.run);
    chapter.tables.push_back(soils_of(scene));
    if (Table notes = assumptions_of(scene); !notes.rows.empty())
        chapter.tables.push_back(std::move(notes));
    document.chapters.push_back(std::move(chapter));
}

void add_annex(const Material& from, Document& document) {
    const json& scene = from.run.scene;
    const std::vector<SceneEntry> entries = entries_read(from.run, scene);
    const auto defaults = std::ranges::count_if(entries, &SceneEntry::is_default);
    Chapter chapter{"Annex: the scene, entry by entry",
                    std::to_string(entries.size()) + " entries, " + std::to_string(defaults) +
                        " of them at the program's own value (*)."};
    chapter.tables.push_back(regions_of(scene, entries));
    for (Table& each : materials_of(scene, entries)) chapter.tables.push_back(std::move(each));
    for (Table& each : tables_of(entries)) chapter.tables.push_back(std::move(each));
    chapter.opens_page = true;
    document.chapters.push_back(std::move(chapter));
}

}  // namespace breach::report
