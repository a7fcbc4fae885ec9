// A completed scene has every default written into it. To show a reader what the author chose, each
// entry is compared with the schema's default; what is derived from other entries counts as a
// default too.
#include "services/orchestrator/scene_entries.hpp"

#include <algorithm>

#include "core/scene/sand.hpp"
#include "core/scene/schema.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

const json none = json::object();

/// The schema, or the target of its $ref.
const json& resolved(const json& schema) {
    if (!schema.contains("$ref")) return schema;
    const std::string to = schema.at("$ref");  // "#/$defs/point"
    return scene::scene_schema().at(json::json_pointer(to.substr(1)));
}

/// By "type" where the alternatives have one, else by the JSON type; the first that fits counts.
bool is_meant(const json& value, const json& alternative) {
    const json& type = alternative.value("/properties/type/const"_json_pointer, json());
    if (!type.is_null()) return value.is_object() && value.value("type", json()) == type;
    const std::string wanted = alternative.value("type", "");
    return (value.is_object() && wanted == "object") || (value.is_array() && wanted == "array") ||
           (value.is_string() && wanted == "string") ||
           (value.is_boolean() && wanted == "boolean") ||
           (value.is_number() && (wanted == "number" || wanted == "integer"));
}

/// The schema of this value: the matching alternative of several.
const json& schema_for(const json& value, const json& schema) {
    const json& all = resolved(schema);
    if (!all.contains("oneOf")) return all;
    for (const json& each : all.at("oneOf"))
        if (is_meant(value, resolved(each))) return resolved(each);
    return none;
}

bool holds_objects(const json& list) {
    return std::ranges::any_of(list, [](const json& each) { return each.is_object(); });
}

class Lister {
  public:
    explicit Lister(const std::vector<std::string>& set) : set_(set) {}

    void visit(const json& value, const json& property, const std::string& pointer) {
        const json& schema = schema_for(value, property);
        // A list of numbers, such as a polygon, is one entry: its members mean nothing alone.
        if (value.is_object() && !value.empty()) {
            for (const auto& [key, member] : value.items())
                visit(member, schema_of_member(schema, key), pointer + "/" + key);
        } else if (value.is_array() && holds_objects(value)) {
            const json& items = schema.contains("items") ? schema.at("items") : none;
            for (std::size_t i = 0; i < value.size(); ++i)
                visit(value[i], items, pointer + "/" + std::to_string(i));
        } else {
            const std::string unit = schema.value("unit", "");
            // The entry has the default, not the alternatives of its oneOf.
            const json& written = resolved(property);
            const bool is_default = written.contains("default") && written.at("default") == value;
            found.push_back({pointer, value, unit == "1" ? "" : unit,
                             property.value("description", written.value("description", "")),
                             is_default && !was_set(pointer)});
        }
    }

    std::vector<SceneEntry> found;

  private:
    static const json& schema_of_member(const json& schema, const std::string& key) {
        if (schema.contains("properties") && schema.at("properties").contains(key))
            return schema.at("properties").at(key);
        const bool open = schema.contains("additionalProperties") &&
                          schema.at("additionalProperties").is_object();
        return open ? schema.at("additionalProperties") : none;
    }

    bool was_set(const std::string& pointer) const {
        return std::ranges::any_of(set_, [&](const std::string& each) {
            return pointer == each || pointer.starts_with(each + "/");
        });
    }

    const std::vector<std::string>& set_;
};

/// D_R and G_0 are given by the author; the other parameters of PM4Sand follow from them unless
/// given. Found by completing the law again without the entry.
bool follows_from_density(const json& scene, const std::string& pointer) {
    const std::size_t law = pointer.find("/law/");
    if (!pointer.starts_with("/materials/") || law == std::string::npos) return false;
    json probe = scene.at(json::json_pointer(pointer.substr(0, law + 4)));
    const std::string key = pointer.substr(law + 5);
    if (probe.value("type", "") != "pm4sand" || key == "D_R" || key == "G_0" || key == "type")
        return false;
    const json value = probe.at(key);
    probe.erase(key);
    scene::complete_sand(probe);
    return probe.value(key, json()) == value;
}

}  // namespace

std::vector<SceneEntry> entries_of(const json& scene, const std::vector<std::string>& set) {
    Lister lister(set);
    lister.visit(scene, scene::scene_schema(), "");
    for (SceneEntry& each : lister.found)
        each.is_default = each.is_default || follows_from_density(scene, each.pointer);
    return std::move(lister.found);
}

}  // namespace breach::orchestrator
