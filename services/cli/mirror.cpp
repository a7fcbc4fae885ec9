// `breach mirror`: reverses the sign of every x in a scene. The table of entries is the whole
// knowledge: an entry of the scene's schema that holds an x, or a side, must be added to it, or the
// mirrored scene mixes both directions without a fault. Lines are reversed as well, since the
// scene's readers expect them from left to right, and outlines keep their sense of rotation. Keys
// keep their order (ordered_json): the user compares the two files.
#include "services/cli/mirror.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string_view>

#include "core/exchange/publish.hpp"
#include "core/scene/schema.hpp"

namespace breach::cli {

using nlohmann::ordered_json;

namespace {

/// What an entry's numbers are. A pattern of the table names entries; * stands for any one key.
enum class Turn {
    point,   ///< [x, y]
    points,  ///< a list of them, whose order turns
    range,   ///< [least x, largest x]
    place,   ///< x
    span,    ///< an object with from and to, in x
    spans,   ///< a list of them, whose order turns
    ends,    ///< an object with points from and to, which change places
    sides,   ///< left and right change places
};

struct Entry {
    std::string_view pattern;
    Turn kind;
};

constexpr Entry entries[] = {
    {"/section/regions/*/polygon", Turn::points},
    {"/section/regions/*/mesh/corners", Turn::points},
    {"/lem/circle/center", Turn::point},
    {"/lem/search/entry", Turn::range},
    {"/lem/search/exit", Turn::range},
    {"/lem/floor", Turn::points},
    {"/lem/non_circular/given", Turn::points},
    {"/lem/water/line", Turn::points},
    {"/lem/piezometric_lines/*/line", Turn::points},
    {"/lem/surcharge/*", Turn::span},
    {"/fem/supports/*", Turn::ends},
    {"/fem/water/line", Turn::points},
    {"/fem/water/boundaries/*", Turn::ends},
    {"/fem/surcharge/*", Turn::span},
    {"/fem/stages/*/surcharge/*", Turn::span},
    {"/fem/stages/*/phreatic_line", Turn::points},
    {"/fem/stages/*/displace/*", Turn::ends},
    {"/fem/stages/*/displace/*/x", Turn::place},
    {"/fem/stages/*/pressures/*", Turn::ends},
    {"/fem/free_field/sides", Turn::sides},
    {"/fem/crest", Turn::point},
    {"/fem/liquefaction/x", Turn::range},
    {"/transfer/phreatic_line", Turn::points},
    {"/mpm/domain_x", Turn::range},
    {"/mpm", Turn::sides},
    {"/mpm/floor/friction", Turn::spans},
    {"/mpm/terrain", Turn::points},
    {"/mpm/water/line", Turn::points},
    {"/mpm/runout/toe", Turn::point},
    {"/mpm/gauges/*/x", Turn::place},
    {"/mpm/sections/*/x", Turn::place},
};

/// 0 stays 0 and does not become -0.
/// Whole numbers stay whole: 40 must not become -40.0.
void turn(ordered_json& x) {
    if (x.is_number_integer())
        x = -x.get<std::int64_t>();
    else
        x = 0.0 - x.get<double>();
}

void turn_span(ordered_json& object) {
    turn(object.at("from")), turn(object.at("to"));
    std::swap(object.at("from"), object.at("to"));
}

void swap_keys(ordered_json& object, const char* a, const char* b) {
    const bool has_a = object.contains(a), has_b = object.contains(b);
    if (!has_a && !has_b) return;
    ordered_json of_a = has_a ? object.at(a) : ordered_json(),
                 of_b = has_b ? object.at(b) : ordered_json();
    object.erase(a), object.erase(b);
    if (has_b) object[a] = of_b;
    if (has_a) object[b] = of_a;
}

void turn(ordered_json& entry, Turn kind) {
    switch (kind) {
        case Turn::point:
            return turn(entry.at(0));
        case Turn::points:
            for (ordered_json& point : entry) turn(point.at(0));
            return std::reverse(entry.begin(), entry.end());
        case Turn::range:
            turn(entry.at(0)), turn(entry.at(1));
            return std::swap(entry.at(0), entry.at(1));
        case Turn::place:
            return turn(entry);
        case Turn::span:
            return turn_span(entry);
        case Turn::spans:
            for (ordered_json& each : entry) turn_span(each);
            return std::reverse(entry.begin(), entry.end());
        case Turn::ends:
            turn(entry.at("from").at(0)), turn(entry.at("to").at(0));
            return std::swap(entry.at("from"), entry.at("to"));
        case Turn::sides:
            if (entry.is_object()) return swap_keys(entry, "left", "right");
            if (entry == "left")
                entry = "right";
            else if (entry == "right")
                entry = "left";
    }
}

/// Calls turn for every entry that fits the rest of a pattern.
void turn_all(ordered_json& node, std::string_view pattern, Turn kind) {
    if (pattern.empty()) return turn(node, kind);
    const std::size_t end = std::min(pattern.find('/', 1), pattern.size());
    const std::string key(pattern.substr(1, end - 1));
    const std::string_view rest = pattern.substr(end);
    if (key == "*") {
        for (ordered_json& each : node) turn_all(each, rest, kind);
    } else if (node.is_object() && node.contains(key)) {
        turn_all(node.at(key), rest, kind);
    }
}

/// Refused, not left out: the mirrored scene would run and answer another question.
void refuse_what_has_no_image(const ordered_json& scene, const std::string& file) {
    std::vector<fault::Fault> faults;
    for (const auto& [pointer, why] :
         {std::pair("/fem/msh_file", "is a mesh of its own file: mirror it where it was made"),
          std::pair("/transfer/liquefied/line",
                    "counts what lies left of its line: draw it again in the mirrored scene")})
        if (scene.contains(ordered_json::json_pointer(pointer)))
            faults.push_back({pointer, why, "leave it out, mirror, and put it back"});
    if (!faults.empty()) throw fault::BadInput(file, faults);
}

}  // namespace

ordered_json mirrored(ordered_json scene, const std::string& file) {
    refuse_what_has_no_image(scene, file);
    if (scene.contains("mpm"))  // the sides that are left out differ: make both explicit
        for (const char* side : {"left", "right"})
            if (!scene.at("mpm").contains(side))
                scene["mpm"][side] =
                    scene::scene_schema()["properties"]["mpm"]["properties"][side]["default"];
    for (const auto& [pattern, kind] : entries) turn_all(scene, pattern, kind);
    for (ordered_json& region : scene.at("section").at("regions"))
        if (const ordered_json::json_pointer graded("/mesh/graded"); region.contains(graded)) {
            ordered_json& strips = region.at(graded);
            for (const char* key : {"left_of", "right_of"})
                if (strips.contains(key)) turn(strips.at(key));
            swap_keys(strips, "left_of", "right_of");
        }
    // Seen from behind, an acceleration to the right points to the left. The record is not
    // rewritten.
    if (const ordered_json::json_pointer motion("/fem/motion"); scene.contains(motion)) {
        ordered_json& shaking = scene.at(motion);
        if (shaking.value("reversed", false))
            shaking.erase("reversed");
        else
            shaking["reversed"] = true;
    }
    return scene;
}

fault::ExitCode mirror(const MirrorOptions& options, const Console& console) {
    std::ifstream from(options.scene);
    if (!from) throw fault::IoError("cannot read " + options.scene.string());
    if (std::filesystem::exists(options.output))
        throw fault::BadInput(options.output.string(),
                              {{"--output", "exists", "give another file"}});
    const ordered_json scene = ordered_json::parse(from, nullptr, false);
    if (!scene.is_object() || !scene.contains("section"))
        throw fault::BadInput(options.scene.string(),
                              {{"/", "is no scene", "give a scene file (breachline-scene/1)"}});
    ordered_json turned = mirrored(scene, options.scene.string());
    // A relative path starts at the scene's folder, and the mirrored scene may be in another one.
    if (const ordered_json::json_pointer file("/fem/motion/file"); turned.contains(file)) {
        const std::filesystem::path name = turned.at(file).get<std::string>();
        const auto folder_of = [](const std::filesystem::path& of) {
            return std::filesystem::absolute(of).parent_path();
        };
        if (name.is_relative() && !name.string().starts_with("file:"))
            turned.at(file) = (folder_of(options.scene) / name)
                                  .lexically_relative(folder_of(options.output))
                                  .string();
    }
    exchange::publish_text(options.output, turned.dump(4) + "\n");
    console.notes
        << options.output.string()
        << ": x is now -x, and the motion's sense is reversed; give /mpm/runout/toe and the "
           "LEM's ranges of the face that looks to the right now\n";
    return fault::ExitCode::done;
}

}  // namespace breach::cli
