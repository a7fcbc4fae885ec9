// Moves a task from `finalizing` to `succeeded`, or to `failed` if its outputs are unusable.
// Attempts hands tasks in when their process has ended; Dispatcher::reconcile hands in those that
// a killed service left in `finalizing`. Hashing twice is harmless: the transaction stores
// everything or nothing.
#include "services/orchestrator/dispatch/registrar.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <fstream>

#include "core/exchange/provenance.hpp"
#include "core/fault/fault.hpp"
#include "core/phases/files.hpp"
#include "services/orchestrator/files/failpoint.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

/// Everything below the output folder, in order of name.
std::vector<Artifact> hashed_outputs(const Task& task, const std::filesystem::path& output) {
    std::vector<Artifact> found;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(output)) {
        // A link may lead out of the folder, and its target may change later.
        if (!entry.is_regular_file() || entry.is_symlink()) continue;
        found.push_back({.task = task.id,
                         .name = std::filesystem::relative(entry.path(), output).string(),
                         .sha256 = exchange::sha256_of_file(entry.path()),
                         .bytes = static_cast<std::int64_t>(entry.file_size())});
    }
    std::ranges::sort(found, {}, &Artifact::name);
    return found;
}

/// The facts of result.json, without plan and provenance. Both stay readable in the file itself;
/// no query needs them.
json facts_of(const std::filesystem::path& file) {
    std::ifstream stream(file);
    json result = json::parse(stream);
    if (!result.is_object()) throw fault::IoError(file.string() + ": is not a JSON object");
    result.erase("provenance");
    result.erase("plan");
    return result;
}

}  // namespace

Registrar::Registrar(Store& store, const DataFolder& data,
                     std::function<void(const std::string&)> done)
    : store_(store),
      data_(data),
      done_(std::move(done)),
      queue_([this](const Task& task) { return serve(task); }) {}

void Registrar::add(Task task) { queue_.add(std::move(task)); }

/// A full disk or a busy database passes: the queue tries again, and the task stays in
/// `finalizing`.
Handled Registrar::serve(const Task& task) {
    try {
        finalize(task);
    } catch (const std::exception& error) {
        // The next try uses the state of the store at that time.
        spdlog::error("{}: {}; trying again", task.id, error.what());
        return Handled::again_later;
    }
    done_(task.id);
    return Handled::done;
}

/// The hash of the task's input file, part of the cache's key. Empty: no input file.
std::string Registrar::input_sha256(const Task& task) const {
    if (task.input.empty()) return {};
    return exchange::sha256_of_file(data_.input(task, store_.task(*task.parent).value()));
}

/// Registers the outputs of failed and stopped tasks as well.
void Registrar::keep_remains(const Task& task) {
    std::vector<Artifact> artifacts;
    std::string input;
    try {
        input = input_sha256(task);
        artifacts = hashed_outputs(task, data_.output(task));
    } catch (const std::exception& error) {
        spdlog::warn("{}: its outputs cannot be read: {}", task.id, error.what());
        return;
    }
    store_.write(
        [&](Transaction& transaction) { transaction.keep_remains(task.id, artifacts, input); });
}

void Registrar::finalize(const Task& task) {
    const auto now = store_.task(task.id);
    if (!now) return;  // its run was removed
    const TaskState state = now->state;
    if (state == TaskState::failed || state == TaskState::cancelled) return keep_remains(task);
    if (state != TaskState::finalizing) return;  // handed in twice, or retried
    const std::filesystem::path output = data_.output(task);
    json result;
    std::vector<Artifact> artifacts;
    std::string trouble;
    std::string input;
    try {
        input = input_sha256(task);
        result = facts_of(output / phases::files::result);
        artifacts = hashed_outputs(task, output);
    } catch (const json::exception&) {
        trouble = "the phase ended with exit code 0 but left no readable result.json";
    } catch (const std::exception& error) {
        trouble = std::string("the outputs cannot be read: ") + error.what();
    }
    pass_failpoint("outputs_before");
    store_.write([&](Transaction& transaction) {
        if (trouble.empty()) {
            transaction.finish_task(task.id, result, artifacts, input);
        } else {
            transaction.fail_task(task.id, TaskEvent::refuse_outputs, {std::nullopt, trouble});
        }
    });
    pass_failpoint("outputs_after");
}

}  // namespace breach::orchestrator
