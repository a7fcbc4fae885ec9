#include "core/scene/scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <sstream>

#include "core/scene/plausibility.hpp"
#include "core/scene/reader.hpp"
#include "core/scene/reading.hpp"
#include "core/scene/resolution.hpp"
#include "core/scene/sand.hpp"
#include "core/scene/schema.hpp"

namespace breach::scene {

using fault::Fault;
using nlohmann::json;

namespace {

template <class Part>
const Part& part_of(const std::optional<Part>& part, const Scene& scene, const char* pointer) {
    if (part) return *part;
    throw fault::BadInput(scene.name,
                          {{pointer, "is missing, and this phase needs it",
                            "add it to the scene (see workflows/schema/scene.schema.json)"}});
}

/// Writes 2.0 as 2: equal scenes have equal texts (browsers omit the point), and so share results
/// and checkpoints.
void write_whole_numbers_without_point(json& value) {
    constexpr double every_one_below = 9007199254740992.0;  // 2^53
    if (value.is_structured()) {
        for (json& each : value) write_whole_numbers_without_point(each);
    } else if (value.is_number_float()) {
        const auto number = value.get<double>();
        if (std::abs(number) < every_one_below && number == std::trunc(number))
            value = static_cast<std::int64_t>(number);
    }
}

}  // namespace

std::string text_of(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    std::error_code error;
    if (!stream || std::filesystem::is_directory(file, error)) {
        throw fault::IoError(file.string() +
                             ": cannot be read; check the path and its permissions");
    }
    return text.str();
}

Reading read_text(std::string_view text, const std::string& name,
                  const std::filesystem::path& folder, const std::vector<std::string>& overrides) {
    return read_document(parse_json(text, name), name, folder, overrides);
}

Reading read_document(json document, const std::string& name, const std::filesystem::path& folder,
                      const std::vector<std::string>& overrides) {
    fault::FirstFaults of_overrides;
    for (const std::string& each : overrides)
        for (Fault& found : apply_override(document, each)) of_overrides.add(std::move(found));
    if (of_overrides.more > 0)
        throw fault::BadInput(name, std::move(of_overrides.faults), of_overrides.more);
    std::vector<Fault>& faults = of_overrides.faults;
    std::vector<fault::Flag> warnings;
    for (Fault& found : complete_and_check(document, scene_schema(), name, warnings))
        faults.push_back(std::move(found));
    if (!document.is_object()) throw fault::BadInput(name, faults);

    Scene scene{};
    scene.warnings = std::move(warnings);
    Reader reader(document, faults);
    if (reader.sound("/gravity")) scene.gravity = document.at("gravity");
    if (reader.sound("/thickness")) scene.thickness = document.at("thickness");
    const auto& [found, more] = reader.found();
    read_materials(reader, scene);
    read_section(reader, scene);
    if (more > 0) throw fault::BadInput(name, found, more);  // others compare all regions
    read_lem(reader, scene);
    read_fem(reader, folder, scene);
    read_transfer(reader, scene);
    read_mpm(reader, scene);
    warn_about_together(reader, scene);
    Resolved resolved = resolution_of(scene);
    for (Fault& each : resolved.faults) {
        if (!reader.sound(each.pointer)) continue;  // wrong unit, already reported
        reader.add(each.pointer, std::move(each.cause), std::move(each.remedy));
    }
    std::ranges::move(resolved.flags, std::back_inserter(scene.warnings));
    if (more > 0) throw fault::BadInput(name, found, more);
    if (!found.empty()) return {std::move(scene), found, nullptr};

    for (json& material : document.at("materials")) complete_sand(material.at("law"));
    scene.name = document.at("name");
    scene.title = document.at("title");
    write_whole_numbers_without_point(document);
    scene.completed = document.dump();
    return {std::move(scene), {}, std::move(document)};
}

Scene parse_scene(std::string_view text, const std::string& name,
                  const std::filesystem::path& folder, const std::vector<std::string>& overrides) {
    Reading reading = read_text(text, name, folder, overrides);
    if (!reading.faults.empty()) throw fault::BadInput(name, std::move(reading.faults));
    return std::move(reading.scene);
}

Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
    return parse_scene(text_of(file), file.string(), file.parent_path(), overrides);
}

const Fem& fem_of(const Scene& scene) { return part_of(scene.fem, scene, "/fem"); }
const Lem& lem_of(const Scene& scene) { return part_of(scene.lem, scene, "/lem"); }
const Transfer& transfer_of(const Scene& scene) {
    return part_of(scene.transfer, scene, "/transfer");
}
const Mpm& mpm_of(const Scene& scene) { return part_of(scene.mpm, scene, "/mpm"); }

}  // namespace breach::scene
