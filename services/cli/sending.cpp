// Submits a study whose scene names files on this machine. A server on the same machine may read
// them itself; another gets them sent first, and the study then names their hashes.
#include "services/cli/sending.hpp"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/exchange/provenance.hpp"
#include "core/scene/file_paths.hpp"
#include "core/words/loopback.hpp"
#include "services/cli/table.hpp"

namespace breach::cli {

using nlohmann::json;
namespace fs = std::filesystem;

namespace {

/// More would hide a server that keeps failing; another call resumes where this one ended.
constexpr int most_tries = 3;

/// Visits the path of every entry that names a file, in the scene and in overrides.
/// The keys come from core/scene, as the server checks the same ones.
void change_files(json& study, const scene::ChangeOfPath& changed) {
    if (!study.is_object()) return;
    for (const std::string& entry : scene::file_entries) {
        const json::json_pointer key("/scene" + entry);
        if (study.contains(key) && study[key].is_string())
            study[key] = changed(study[key].get<std::string>());
    }
    scene::change_override_files(study, changed);
}

/// A proxy or container may answer on loopback and not see the files: post_with_files() then sends
/// them after the refusal.
bool is_this_machine(const std::string& origin) {
    return words::is_loopback_authority(origin.substr(origin.find("//") + 2));
}

/// Two clients may send one file at a time, or an old part may be damaged: the next try asks the
/// server how much has arrived.
/// Other refusals, such as a file that is no motion, are final.
bool is_about_a_part(const Refused& refused) {
    return refused.type() == "/problems/hash-mismatch" ||
           refused.type() == "/problems/other-part" || refused.type() == "/problems/being-sent";
}

/// Returns how many entries were replaced by references. Keeps paths without a file here: they may
/// be the server's.
/// A file that several entries name is sent once.
std::size_t send_files_of(Server& server, json& study, const Console& console) {
    std::map<std::string, std::string> references;
    std::size_t replaced = 0;
    change_files(study, [&](const std::string& path) {
        std::error_code error;
        if (scene::file_reference(path) || !fs::is_regular_file(path, error)) return path;
        auto known = references.find(path);
        if (known == references.end())
            known = references.emplace(path, send_file(server, path, console)).first;
        ++replaced;
        return known->second;
    });
    return replaced;
}

}  // namespace

/// Goes on where an interrupted upload ended. Waits one second longer after each try.
std::string send_file(Server& server, const fs::path& file, const Console& console) {
    // By content: a renamed file is not sent twice, and a changed one is never mistaken for the
    // old.
    const std::string sha256 = exchange::sha256_of_file(file);
    bool from_its_beginning = false;
    for (int tries = 1;; ++tries) {
        try {
            const KnownFile known = server.known_file(path_of({"files", sha256}));
            if (!known.reference.empty()) return known.reference;
            const std::size_t from = from_its_beginning ? 0 : known.arrived;
            const json answer =
                server.upload(path_of({"files"}) + query_of({{"name", file.filename().string()},
                                                             {"sha256", sha256},
                                                             {"from", std::to_string(from)}}),
                              file, from);
            console.notes << "sent " << file.string() << " (" << cell(answer, "about") << ")"
                          << (from > 0 ? ", of which " + std::to_string(from) +
                                             " bytes had arrived before"
                                       : "")
                          << "\n";
            if (const auto warnings = answer.find("warnings"); warnings != answer.end())
                for (const json& each : *warnings)
                    console.notes << cell(each, "severity") << ": " << cell(each, "message")
                                  << "\n";
            return answer.at("reference");
        } catch (const Unreachable&) {
            if (tries == most_tries) throw;
        } catch (const Refused& refused) {
            // The received part differs from the file, or another upload is in progress.
            if (tries == most_tries || !is_about_a_part(refused)) throw;
            from_its_beginning = refused.type() == "/problems/hash-mismatch";
        }
        std::this_thread::sleep_for(std::chrono::seconds(tries));
    }
}

namespace {

/// `post` may be called twice, with the upload of files between.
template <class Post>
json post_with_files(Server& server, json study, Sending sending, const Console& console,
                     Post post) {
    if (sending == Sending::always || !is_this_machine(server.origin()))
        send_files_of(server, study, console);
    try {
        return post(study);
    } catch (const Refused& refused) {
        const bool helps = std::ranges::any_of(refused.faults(), is_about_a_file) &&
                           send_files_of(server, study, console) > 0;
        if (!helps) throw;
    }
    return post(study);
}

}  // namespace

/// A pointer in the scene ends with the entry; a fault of an override quotes it in its text.
bool is_about_a_file(const fault::Fault& fault) {
    return std::ranges::any_of(scene::file_entries, [&](const std::string& entry) {
        return fault.pointer.ends_with(entry) || fault.cause.find(entry) != std::string::npos;
    });
}

void show_warnings(const json& answer, const Console& console) {
    for (const json& each : answer.value("warnings", json::array()))
        console.notes << "warning: "
                      << (each.at("pointer") == "" ? "" : cell(each, "pointer") + ": ")
                      << cell(each, "message") << "\n";
}

json post_study(Server& server, const std::string& route, json study, const Headers& headers,
                Sending sending, const Console& console) {
    json answer =
        post_with_files(server, std::move(study), sending, console,
                        [&](const json& sent) { return server.post(route, sent, headers); });
    show_warnings(answer, console);
    return answer;
}

/// Wrapped as a study while files are sent, since the entries are looked up below /scene.
json post_scene(Server& server, const std::string& route, const json& scene, Sending sending,
                const Console& console) {
    json answer =
        post_with_files(server, {{"scene", scene}}, sending, console,
                        [&](const json& sent) { return server.post(route, sent.at("scene")); });
    show_warnings(answer, console);
    return answer;
}

}  // namespace breach::cli
