// What an attempt needs before its process (scene on disk, command line) and what is made of its
// end. Called by Attempts only. Phases know nothing of the store: all they get is these
// arguments, so that each can be repeated by hand from the attempt's order.json.
#include "services/orchestrator/dispatch/live_attempt.hpp"

#include <algorithm>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/exchange/publish.hpp"
#include "core/fault/fault.hpp"
#include "core/phases/files.hpp"
#include "core/scene/file_paths.hpp"
#include "services/orchestrator/dispatch/ending.hpp"
#include "services/orchestrator/records/identity.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

std::string last_line_of(const std::filesystem::path& file) {
    // A log may have gigabytes, and a fault's line is short.
    constexpr std::streamoff tail = 4096;
    std::ifstream stream(file, std::ios::binary | std::ios::ate);
    if (!stream) return {};
    const std::streamoff size = stream.tellg();
    stream.seekg(std::max<std::streamoff>(0, size - tail));
    std::string line;
    std::string last;
    while (std::getline(stream, line)) {
        if (!line.empty()) last = line;
    }
    return last;
}

}  // namespace

bool may_resume(const Store& store, const std::string& task, std::int64_t number) {
    if (number == 1) return false;
    for (const Attempt& each : store.attempts_of(task))
        if (each.number == number - 1)
            return each.exit_code != static_cast<std::int64_t>(fault::ExitCode::bad_input);
    return true;
}

/// At the first attempt of a run, or the next one if the service was killed here. The scene comes
/// last, as its presence means that all links are there.
void lay_out_scene(const Store& store, const DataFolder& data, const std::string& run) {
    namespace fs = std::filesystem;
    const fs::path scene = data.scene(run);
    if (fs::exists(scene)) return;
    for (const StoredFile& each : store.files_of(run)) {
        const fs::path link = data.run(run) / scene::folder_of_references / each.file;
        if (fs::exists(link)) continue;
        fs::create_directories(link.parent_path());
        std::error_code error;
        fs::create_hard_link(data.files() / each.file, link, error);
        if (error) fs::copy_file(data.files() / each.file, link);
    }
    exchange::publish_text(scene, json::parse(store.scene_of(run).value()).dump(2) + "\n");
}

Order order_for(const LiveAttempt& live, const Store& store, const DataFolder& data,
                const DispatchSettings& settings) {
    const Task& task = live.task;
    std::vector<std::string> arguments{data.scene(task.run)};
    if (!task.input.empty())
        arguments.insert(arguments.end(),
                         {"--input", data.input(task, store.task(*task.parent).value())});
    arguments.insert(arguments.end(), {"--output", data.output(task)});
    for (const std::string& each : task.overrides)
        arguments.insert(arguments.end(), {"--set", each});
    arguments.insert(arguments.end(),
                     {"--progress", "json", "--threads", std::to_string(task.resources.cores)});
    if (live.resumes) arguments.emplace_back("--resume");
    return {.attempt = attempt_id(task.id, live.number),
            .program = settings.bin / phases::named(task.phase)->executable,
            .arguments = std::move(arguments),
            .grace_seconds = settings.grace_seconds,
            .cores = task.resources.cores,
            .memory_mb = task.resources.memory_mb,
            .priority = task.priority};
}

TaskFault fault_of(const LiveAttempt& live, const ExitRecord& record, const DataFolder& data) {
    TaskFault fault{record.exit_code, in_words(record)};
    if (record.signal == SIGKILL && !record.stopped) {
        const std::int64_t asked = live.task.resources.memory_mb;
        fault.summary +=
            ": most likely the machine's memory, or a memory or time limit of Slurm, was exceeded; "
            "the phase asked for " +
            (asked > 0 ? std::to_string(asked) + " MB" : std::string("no memory of its own")) +
            ". Raise it in the study (\"resources\": {\"" + live.task.phase +
            "\": {\"memory_MB\": ...}}), or the time limit (breachline serve "
            "--slurm-option=--time=HH:MM:SS)";
    }
    if (!record.exit_code) return fault;
    std::ifstream stream(data.output(live.task) / phases::files::fault);
    const json said = json::parse(stream, nullptr, false);
    std::string summary;
    if (said.is_object() && said.value("exit_code", 0) == *record.exit_code)
        summary = said.value("summary", "");
    // In order of knowledge: the phase's own words, then the supervisor's on a full disk, where
    // the phase could not write them, then the log.
    if (summary.empty() && *record.exit_code != 0) summary = record.disk;
    if (summary.empty()) summary = last_line_of(live.folder.log());
    if (!summary.empty()) fault.summary = summary;
    return fault;
}

}  // namespace breach::orchestrator
