// Called for each phase of each variant when tasks are planned. Files count by their bytes, so
// that a moved file hits the cache and a changed one does not.
#include "services/orchestrator/study/recipe.hpp"

#include <algorithm>

#include "core/exchange/provenance.hpp"
#include "core/fault/fault.hpp"
#include "core/phases/reads.hpp"
#include "core/scene/file_paths.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

/// A reference has the hash in it; any other file is read at each planning.
json content_of(const std::string& file) {
    if (const auto reference = scene::file_reference(file)) return {{"sha256", reference->sha256}};
    try {
        return {{"sha256", exchange::sha256_of_file(file)}};
    } catch (const fault::IoError&) {
        return file;  // the phase reports the fault; failures are never reused
    }
}

/// RFC 6901.
std::string escaped(const std::string& key) {
    std::string text;
    for (const char each : key) {
        if (each == '~')
            text += "~0";
        else if (each == '/')
            text += "~1";
        else
            text += each;
    }
    return text;
}

void collect(const json& a, const json& b, const std::string& at, std::vector<std::string>& found) {
    if (a == b) return;
    if (a.is_object() && b.is_object()) {
        for (const auto& [key, value] : a.items()) {
            if (b.contains(key)) {
                collect(value, b.at(key), at + "/" + escaped(key), found);
            } else {
                found.push_back(at + "/" + escaped(key));
            }
        }
        for (const auto& [key, value] : b.items())
            if (!a.contains(key)) found.push_back(at + "/" + escaped(key));
        return;
    }
    if (a.is_array() && b.is_array() && a.size() == b.size()) {
        for (std::size_t i = 0; i < a.size(); ++i)
            collect(a[i], b[i], at + "/" + std::to_string(i), found);
        return;
    }
    found.push_back(at);
}

}  // namespace

/// The parts of the key are on lines of their own, so that none can run into the next.
Recipe recipe_of(const std::string& phase, const json& scene, std::int64_t numerics) {
    json part = phases::part_read_by(*phases::named(phase), scene);
    for (const std::string& key : scene::file_entries) {
        const json::json_pointer at(key);
        if (part.contains(at) && part[at].is_string())
            part[at] = content_of(part[at].get<std::string>());
    }
    Recipe recipe{.hash = {}, .phase = phase, .cache_version = numerics, .part = part.dump()};
    recipe.hash =
        exchange::sha256_of_text(phase + "\n" + std::to_string(numerics) + "\n" + recipe.part);
    return recipe;
}

std::vector<std::string> differences(const json& a, const json& b) {
    std::vector<std::string> found;
    collect(a, b, "", found);
    return found;
}

}  // namespace breach::orchestrator
