// `breach export`: a folder that can be read, verified and repeated without the server. Every
// file is compared with its SHA-256. Killed in between, the same command goes on: files that are
// right are not fetched again.
#include "services/cli/export_run.hpp"

#include <fstream>

#include "core/exchange/provenance.hpp"
#include "core/exchange/publish.hpp"
#include "core/scene/file_paths.hpp"
#include "services/cli/logs.hpp"
#include "services/cli/new_scene.hpp"
#include "services/cli/table.hpp"
#include "services/cli/views.hpp"

namespace breach::cli {

using fault::ExitCode;
using fault::IoError;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

/// The folder must be new, empty, or contain an earlier export of the same run.
void claim(const fs::path& folder, const std::string& run) {
    make_folder(folder);
    if (fs::is_empty(folder)) return;
    std::ifstream stream(folder / "run.json");
    const json earlier = json::parse(stream, nullptr, false);
    if (!earlier.is_object() || earlier.value("id", json()) != run)
        throw IoError(folder.string() + ": holds something else; give a new or an empty folder");
}

/// Bytes that are not UTF-8 are replaced: a log's message must not end an export.
/// Published whole, so that an export that was killed leaves no half JSON for claim() to read.
void write_json(const fs::path& file, const json& content) {
    exchange::publish_text(file,
                           content.dump(2, ' ', false, json::error_handler_t::replace) + "\n");
}

/// True: the file was downloaded.
/// To a temporary file first; only a verified one gets its name.
bool fetch(Server& server, const char* kind, const std::string& promised, const fs::path& file) {
    if (fs::is_regular_file(file) && exchange::sha256_of_file(file) == promised) return false;
    make_folder(file.parent_path());
    exchange::publish(file, [&](const fs::path& temporary) {
        server.download(path_of({kind, promised}), temporary);
        const std::string found = exchange::sha256_of_file(temporary);
        if (found != promised)
            throw IoError(file.string() + ": its SHA-256 is " + found + " instead of " + promised +
                          "; the copy was dropped");
    });
    return true;
}

/// Artifacts come after all tables, so that an interrupted export already has the results. A second
/// export recognises its folder by run.json.
class Export {
  public:
    Export(Server& server, fs::path folder, const Console& console)
        : server_(server), folder_(std::move(folder)), console_(console) {}

    void run(const std::string& id) {
        json run = server_.get(path_of({"runs", id}));
        claim(folder_, id);
        const json tasks = run.at("tasks");
        const json study = run.at("study");
        // First the files: study.json in this folder refers to them, and can be submitted again
        // from here.
        for (const json& each : run.value("files", json::array())) sent_file(each);
        run.erase("tasks");
        run.erase("study");
        keep_json("run.json", run);
        keep_json("study.json", study);
        const std::string results = path_of({"runs", id, "results"});
        const json answer = server_.get(results);
        keep_json("results.json", answer);
        if (!answer.value("means", json::array()).empty())
            keep_text("means.csv", server_.get_text(results + "?format=csv&table=means").body);
        keep_text("results.csv", server_.get_text(results + "?format=csv").body);
        if (study.contains("accuracy"))
            keep_json("accuracy.json", server_.get(path_of({"runs", id, "accuracy"})));
        if (study.contains("uncertainty")) {
            const std::string found = path_of({"runs", id, "uncertainty"});
            keep_json("uncertainty.json", server_.get(found));
            keep_text("samples.csv", server_.get_text(found + "?format=csv").body);
        }
        keep_motions(path_of({"runs", id, "motions"}), tasks);
        for (const json& each : tasks) task(each.at("id"));
        if (study.contains("uncertainty"))
            keep_json("envelopes.json", server_.get(path_of({"runs", id, "envelopes"})));
        console_.notes << bar(1.0) << "  " << kept_ << " artifacts, " << fetched_
                       << " of them fetched, all verified\n";
        console_.out << folder_.string() << "\n";
    }

  private:
    /// For a study of several motions.
    /// With fewer than two FEMs there is nothing to compare. The server answers 404 where too few
    /// of them were shaken and have ended, which must not end an export.
    void keep_motions(const std::string& path, const json& tasks) {
        const auto is_fem = [](const json& each) { return each.at("phase") == "fem_solver"; };
        if (std::ranges::count_if(tasks, is_fem) < 2) return;
        try {
            keep_json("motions.json", server_.get(path));
        } catch (const Refused& none) {
            if (none.status() != 404) throw;
        }
    }

    /// Puts the file where references of the exported scene find it.
    void sent_file(const json& file) {
        const auto reference = scene::file_reference(file.at("reference").get<std::string>());
        if (!reference) throw IoError("the server names a file in a way that is not known here");
        const std::string name = std::string(scene::folder_of_references) + "/" + reference->name;
        if (fetch(server_, "files", reference->sha256, path_below(folder_, name))) ++fetched_;
        ++kept_;
    }

    /// Every attempt's log is kept, as the failed ones say why there was another.
    void task(const std::string& id) {
        const json task = server_.get(path_of({"tasks", id}));
        const std::string name = "tasks/" + task.at("label").get<std::string>() + "/";
        make_folder(path_below(folder_, name + "task.json").parent_path());
        keep_json(name + "task.json", task);
        for (const json& attempt : task.at("attempts")) {
            const std::int64_t number = attempt.at("number");
            keep_text(name + "log." + std::to_string(number) + ".txt",
                      read_log(server_, id, number));
        }
        for (const json& artifact : task.at("artifacts")) {
            const std::string file = name + artifact.at("name").get<std::string>();
            if (fetch(server_, "artifacts", artifact.at("sha256"), path_below(folder_, file)))
                ++fetched_;
            ++kept_;
        }
        console_.notes << name_of_task(task) << "  " << task.at("artifacts").size()
                       << " artifacts\n";
    }

    void keep_json(const std::string& name, const json& content) {
        write_json(path_below(folder_, name), content);
    }

    void keep_text(const std::string& name, const std::string& text) {
        exchange::publish_text(path_below(folder_, name), text);
    }

    Server& server_;
    fs::path folder_;
    const Console& console_;
    std::size_t kept_ = 0;
    std::size_t fetched_ = 0;
};

}  // namespace

/// Names come from a server that need not be ours: none may write outside the folder.
fs::path path_below(const fs::path& folder, const std::string& name) {
    const fs::path relative(name);
    bool leads_out = relative.is_absolute() || name.find('\0') != std::string::npos;
    for (const fs::path& part : relative) leads_out = leads_out || part == ".." || part.empty();
    if (leads_out || name.empty())
        throw IoError("the server names a file \"" + harmless(name) + "\", which leads out of " +
                      folder.string());
    return folder / relative;
}

ExitCode export_run(Server& server, const std::string& run, const fs::path& folder,
                    const Console& console) {
    Export(server, folder, console).run(run_named(server, run));
    return ExitCode::done;
}

}  // namespace breach::cli
