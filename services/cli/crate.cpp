#include "services/cli/crate.hpp"

#include <algorithm>
#include <sstream>

#include "core/scene/file_paths.hpp"
#include "services/cli/address.hpp"
#include "services/cli/table.hpp"
#include "services/cli/views.hpp"

namespace breach::cli {

using nlohmann::json;

namespace {

constexpr const char* crate_specification = "https://w3id.org/ro/crate/1.1";
constexpr const char* process_profile = "https://w3id.org/ro/wfrun/process/0.5";

json reference(const std::string& id) { return {{"@id", id}}; }

/// Id of an entity that is not a file.
std::string anchor(const std::string& name) { return std::string("#").append(name); }

/// Relative URI of a file in the crate.
std::string uri_of(const std::string& path) {
    std::istringstream parts(path);
    std::string uri;
    for (std::string part; std::getline(parts, part, '/');)
        uri.append(uri.empty() ? "" : "/").append(percent_encoded(part));
    return uri;
}

std::string media_type(const std::string& path) {
    if (path.ends_with(".json") || path.ends_with(".series")) return "application/json";
    if (path.ends_with(".jsonl")) return "application/jsonl";
    if (path.ends_with(".csv")) return "text/csv";
    if (path.ends_with(".txt")) return "text/plain";
    if (path.ends_with(".vtkhdf") || path.ends_with(".h5")) return "application/x-hdf5";
    return "application/octet-stream";
}

const char* status_of(const json& task) {
    const std::string state = task.at("state");
    if (state == "succeeded" || state == "cached") return "http://schema.org/CompletedActionStatus";
    if (is_final_task(task)) return "http://schema.org/FailedActionStatus";
    return "http://schema.org/ActiveActionStatus";
}

/// Copies a text of the server's answer; skips null and missing entries.
void copy_text(json& to, const char* name, const json& from, const char* key) {
    const auto found = from.find(key);
    if (found != from.end() && found->is_string()) to[name] = *found;
}

}  // namespace

void Crate::add_file(const CrateFile& file) {
    const std::string uri = uri_of(file.path);
    json entry{{"@id", uri},
               {"@type", "File"},
               {"name", file.path},
               {"contentSize", std::to_string(file.bytes)},
               {"encodingFormat", media_type(file.path)},
               {"sha256", file.sha256}};
    if (!file.description.empty()) entry["description"] = file.description;
    files_.push_back(std::move(entry));
    first_with_hash_.emplace(file.sha256, uri);
}

void Crate::add_action(const json& task, const json& provenance,
                       const std::vector<std::string>& outputs) {
    if (task.at("attempts").empty() && outputs.empty()) return;
    const std::string version =
        provenance.is_object() ? provenance.value("version", std::string()) : std::string();
    json action{{"@id", anchor(task.at("id"))},
                {"@type", "CreateAction"},
                {"name", name_of_task(task)},
                {"instrument", reference(program_of(task.at("phase"), version))},
                {"actionStatus", status_of(task)},
                {"object", inputs_of(provenance)},
                {"result", json::array()}};
    copy_text(action, "startTime", task, "started");
    copy_text(action, "endTime", task, "finished");
    if (task.contains("fault") && task["fault"].is_object())
        copy_text(action, "error", task["fault"], "summary");
    for (const std::string& each : outputs) action["result"].push_back(reference(uri_of(each)));
    actions_.push_back(std::move(action));
}

json Crate::inputs_of(const json& provenance) const {
    json inputs = json::array({reference("study.json")});
    if (!provenance.is_object() || !provenance.contains("inputs")) return inputs;
    for (const json& each : provenance["inputs"]) {
        const auto found = first_with_hash_.find(each.value("sha256", std::string()));
        if (found != first_with_hash_.end()) inputs.push_back(reference(found->second));
    }
    if (provenance.value("phase", "") != "fem_solver") return inputs;  // only this phase reads them
    for (const auto& each : scene::references_in(provenance)) {
        const auto found = first_with_hash_.find(each.sha256);
        if (found != first_with_hash_.end()) inputs.push_back(reference(found->second));
    }
    return inputs;
}

std::string Crate::program_of(const std::string& phase, const std::string& version) {
    const std::string id = anchor(version.empty() ? phase : phase + "-" + version);
    const bool known =
        std::ranges::any_of(programs_, [&](const json& each) { return each["@id"] == id; });
    if (!known) {
        json program{
            {"@id", id}, {"@type", "SoftwareApplication"}, {"name", "Breachline " + phase}};
        if (!version.empty()) program["softwareVersion"] = version;
        programs_.push_back(std::move(program));
    }
    return id;
}

json Crate::metadata(const json& run) const {
    json root{{"@id", "./"},
              {"@type", "Dataset"},
              {"name", "Breachline run " + cell(run, "name")},
              {"description", cell(run, "title")},
              {"identifier", cell(run, "id")},
              {"conformsTo", reference(process_profile)},
              {"hasPart", json::array()},
              {"mentions", json::array()}};
    copy_text(root, "dateCreated", run, "created");
    copy_text(root, "datePublished", run, "created");
    copy_text(root, "datePublished", run, "finished");
    json graph = json::array({{{"@id", "ro-crate-metadata.json"},
                               {"@type", "CreativeWork"},
                               {"about", reference("./")},
                               {"conformsTo", reference(crate_specification)}}});
    for (const json& each : files_) root["hasPart"].push_back(reference(each["@id"]));
    for (const json& each : actions_) root["mentions"].push_back(reference(each["@id"]));
    graph.push_back(std::move(root));
    graph.push_back({{"@id", process_profile},
                     {"@type", "CreativeWork"},
                     {"name", "Process Run Crate"},
                     {"version", "0.5"}});
    for (const json* part : {&files_, &actions_, &programs_})
        for (const json& each : *part) graph.push_back(each);
    return {{"@context", std::string(crate_specification) + "/context"},
            {"@graph", std::move(graph)}};
}

}  // namespace breach::cli
