// What phases have written, also while they write it: logs, telemetry and frames are read from the
// folder of the task, artifacts of ended tasks by their hash.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>
#include <sstream>

#include "core/phases/files.hpp"
#include "core/phases/phases.hpp"
#include "services/orchestrator/files/telemetry.hpp"
#include "services/orchestrator/http/http_routes.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

constexpr std::int64_t largest_log_part = 1 << 20;
constexpr std::int64_t largest_count = std::int64_t{1} << 53;  // exact in a JSON number

Problem gone(const std::string& what) {
    return {410, "/problems/gone", "Gone", what + " is no longer on the disk as it was stored"};
}

/// By parts of at most 1 MiB; a client follows a running phase by asking from X-Next-Offset on.
void log(const Service& service, Call& call) {
    call.allow_parameters({"offset"});
    const Task task = wanted_task(service, call.parts[0]);
    const auto attempts = service.store.attempts_of(task.id);
    const auto attempt = std::ranges::find_if(attempts, [&](const Attempt& each) {
        return std::to_string(each.number) == call.parts[1];
    });
    if (attempt == attempts.end())
        throw not_found("attempt " + call.parts[1] + " of task " + task.id);
    std::int64_t offset = call.whole_number("offset", 0, 0, largest_count);
    std::ifstream stream(service.data.attempt(task, attempt->number).log(), std::ios::binary);
    std::string text(static_cast<std::size_t>(largest_log_part), '\0');
    // Beyond the end, read() finds nothing and the answer is empty: there is no more yet.
    stream.seekg(offset);
    stream.read(text.data(), largest_log_part);
    text.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, stream.gcount())));
    offset += static_cast<std::int64_t>(text.size());
    call.response.set_header("X-Next-Offset", std::to_string(offset));
    call.response.set_header("Cache-Control", "no-store");
    call.response.set_content(text, "text/plain; charset=utf-8");
}

/// Names in a comma-separated parameter.
/// Unknown names are the reader's to refuse: it knows the file's columns.
std::vector<std::string> names_in(const Call& call, const std::string& parameter) {
    std::vector<std::string> names;
    std::istringstream text(call.parameter(parameter).value_or(""));
    for (std::string name; std::getline(text, name, ',');) names.push_back(name);
    return names;
}

void telemetry(const Service& service, Call& call) {
    call.allow_parameters({"phase", "transfer_time", "variant", "fields", "from", "stride"});
    wanted_run(service, call.parts[0]);
    const std::string phase = call.parameter("phase").value_or(phases::fem.program);
    const Task task = meant_task(service, call.parts[0], phase, call.number("transfer_time"),
                                 call.parameter("variant"));
    const TelemetryRequest query{.fields = names_in(call, "fields"),
                                 .from = call.whole_number("from", 0, 0, largest_count),
                                 .stride = call.whole_number("stride", 1, 1, largest_count)};
    reply(call.response,
          read_telemetry(service.data.output(task) / phases::files::telemetry, query));
}

/// From the folder, so that frames of a running phase are there; their hashes come when it ends.
void frames(const Service& service, Call& call) {
    call.allow_parameters({});
    const Task task = wanted_task(service, call.parts[0]);
    const auto artifacts = service.store.artifacts_of(task.id);
    json list = json::array();
    for (const Frame& frame : frames_in(service.data.output(task), task.phase)) {
        const auto kept = std::ranges::find(artifacts, frame.name, &Artifact::name);
        list.push_back({{"time", frame.time},
                        {"name", frame.name},
                        {"sha256", kept == artifacts.end() ? json(nullptr) : json(kept->sha256)},
                        {"kind", frame.kind}});
    }
    reply(call.response, {{"frames", list}});
}

void points(Service& service, Call& call) {
    call.allow_parameters({"stride", "fields"});
    const Task task = wanted_task(service, call.parts[0]);
    const std::string& name = call.parts[1];
    const auto file = service.data.output(task) / name;
    std::error_code error;  // for example a name that is too long
    // The name is from the request: only names that phases give, and no links, are opened.
    if (!is_frame_name(name) ||
        !std::filesystem::is_regular_file(std::filesystem::symlink_status(file, error)))
        throw not_found("frame " + name + " of task " + task.id);
    const auto stride = static_cast<std::size_t>(call.whole_number("stride", 1, 1, largest_count));
    try {
        call.response.set_content(
            service.frames.points(file, task.phase, stride, names_in(call, "fields")),
            "application/octet-stream");
    } catch (const NoSuchField& fault) {
        throw bad_request(fault.what());
    } catch (const fault::IoError&) {
        throw gone(name);
    }
}

