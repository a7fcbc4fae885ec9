// Inside core/scene only: the completed document, the faults so far, and which parts are valid.
#pragma once

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "core/scene/scene.hpp"
#include "core/scene/words.hpp"

namespace breach::scene {

constexpr double kPa = 1e3;  // Pa

class Reader {
  public:
    Reader(const nlohmann::json& document, const std::vector<fault::Fault>& faults)
        : document_(document) {
        for (const fault::Fault& each : faults) add(each.pointer, each.cause, each.remedy);
    }

    const nlohmann::json& document() const { return document_; }
    const fault::FirstFaults& found() const { return found_; }
    void add(std::string pointer, std::string cause, std::string remedy) {
        pointers_.insert(pointer);
        found_.add({std::move(pointer), std::move(cause), std::move(remedy)});
    }
    /// Adds a warning, as a possible reason, to every fault in or below the same object, unless
    /// that is a top-level object.
    void explain(const fault::Flag& warn) {
        const std::string object = warn.pointer.substr(0, warn.pointer.rfind('/'));
        if (object.find('/', 1) == std::string::npos) return;
        for (fault::Fault& each : found_.faults) {
            const bool same = each.pointer == warn.pointer;  // already mentioned
            if (same || each.pointer.rfind(object + "/", 0) != 0) continue;
            each.remedy += "; " + warn.pointer + ": " + warn.message;
        }
    }

    /// True if the entry exists and the schema found no fault at it or below it. Such an entry may
    /// be read although other parts of the scene are faulty.
    bool sound(const std::string& pointer) const {
        if (!document_.contains(nlohmann::json::json_pointer(pointer))) return false;
        const auto below = pointers_.lower_bound(pointer + "/");
        return !pointers_.contains(pointer) &&
               (below == pointers_.end() || !below->starts_with(pointer + "/"));
    }

  private:
    const nlohmann::json& document_;
    fault::FirstFaults found_;
    std::set<std::string> pointers_;  ///< of all faults
};

inline Vec2 point_from(const nlohmann::json& value) {
    return {value.at(0).get<double>(), value.at(1).get<double>()};
}

inline std::array<double, 2> range_from(const nlohmann::json& value) {
    return {value.at(0).get<double>(), value.at(1).get<double>()};
}

/// The strength profile of /materials/<name>; none if it is absent or faulty.
std::optional<materials::StrengthProfile> strength_from(Reader& reader, const std::string& name);

/// Each checks what the schema cannot express and fills the valid parts of `scene`.
void read_materials(Reader& reader, Scene& scene);
void read_section(Reader& reader, Scene& scene);
void read_lem(Reader& reader, Scene& scene);
void read_fem(Reader& reader, const std::filesystem::path& folder, Scene& scene);
void read_transfer(Reader& reader, Scene& scene);
void read_mpm(Reader& reader, Scene& scene);

}  // namespace breach::scene
