// `breach rm`, `du`, `files` and `open`. Removal cannot be undone: all names are resolved before
// the first is removed, and shown with their sizes before the question.
#include "services/cli/stored.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/scene/file_paths.hpp"
#include "services/cli/sending.hpp"
#include "services/cli/table.hpp"
#include "services/cli/views.hpp"

namespace breach::cli {

using fault::ExitCode;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

/// After a cancel: the server refuses to remove a run whose processes are still ending.
/// Without a limit: how long a process may take to end is the server's setting.
void wait_for_the_end(Server& server, const std::string& run) {
    constexpr auto pause = std::chrono::milliseconds(200);
    while (server.get(path_of({"runs", run})).at("finished").is_null())
        std::this_thread::sleep_for(pause);
}

struct Removed {
    std::string kind, id, name;
    double bytes = 0.0;  ///< freed by the removal
};

/// A size that the server does not know counts as 0: it must not keep anything from being removed.
std::vector<Removed> meant(Server& server, const std::vector<std::string>& names) {
    const json runs = server.get("/v1/storage").at("runs");
    const json files = server.get("/v1/files").at("files");
    const auto found = [](const json& list, const char* key, const std::string& id) {
        const auto at =
            std::ranges::find_if(list, [&](const json& each) { return each.at(key) == id; });
        return at == list.end() ? json::object() : *at;
    };
    std::vector<Removed> all;
    for (const std::string& each : names) {
        const auto file = scene::file_reference(each);
        const std::string id = file ? file->sha256 : run_named(server, each);
        const json what = file ? found(files, "reference", each) : found(runs, "id", id);
        const json bytes = what.value(file ? "bytes" : "freed_bytes", json());
        all.push_back({file ? "files" : "runs", id, what.value("name", ""),
                       bytes.is_number() ? bytes.get<double>() : 0.0});
    }
    return all;
}

/// On stderr, so that it is seen with stdout redirected, and with --quiet: a question is no remark.
bool wants(const std::vector<Removed>& all) {
    double bytes = 0.0;
    for (const Removed& each : all) {
        std::cerr << each.id << "  " << harmless(each.name) << "  " << in_bytes(each.bytes) << "\n";
        bytes += each.bytes;
    }
    std::cerr << "Remove " << (all.size() == 1 ? "it" : "them") << " (" << in_bytes(bytes)
              << ")? [y/N] ";
    std::string answer;
    std::getline(std::cin, answer);
    return answer == "y" || answer == "yes";
}

}  // namespace

/// Without a terminal and without --yes it refuses, instead of waiting for an answer that cannot
/// come. The cancelled run is waited for, as the server removes no run that goes on.
ExitCode remove_all(Server& server, const Removal& removal, const Console& console) {
    const std::vector<Removed> all = meant(server, removal.names);
    if (!removal.confirmed && isatty(STDIN_FILENO) != 1)
        throw fault::BadInput("breach rm", {{"", "there is no terminal to ask on",
                                             "give --yes to remove without being asked"}});
    if (!removal.confirmed && !wants(all)) return ExitCode::done;
    for (const auto& [kind, id, name, bytes] : all) {
        const std::string path = path_of({kind, id});
        json answer;
        try {
            answer = server.remove(path);
        } catch (const Refused& refused) {
            if (refused.type() != "/problems/going-on" || !removal.cancel_first) throw;
            server.post(path + "/cancel", json::object());
            wait_for_the_end(server, id);
            answer = server.remove(path);
        }
        if (!shown_as_json(answer, console))
            console.out << id << "  " << in_bytes(answer.at("freed_bytes").get<double>())
                        << " freed" << std::endl;
    }
    return ExitCode::done;
}

ExitCode disk_use(Server& server, const Console& console) {
    const json storage = server.get("/v1/storage");
    if (shown_as_json(storage, console)) return ExitCode::done;
    const auto bytes = [](const json& of, const char* key) {
        return of.at(key).is_number() ? in_bytes(of.at(key).get<double>()) : std::string("-");
    };
    std::vector<Cells> rows;
    for (const json& run : storage.at("runs"))
        rows.push_back({cell(run, "id"), cell(run, "name"), cell(run, "state"), bytes(run, "bytes"),
                        bytes(run, "shared_bytes"), bytes(run, "freed_bytes")});
    console.out << as_table(
        {{"run"}, {"name"}, {"state"}, {"holds", right}, {"shared", right}, {"rm frees", right}},
        rows);
    console.out << "\nruns " << bytes(storage, "runs_bytes") << ", files that were sent "
                << bytes(storage, "files_bytes") << ", database "
                << bytes(storage, "database_bytes") << ": " << bytes(storage, "total_bytes")
                << "; the disk has " << bytes(storage, "free_bytes") << " left\n";
    if (storage.at("removing") != 0)
        console.out << cell(storage, "removing") << " removed runs are still being deleted\n";
    if (storage.at("keep_days").is_number())
        console.out << "runs are removed " << cell(storage, "keep_days")
                    << " days after their end\n";
    if (storage.at("keep_GB").is_number())
        console.out << "the oldest runs are removed beyond " << cell(storage, "keep_GB") << " GB\n";
    return ExitCode::done;
}

ExitCode list_files(Server& server, const Console& console) {
    const json files = server.get("/v1/files").at("files");
    if (shown_as_json(files, console)) return ExitCode::done;
    std::vector<Cells> rows;
    for (const json& file : files)
        rows.push_back({cell(file, "reference"), cell(file, "name"),
                        in_bytes(file.at("bytes").get<double>()),
                        std::to_string(file.at("runs").size()), cell(file, "about")});
    if (rows.empty())
        console.notes << "no files were sent\n";
    else
        console.out << as_table({{"reference"}, {"name"}, {"size", right}, {"runs", right}, {""}},
                                rows);
    return ExitCode::done;
}

/// Flushes each line: a large file can take minutes.
ExitCode send_files(Server& server, const std::vector<fs::path>& files, const Console& console) {
    for (const fs::path& each : files) console.out << send_file(server, each, console) << std::endl;
    return ExitCode::done;
}

/// Asks for the run first: a wrong id is reported here and not in a browser.
ExitCode open_page(Server& server, const std::string& run, const Console& console) {
    const std::string id = run_named(server, run);
    server.get(path_of({"runs", id}));
    console.out << server.origin() << "/#/runs/" << percent_encoded(id) << "\n";
    return ExitCode::done;
}

/// Powers of 1000, as disks are sold. From 999.5 on the next unit, or 1000 kB would be printed.
std::string in_bytes(double bytes) {
    constexpr const char* units[] = {"B", "kB", "MB", "GB", "TB"};
    std::size_t unit = 0;
    while (bytes >= 999.5 && unit + 1 < std::size(units)) {
        bytes /= 1000.0;
        ++unit;
    }
    char text[32];
    std::snprintf(text, sizeof text, unit == 0 || bytes >= 99.95 ? "%.0f %s" : "%.1f %s", bytes,
                  units[unit]);
    return text;
}

}  // namespace breach::cli
