#include "services/orchestrator/dispatch/cache.hpp"

#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include "core/exchange/provenance.hpp"

namespace breach::orchestrator {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t most_candidates = 8;

/// A machine that goes down must not find the answer noted and its files gone.
void sync_folder(const fs::path& folder) {
    const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    fsync(descriptor);
    close(descriptor);
}

}  // namespace

Cache::Cache(Store& store, const DataFolder& data, std::function<void(const std::string&)> examined)
    : store_(store), data_(data), examined_(std::move(examined)), queue_([this](const Task& task) {
          serve(task);
          return Handled::done;
      }) {}

bool Cache::may_answer(const Task& task) const { return task.recipe && store_.has_candidate(task); }

void Cache::examine(Task task) { queue_.add(std::move(task)); }

void Cache::serve(const Task& task) {
    try {
        look_up(task);
    } catch (const std::exception& error) {
        spdlog::error("cache: {}: {}", task.id, error.what());  // the task simply runs
    }
    examined_(task.id);
}

void Cache::look_up(const Task& task) {
    std::string input_sha256;
    if (!task.input.empty())
        input_sha256 =
            exchange::sha256_of_file(data_.input(task, store_.task(*task.parent).value()));
    std::optional<std::string> refusal;
    for (const Task& earlier : store_.answers_to(*task.recipe, input_sha256, most_candidates)) {
        refusal = damage_of(earlier);
        if (refusal) continue;
        place_outputs(earlier, task);
        store_.write([&](Transaction& transaction) { transaction.reuse_task(task.id, earlier); });
        spdlog::info("{} ({}): the same as {}", task.id, task.label, earlier.id);
        return;
    }
    if (!refusal) return;
    spdlog::warn("{} ({}): {}", task.id, task.label, *refusal);
    store_.write(
        [&](Transaction& transaction) { transaction.note_cache_refusal(task.id, *refusal); });
}

std::optional<std::string> Cache::damage_of(const Task& earlier) const {
    for (const Artifact& each : store_.artifacts_of(earlier.id)) {
        const fs::path file = data_.output(earlier) / each.name;
        std::error_code error;
        const auto size = fs::file_size(file, error);
        if (error) return each.name + " of task " + earlier.id + " is missing";
        if (static_cast<std::int64_t>(size) != each.bytes ||
            exchange::sha256_of_file(file) != each.sha256)
            return each.name + " of task " + earlier.id + " is not what was stored";
    }
    return std::nullopt;
}

void Cache::place_outputs(const Task& earlier, const Task& task) const {
    const fs::path folder = data_.output(task);
    // A task that broke down can be tried again, which writes into its files.
    const bool may_be_written_to = earlier.state == TaskState::failed;
    fs::create_directories(folder);
    for (const Artifact& each : store_.artifacts_of(earlier.id)) {
        const fs::path from = data_.output(earlier) / each.name;
        const fs::path to = folder / each.name;
        fs::create_directories(to.parent_path());
        fs::remove(to);
        std::error_code error;
        if (!may_be_written_to) fs::create_hard_link(from, to, error);
        if (may_be_written_to || error) fs::copy_file(from, to);  // error: no links there
        sync_folder(to.parent_path());
    }
}

}  // namespace breach::orchestrator
