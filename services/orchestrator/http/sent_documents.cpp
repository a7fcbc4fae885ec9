// Reads studies and scenes of request bodies. File faults get another remedy here, because a
// client's paths are looked up on the service's machine.
#include "services/orchestrator/http/sent_documents.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>

#include "core/scene/file_paths.hpp"
#include "core/scene/schema.hpp"

namespace breach::orchestrator {

using fault::BadInput;
using fault::Fault;
using nlohmann::json;

namespace {

/// Decides by the format; without one, by parts that only this kind has.
bool is_a(const std::string& kind, const json& document, const char* part) {
    if (!document.is_object()) return false;
    const json format = document.value("format", json());
    if (!format.is_string()) return document.contains(part);
    return format.get_ref<const std::string&>().starts_with("breachline-" + kind + "/");
}

std::string this_machine() {
    std::array<char, 256> name{};
    if (gethostname(name.data(), name.size() - 1) != 0) return "the service's machine";
    return "the service's machine (" + std::string(name.data()) + ")";
}

/// By its text, as faults have no code.
bool is_about_a_missing_file(const Fault& fault) {
    const auto names_it = [&](const std::string& entry) {
        return fault.pointer.ends_with(entry) || fault.cause.starts_with(entry);
    };
    return std::ranges::any_of(scene::file_entries, names_it) &&
           fault.cause.find("does not exist") != std::string::npos;
}

/// Only remedies change; pointers and causes are those of the checks.
template <class Read>
auto read_here(Read read) {
    try {
        return read();
    } catch (const BadInput& error) {
        throw BadInput(error.file(), seen_from_here(error.faults()), error.more());
    }
}

}  // namespace

/// "does not exist" is puzzling to a client on another machine, where the file does exist.
std::vector<Fault> seen_from_here(std::vector<Fault> faults) {
    for (Fault& each : faults)
        if (is_about_a_missing_file(each))
            each.remedy = "files are looked for on " + this_machine() +
                          ": send it (POST /v1/files; breach submit does it) and give the "
                          "reference of the answer, or copy it there and give its absolute path "
                          "there";
    return faults;
}

SentFiles files_of(const Service& service) {
    return {service.data.root(), service.allowed_folders, service.largest_file};
}

bool is_study_document(const json& document) { return is_a("study", document, "scene"); }

Study sent_study(const std::string& body, const Service& service) {
    return sent_study(scene::parse_json(body, "study"), service);
}

/// One fault instead of the many that the schema would find in a scene.
Study sent_study(json document, const Service& service) {
    if (is_a("scene", document, "section")) {
        throw BadInput(
            "study",
            {{"", "this is a scene, not a study: it has no transfer times",
              R"(wrap it: {"format": "breachline-study/1", "name": "...", "scene": {...}, )"
              R"("transfer_times": [...]}; or: breach submit --scene FILE --times 0.5,1)"}});
    }
    return read_here([&] { return read_study_document(std::move(document), files_of(service)); });
}

WholeScene sent_scene(const std::string& body, const Service& service) {
    const json document = scene::parse_json(body, "scene");
    if (is_study_document(document)) {
        throw BadInput("scene", {{"", "this is a study, not a scene",
                                  "give the scene that it holds or names in \"scene\""}});
    }
    return read_here([&] { return read_whole_scene(document, files_of(service)); });
}

}  // namespace breach::orchestrator
