// Stored scenes, by the SHA-256 of their completed text and by name.
#include "core/exchange/provenance.hpp"
#include "core/scene/file_paths.hpp"
#include "services/findings/flags.hpp"
#include "services/orchestrator/http/answers.hpp"
#include "services/orchestrator/http/http_routes.hpp"
#include "services/orchestrator/http/http_submission.hpp"
#include "services/orchestrator/http/sent_documents.hpp"
#include "services/orchestrator/http/stored_scene.hpp"
#include "services/orchestrator/records/or_null.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

json as_json(const SceneName& name) {
    return {{"name", name.name},
            {"version", name.version},
            {"sha256", name.sha256},
            {"created", name.created}};
}

json as_json(const StoredScene& scene) {
    json names = json::array();
    for (const SceneName& each : scene.names) names.push_back(as_json(each));
    return {{"sha256", scene.sha256},
            {"reference", std::string(scene::stored_scene) + "sha256/" + scene.sha256},
            {"bytes", scene.bytes},
            {"created", scene.created},
            {"names", names},
            {"runs", scene.runs}};
}

FoundScene wanted_scene(const Service& service, const std::string& address) {
    auto found = find_scene(service.store, address);
    if (!found) throw not_found("stored scene " + address);
    return std::move(*found);
}

/// 201: stored; 200: the scene, or the name with this scene, existed.
void keep_scene(Service& service, Call& call) {
    call.allow_parameters({"name"});
    const auto name = call.parameter("name");
    if (name && !is_scene_name(*name))
        throw bad_request(
            "name must be 1 to 64 of a-z, 0-9, _ and -, beginning with a letter or a digit, and "
            "not "
            "the digits of a hash");
    const auto [scene, warnings] = sent_scene(call.json_body(), service);
    NewScene kept{.sha256 = {}, .document = scene.dump(), .files = {}};
    kept.sha256 = exchange::sha256_of_text(kept.document);
    for (const auto& each : scene::references_in(scene)) kept.files.push_back(each.sha256);
    const bool is_new = service.store.write(call.caller.name, [&](Transaction& transaction) {
        return transaction.keep_scene(kept, name);
    });
    call.response.set_header("Location", "/v1/scenes/" + kept.sha256);
    json answer = as_json(wanted_scene(service, kept.sha256).scene);
    answer["warnings"] = findings::as_json(warnings);
    reply(call.response, answer, is_new ? 201 : 200);
}

void list_scenes(const Service& service, Call& call) {
    call.allow_parameters({"limit", "cursor", "name", "search"});
    const std::size_t length = wanted_length(call);
    SceneFilter filter{.name = call.parameter("name"), .search = call.parameter("search")};
    if (const auto cursor = call.parameter("cursor")) filter.before = place_of(*cursor);
    std::vector<StoredScene> scenes = service.store.scenes(filter, length + 1);
    const json next = cut_to(
        length, scenes, [](const StoredScene& last) { return last.created + "~" + last.sha256; });
    json list = json::array();
    for (const StoredScene& each : scenes) list.push_back(as_json(each));
    reply(call.response, {{"scenes", std::move(list)}, {"next", next}});
}

void show_scene(const Service& service, Call& call) {
    call.allow_parameters({});
    const FoundScene found = wanted_scene(service, call.parts[0]);
    json body = as_json(found.scene);
    body["scene"] = json::parse(found.scene.document);
    body["name"] = or_null(found.source.name);
    body["version"] = or_null(found.source.version);
    body["versions"] = json::array();
    if (found.source.name)
        for (const SceneName& each : service.store.versions_of_scene(*found.source.name))
            body["versions"].push_back(as_json(each));
    reply(call.response, body);
}

void remove_scene(Service& service, Call& call) {
    call.allow_parameters({});
    const std::string& address = call.parts[0];
    if (address.find('@') != std::string::npos)
        throw bad_request(
            "a single version cannot be removed: a run may refer to its number; remove the "
            "whole "
            "name, or a content by its SHA-256");
    const bool content = exchange::is_sha256(address);
    std::int64_t bytes = 0;
    if (content)
        if (const auto scene = service.store.scene(address)) bytes = scene->bytes;
    const Removal outcome = service.store.write(call.caller.name, [&](Transaction& transaction) {
        return content ? transaction.forget_scene(address) : transaction.forget_scene_name(address);
    });
    if (outcome == Removal::needed)
        throw Problem{409, "/problems/needed", "Needed",
                      content
                          ? "a name stands for this scene, or a run was made of it: remove them "
                            "first (GET /v1/scenes/" +
                                address + " lists them)"
                          : "runs were made of the scene by this name: remove them first (GET "
                            "/v1/scenes/" +
                                address + " lists them)"};
    if (outcome == Removal::unknown) throw not_found("stored scene " + address);
    reply(call.response, {{"id", address}, {"freed_bytes", bytes}}, 202);
}

}  // namespace

json scene_source_json(const Service& service, const std::string& run) {
    const auto source = service.store.scene_source_of(run);
    if (!source) return nullptr;
    return {{"sha256", source->sha256},
            {"name", or_null(source->name)},
            {"version", or_null(source->version)}};
}

void add_scene_routes(Router& router, Service& service) {
    router.post("/v1/scenes", [&](Call& call) { keep_scene(service, call); });
    router.get("/v1/scenes", [&](Call& call) { list_scenes(service, call); });
    router.get("/v1/scenes/{scene}", [&](Call& call) { show_scene(service, call); });
    router.remove("/v1/scenes/{scene}", [&](Call& call) { remove_scene(service, call); });
}

}  // namespace breach::orchestrator
