// How a ready task gets the files of an earlier one. Order: list the names in a file (`reused`),
// place the links, store the reuse, delete the list. Whoever finds the list after a kill knows
// which files in the output folder were never taken, and drop_placed_outputs removes them before
// the task runs or is looked up again. The cache never holds rows or locks of its own: the
// transaction in reuse_task decides whether the earlier result is still there.
#include "services/orchestrator/dispatch/cache.hpp"

#include <spdlog/spdlog.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "core/exchange/provenance.hpp"
#include "core/exchange/publish.hpp"
#include "services/orchestrator/files/damage.hpp"
#include "services/orchestrator/files/failpoint.hpp"
#include "services/orchestrator/files/sync_folder.hpp"

namespace breach::orchestrator {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

/// A bound, because each candidate costs a hash of all its files; the newest come first.
constexpr std::size_t most_candidates = 8;

}  // namespace

void drop_placed_outputs(const DataFolder& data, const Task& task) {
    std::ifstream stream(data.reused(task));
    if (!stream) return;
    const json names = json::parse(stream, nullptr, false);
    if (names.is_array())
        for (const json& each : names) fs::remove(data.output(task) / each.get<std::string>());
    fs::remove(data.reused(task));
}

Cache::Cache(Store& store, const DataFolder& data, std::function<void(LookedUp)> examined)
    : store_(store), data_(data), examined_(std::move(examined)), queue_([this](const Task& task) {
          serve(task);
          return Handled::done;
      }) {}

bool Cache::may_answer(const Task& task) const { return task.recipe && store_.has_candidate(task); }

bool Cache::has_changed_since(const LookedUp& earlier, const Task& task) const {
    return store_.answers_to(*task.recipe, earlier.input_sha256, most_candidates).size() !=
           earlier.answers;
}

void Cache::examine(Task task) { queue_.add(std::move(task)); }

/// On the cache's thread. An error is no reason to wait: ReadyTasks finds the task still `ready`
/// and lets it run.
void Cache::serve(const Task& task) {
    LookedUp found{.task = task.id, .input_sha256 = {}};
    try {
        look_up(task, found);
    } catch (const std::exception& error) {
        spdlog::error("cache: {}: {}", task.id, error.what());  // the task runs instead
    }
    examined_(std::move(found));
}

void Cache::look_up(const Task& task, LookedUp& found) {
    if (!task.input.empty())
        found.input_sha256 =
            exchange::sha256_of_file(data_.input(task, store_.task(*task.parent).value()));
    const std::vector<Task> answers =
        store_.answers_to(*task.recipe, found.input_sha256, most_candidates);
    found.answers = answers.size();
    std::optional<std::string> refusal;
    for (const Task& earlier : answers) {
        const auto damage = damage_to(earlier);
        if (damage) {
            if (store_.task(earlier.id)) refusal = damage;  // else its run was removed
            continue;
        }
        if (!take(earlier, task)) continue;
        spdlog::info("{} ({}): the same as {}", task.id, task.label, earlier.id);
        return;
    }
    pass_failpoint("reuse_none");
    if (!refusal) return;
    spdlog::warn("{} ({}): {}", task.id, task.label, *refusal);
    store_.write(
        [&](Transaction& transaction) { transaction.note_cache_refusal(task.id, *refusal); });
}

/// The run of `earlier` may be removed at any moment: the placed files count only if the store
/// still had it in the same transaction.
bool Cache::take(const Task& earlier, const Task& task) const {
    bool taken = false;
    try {
        place_outputs(earlier, task);
        pass_failpoint("reuse_placed");
        store_.write(
            [&](Transaction& transaction) { taken = transaction.reuse_task(task.id, earlier); });
    } catch (const std::exception&) {
        // After an error the commit may have succeeded all the same: ask the store.
        const auto now = store_.task(task.id);
        if (now && now->state == TaskState::ready) drop_placed_outputs(data_, task);
        if (!store_.task(earlier.id)) return false;  // its files vanished while they were linked
        throw;
    }
    if (taken) {
        std::error_code error;  // a leftover is checked only before a first attempt
        fs::remove(data_.reused(task), error);
    } else {
        drop_placed_outputs(data_, task);
    }
    return taken;
}

/// Hashes again, because links share the bytes with the earlier run: someone who edits a result
/// by hand would otherwise spread the edit.
std::optional<std::string> Cache::damage_to(const Task& earlier) const {
    for (const Artifact& each : store_.artifacts_of(earlier.id)) {
        const auto damage = damage_of(data_.output(earlier) / each.name, each.bytes, each.sha256);
        if (damage) return each.name + " of task " + earlier.id + " " + *damage;
    }
    return std::nullopt;
}

void Cache::place_outputs(const Task& earlier, const Task& task) const {
    const fs::path folder = data_.output(task);
    // A retry of a broken-down task writes into its files, so they cannot be shared.
    const bool may_be_written_to = earlier.state == TaskState::failed;
    fs::create_directories(folder);
    drop_placed_outputs(data_, task);  // leftovers of a killed service, from another candidate
    const std::vector<Artifact> artifacts = store_.artifacts_of(earlier.id);
    json names = json::array();
    for (const Artifact& each : artifacts) names.push_back(each.name);
    // The list before the first file: a file without a list would count as the task's own output.
    exchange::publish_text(data_.reused(task), names.dump());
    for (const Artifact& each : artifacts) {
        const fs::path from = data_.output(earlier) / each.name;
        const fs::path to = folder / each.name;
        fs::create_directories(to.parent_path());
        fs::remove(to);
        std::error_code error;
        if (!may_be_written_to) fs::create_hard_link(from, to, error);
        if (may_be_written_to || error) fs::copy_file(from, to);  // error: the disk has no links
        sync_folder(to.parent_path());
    }
}

}  // namespace breach::orchestrator