/// At most one range, inside the file; httplib does not check it.
/// `first` below 0 is httplib's form of "the last `second` bytes".
void keep_valid_range(const httplib::Request& request, std::int64_t size) {
    if (request.ranges.empty()) return;
    // The request is httplib's own mutable object, from which it writes the answer.
    auto& ranges = const_cast<httplib::Request&>(request).ranges;
    auto [first, last] = ranges.front();
    if (last < 0) last = size - 1;
    const bool suffix = first < 0;
    const bool sound =
        ranges.size() == 1 && (suffix ? ranges.front().second > 0 : first <= last && first < size);
    if (!sound) {
        ranges.clear();
        throw Problem{
            416, "/problems/range", "Range not satisfiable",
            "one range inside the file is possible; it has " + std::to_string(size) + " bytes"};
    }
    if (suffix) {
        first = std::max<std::int64_t>(0, size - ranges.front().second);
        last = size - 1;
    }
    ranges.front() = {first, std::min<ssize_t>(last, size - 1)};
}

void artifact(const Service& service, Call& call) {
    call.allow_parameters({});
    const auto kept = service.store.artifact(call.parts[0]);
    if (!kept) throw not_found("artifact " + call.parts[0]);
    const Task task = wanted_task(service, kept->task);
    const auto file = service.data.output(task) / kept->name;
    send_content(call, file, kept->sha256, kept->bytes,
                 std::filesystem::path(kept->name).filename());
}

}  // namespace

/// Half a microsecond: transfer times are whole microseconds.
Task meant_task(const Service& service, const std::string& run, const std::string& phase,
                std::optional<double> transfer_time, const std::optional<std::string>& variant) {
    constexpr double same_time = 5e-7;
    std::optional<Task> found;
    for (Task& each : service.store.tasks_of(run)) {
        if (each.phase != phase) continue;
        if (transfer_time &&
            (!each.transfer_time || std::abs(*each.transfer_time - *transfer_time) > same_time))
            continue;
        if (variant && each.variant != *variant) continue;
        if (found)
            throw bad_request("several tasks run " + phase +
                              "; say which with transfer_time= and variant=");
        found = std::move(each);
    }
    if (!found) throw not_found("such task of " + phase + " in run " + run);
    return std::move(*found);
}

void send_content(Call& call, const std::filesystem::path& file, const std::string& sha256,
                  std::int64_t bytes, const std::string& name) {
    const std::string tag = '"' + sha256 + '"';
    call.response.set_header("ETag", tag);
    // By its hash, a content never changes.
    call.response.set_header("Cache-Control", "private, max-age=31536000, immutable");
    if (call.request.get_header_value("If-None-Match") == tag) {
        call.response.status = 304;
        return;
    }
    std::error_code error;
    const auto size = static_cast<std::int64_t>(std::filesystem::file_size(file, error));
    auto stream = std::make_shared<std::ifstream>(file, std::ios::binary);
    // Before the headers of a good answer are on their way: later a fault could not be said.
    if (error || !*stream || size != bytes) throw gone(name);
    keep_valid_range(call.request, size);
    call.response.set_header("Content-Disposition", "attachment; filename=\"" + name + '"');
    if (size == 0) return call.response.set_content("", "application/octet-stream");
    call.response.set_content_provider(
        static_cast<std::size_t>(size), "application/octet-stream",
        [stream](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
            // Part by part, as the reader takes it: files may be larger than the memory.
            std::vector<char> part(std::min<std::size_t>(length, 1 << 16));
            stream->seekg(static_cast<std::streamoff>(offset));
            stream->read(part.data(), static_cast<std::streamsize>(part.size()));
            const auto count = static_cast<std::size_t>(stream->gcount());
            return count > 0 && sink.write(part.data(), count);
        });
}

void add_output_routes(Router& router, Service& service) {
    router.get("/v1/runs/{id}/telemetry", [&](Call& call) { telemetry(service, call); });
    router.get("/v1/tasks/{id}/attempts/{n}/log", [&](Call& call) { log(service, call); });
    router.get("/v1/tasks/{id}/frames", [&](Call& call) { frames(service, call); });
    router.get("/v1/tasks/{id}/frames/{name}/points", [&](Call& call) { points(service, call); });
    router.get("/v1/artifacts/{sha256}", [&](Call& call) { artifact(service, call); });
}

}  // namespace breach::orchestrator
