#include "services/orchestrator/http/stored_scene.hpp"

#include <algorithm>
#include <charconv>

#include "core/exchange/provenance.hpp"
#include "core/scene/file_paths.hpp"
#include "core/scene/schema.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

constexpr std::string_view by_content = "sha256/";

/// "NAME@3" -> 3; nothing: no version given; 0: not a version.
std::optional<std::int64_t> version_in(const std::string& address) {
    const std::size_t at = address.find('@');
    if (at == std::string::npos) return std::nullopt;
    std::int64_t version = 0;
    const char* const end = address.data() + address.size();
    const auto parsed = std::from_chars(address.data() + at + 1, end, version);
    return parsed.ec == std::errc{} && parsed.ptr == end ? version : 0;
}

}  // namespace

bool is_scene_name(const std::string& text) {
    const auto fits = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    };
    return !text.empty() && text.size() <= 64 && text[0] != '_' && text[0] != '-' &&
           std::ranges::all_of(text, fits) && !exchange::is_sha256(text);
}

std::optional<FoundScene> find_scene(const Store& store, const std::string& address) {
    const std::string digits =
        address.starts_with(by_content) ? address.substr(by_content.size()) : address;
    if (exchange::is_sha256(digits)) {
        auto scene = store.scene(digits);
        if (!scene) return std::nullopt;
        return FoundScene{std::move(*scene), {digits, std::nullopt, std::nullopt}};
    }
    const auto version = version_in(address);
    for (const SceneName& each : store.versions_of_scene(address.substr(0, address.find('@')))) {
        if (version && each.version != *version) continue;
        auto scene = store.scene(each.sha256);
        if (!scene) return std::nullopt;
        return FoundScene{std::move(*scene), {each.sha256, each.name, each.version}};
    }
    return std::nullopt;
}

ResolvedStudy resolved_study(const Store& store, const std::string& text) {
    if (text.find("\"" + std::string(scene::stored_scene)) == std::string::npos)
        return {text, std::nullopt};
    json study = scene::parse_json(text, "study");
    if (!study.is_object() || !study.contains("scene") || !study["scene"].is_string() ||
        !study["scene"].get_ref<const std::string&>().starts_with(scene::stored_scene))
        return {text, std::nullopt};
    const std::string reference = study["scene"];
    auto found = find_scene(store, reference.substr(scene::stored_scene.size()));
    if (!found)
        throw fault::BadInput(
            "study",
            {{"/scene", "there is no stored scene " + reference,
              "store it (POST /v1/scenes?name=...; breach scenes add) or give one of GET "
              "/v1/scenes as scene:NAME, scene:NAME@VERSION or scene:sha256/<64 digits>"}});
    study["scene"] = json::parse(found->scene.document);
    return {study.dump(), std::move(found->source)};
}

}  // namespace breach::orchestrator
