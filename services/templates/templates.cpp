// From options to a scene and its study, for `breach new` and POST /v1/templates/{name}. Defaults
// are fitted to each other first, then refused or accepted together, and only then is geometry
// made.
#include "services/templates/templates.hpp"

#include <cmath>
#include <regex>
#include <sstream>

#include "core/scene/reading.hpp"
#include "services/templates/assembly.hpp"

namespace breach::templates {

using Json = nlohmann::ordered_json;
using nlohmann::json;

namespace {

Outline outline_of(const Values& values) {
    const std::string& name = values.of().name;
    if (name == "upstream_dam") return upstream_dam(values);
    if (name == "downstream_dam") return downstream_dam(values);
    return name == "slope" ? slope(values) : heap(values);
}

/// Rounds lengths that appear in the scene to readable digits.
/// Only those that follow from others; what the user gave stays as given.
void round_sizes(Values& values) {
    for (const Option& each : values.of().options) {
        if (each.kind != Kind::number || each.follows.empty()) continue;
        values.set(each.name, std::round(values[each.name] * 1e3) / 1e3);
    }
}

/// By default two cells across the weak layer, the least that resolve sliding along it, unless that
/// multiplies the cost by more than 27; and a cell of firm ground below it.
void fit_weak_layer(Values& values, const json& given) {
    const double clay = values["clay_thickness"], cell = values["cell_size"];
    if (clay == 0.0) return;
    // What the user gave stays: check_sizes() refuses it if it does not resolve the layer.
    if (!given.contains("cell_size"))
        values.set("cell_size", std::clamp(0.5 * clay, cell / 3, cell));
    if (!given.contains("foundation_depth"))
        values.set("foundation_depth",
                   std::max(values["foundation_depth"], clay + values["cell_size"]));
}

/// Checks that need no geometry and are the same for all templates.
void check_sizes(const Values& values) {
    const double H = values["height"];
    Refusal refusal(values);
    refusal.unless(values["cell_size"] <= 0.5 * std::min(values["layer_thickness"], H), "cell_size",
                   "layers are " + metres(values["layer_thickness"]) +
                       " thick, and two cells across them are the least",
                   "give at most half of layer_thickness");
    const double depth = values["foundation_depth"];
    refusal.unless(depth == 0.0 || depth >= values["cell_size"], "foundation_depth",
                   "that is less than a cell", "give 0, or at least cell_size");
    const double clay = values["clay_thickness"];
    const double cell = values["cell_size"];
    refusal.unless(clay == 0.0 || (clay >= cell && clay <= depth - cell), "clay_thickness",
                   "the weak layer and the foundation of " + metres(depth) +
                       " below it have at least one cell of " + metres(cell) + " each",
                   "give 0, at least cell_size, or a deeper foundation_depth");
    refusal.unless(values["layer_thickness"] <= H, "layer_thickness",
                   "the soil is only " + metres(H) + " high", "give at most height");
    refusal.unless(values["layer_thickness"] >= H / 20, "layer_thickness",
                   "there would be more than 20 layers", "give at least height / 20");
    refusal.unless(values["residual_ratio"] <= values["peak_ratio"], "residual_ratio",
                   "liquefied soil is weaker than before", "give less than peak_ratio");
    refusal.unless(values["runout_extent"] >= values["foundation_extent"] + 2 * values["cell_size"],
                   "runout_extent",
                   "the foundation reaches to " + metres(values["foundation_extent"]),
                   "give more than foundation_extent");
    refusal.unless(!values.is_on("with_fem") || values["foundation_depth"] > 0.0,
                   "foundation_depth", "the earthquake comes through the foundation",
                   "give a depth, or leave with_fem out");
    refusal.unless(!values.is_on("with_fem") || values["element_size"] <= 0.25 * H, "element_size",
                   "that leaves fewer than four elements to a height of " + metres(H),
                   "give at most height / 4");
    refusal.speak();
}

/// The pattern of names in the schema of studies.
std::string name_in(const Template& of, const json& options) {
    if (!options.is_object() || !options.contains("name")) return of.name;
    const json& name = options.at("name");
    static const std::regex allowed("^[a-z0-9][a-z0-9_-]{0,63}$");
    if (name.is_string() && std::regex_search(name.get<std::string>(), allowed)) return name;
    throw fault::BadInput(
        "template " + of.name,
        {{"/name", "is " + name.dump().substr(0, 60),
          "give lower-case letters, digits, _ and -, at most 64, a letter or digit first"}});
}

/// A fault that remains is ours, unless it is the cells': the user gets its text, but no pointer
/// into a scene that no one has seen yet.
void check_made(const Values& values, const Json& scene) {
    std::vector<fault::Fault> faults = scene::read_text(scene.dump(), "scene", ".", {}).faults;
    if (faults.empty()) return;
    for (fault::Fault& each : faults) {
        const bool coarse = each.pointer == "/mpm/cell_size";
        if (coarse)
            each.pointer = "/cell_size";
        else
            each.cause = "the section comes out wrong: " + each.pointer + " " + each.cause;
        if (!coarse) each.pointer = "";
    }
    throw fault::BadInput("template " + values.of().name, std::move(faults));
}

/// JSON's library would write 30.0 and one number per line; a person edits these files.
std::string on_a_line(const Json& value) {
    const double number = value.is_number_float() ? value.get<double>() : 0.5;
    if (std::abs(number) < 1e9 && number == std::round(number))
        return std::to_string(std::lround(number));  // 30, not 30.0
    if (value.is_primitive() || value.empty()) return value.dump();
    std::string text;
    for (const auto& [key, each] : value.items())
        text += (text.empty() ? "" : ", ") + (value.is_object() ? Json(key).dump() + ": " : "") +
                on_a_line(each);
    return value.is_object() ? "{ " + text + " }" : "[" + text + "]";
}

/// Writes short entries on one line.
void write(std::ostream& out, const Json& value, std::size_t indent) {
    constexpr std::size_t width = 110;
    const std::string line = on_a_line(value);
    if (value.is_primitive() || (indent > 0 && line.size() + indent <= width)) {
        out << line;
        return;
    }
    const std::string margin(indent + 4, ' ');
    bool first = true;
    out << (value.is_object() ? "{" : "[");
    for (const auto& [key, each] : value.items()) {
        out << (first ? "\n" : ",\n") << margin;
        if (value.is_object()) out << Json(key).dump() << ": ";
        write(out, each, indent + 4);
        first = false;
    }
    out << "\n" << std::string(indent, ' ') << (value.is_object() ? "}" : "]");
}

}  // namespace

Made make(const std::string& name, const json& options) {
    const Template& of = named(name);
    const std::string scene_name = name_in(of, options);
    Values values = completed(of, options);
    fit_weak_layer(values, options);
    round_sizes(values);
    check_sizes(values);
    Made made;
    // After fitting and rounding, so that sending them again makes the same scene.
    made.options = values.as_json();
    made.scene = scene_of(values, outline_of(values), scene_name);
    check_made(values, made.scene);
    made.study = study_of(values, made.scene);
    if (values.is_on("with_fem")) made.motion = earthquake::text_of(motion_in(values));
    return made;
}

std::string as_text(const Json& document) {
    std::ostringstream text;
    write(text, document, 0);
    text << "\n";
    return text.str();
}

}  // namespace breach::templates
