// Inside core/scene only: the completed document, the faults so far, and which parts are valid.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/scene/scene.hpp"
#include "core/scene/words.hpp"

namespace breach::scene {

constexpr double kPa = 1e3;  // Pa

class Reader {
  public:
    Reader(const nlohmann::json& document, std::vector<fault::Fault> faults)
        : document_(document), faults_(std::move(faults)) {}

    const nlohmann::json& document() const { return document_; }
    const std::vector<fault::Fault>& faults() const { return faults_; }
    void add(std::string pointer, std::string cause, std::string remedy) {
        faults_.push_back({std::move(pointer), std::move(cause), std::move(remedy)});
    }
    /// Adds a warning, as a possible reason, to every fault in or below the same object, unless
    /// that is a top-level object.
    void explain(const fault::Flag& warn) {
        const std::string object = warn.pointer.substr(0, warn.pointer.rfind('/'));
        if (object.find('/', 1) == std::string::npos) return;
        for (fault::Fault& each : faults_) {
            const bool same = each.pointer == warn.pointer;  // already mentioned
            if (same || each.pointer.rfind(object + "/", 0) != 0) continue;
            each.remedy += "; " + warn.pointer + ": " + warn.message;
        }
    }

    /// True if the entry exists and the schema found no fault at it or below it. Such an entry may
    /// be read although other parts of the scene are faulty.
    bool sound(const std::string& pointer) const {
        if (!document_.contains(nlohmann::json::json_pointer(pointer))) return false;
        for (const fault::Fault& each : faults_) {
            const bool at = each.pointer == pointer;
            const bool below = each.pointer.rfind(pointer + "/", 0) == 0;
            if (at || below) return false;
        }
        return true;
    }

  private:
    const nlohmann::json& document_;
    std::vector<fault::Fault> faults_;
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
