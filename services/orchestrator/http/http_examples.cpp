// The shipped studies as POST /v1/runs takes them: with the scene inside, and paths of motions
// absolute, since a document that is sent has no folder. Read from the disk at each request.
#include <algorithm>

#include "core/scene/file_paths.hpp"
#include "services/orchestrator/http/http_routes.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

/// The study with its scene, as POST /v1/runs accepts it; nothing: the file is not a study.
std::optional<json> example_in(const std::filesystem::path& file) {
    json study = json::parse(whole_text(file), nullptr, false);
    // Other JSON files may lie beside the studies.
    if (!study.is_object() || !study.contains("name")) return std::nullopt;
    if (study.contains("scene") && study["scene"].is_string()) {
        const auto scene_file = file.parent_path() / study["scene"].get<std::string>();
        const auto folder = scene_file.parent_path();
        study["scene"] = json::parse(whole_text(scene_file), nullptr, false);
        scene::make_files_absolute(study["scene"], folder);
        scene::make_override_files_absolute(study, folder);
    }
    const bool whole = study.contains("scene") && study["scene"].is_object();
    return whole ? std::optional(std::move(study)) : std::nullopt;
}

std::vector<json> examples_in(const std::filesystem::path& folder) {
    std::vector<json> found;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
        if (entry.path().extension() != ".json") continue;
        if (auto study = example_in(entry.path())) found.push_back(std::move(*study));
    }
    // The file system gives them in any order.
    std::ranges::sort(found, {}, [](const json& each) { return each.at("name").dump(); });
    return found;
}

void list(const Service& service, Call& call) {
    call.allow_parameters({});
    json examples = json::array();
    for (const json& each : examples_in(service.workflows / "studies"))
        examples.push_back({{"name", each.at("name")}, {"title", each.value("title", "")}});
    reply(call.response, {{"examples", examples}});
}

/// By the study's name, not the file's: it is what the list gives.
void show(const Service& service, Call& call) {
    call.allow_parameters({});
    for (const json& each : examples_in(service.workflows / "studies"))
        if (each.at("name") == call.parts[0]) return reply(call.response, each);
    throw not_found("example " + call.parts[0]);
}

}  // namespace

void add_example_routes(Router& router, Service& service) {
    router.get("/v1/examples", [&](Call& call) { list(service, call); });
    router.get("/v1/examples/{name}", [&](Call& call) { show(service, call); });
}

}  // namespace breach::orchestrator
