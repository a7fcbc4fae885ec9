// Moves tasks out of `blocked` (to `ready` or `skipped`) and out of `retry_wait`. The dispatcher
// calls it for one parent when that parent's folder or state has changed, and for all parents
// after a start. Every call decides from store and disk alone, so that calls may be repeated or
// lost.
#include "services/orchestrator/dispatch/release.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "core/words/number.hpp"
#include "services/orchestrator/records/identity.hpp"

namespace breach::orchestrator {

namespace {

/// Why the FEM never reached the child's time; nothing: it did not end regularly before. A FEM
/// whose mesh entangles has succeeded, and so has a run without the later times.
std::optional<std::string> why_not_reached(const Task& parent, const BlockedTask& child) {
    if (parent.not_reached && parent.fault) return parent.fault->summary;
    if (!has_output(parent.state) || !parent.result || !child.transfer_time) return std::nullopt;
    if (parent.result->value("ended", "") != "entangled") return std::nullopt;
    return "the FEM ended entangled at " + words::text_of(parent.result->value("end_time", 0.0)) +
           " s, before " + words::text_of(*child.transfer_time) + " s";
}

/// Ignores outputs that the cache is placing: it may remove them before the task runs
/// (dispatch/cache.cpp).
std::set<std::string> outputs_of(const DataFolder& data, const Task& task) {
    const auto is_being_placed = [&] {
        return task.state == TaskState::ready && std::filesystem::exists(data.reused(task));
    };
    // Asked before and after the listing: the cache may begin or end in between.
    const bool was_being_placed = is_being_placed();
    std::set<std::string> names;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(data.output(task), error))
        names.insert(entry.path().filename());
    if (was_being_placed || is_being_placed()) names.clear();
    return names;
}

/// `not_reached` does not count as a failure of the run; anything else does.
void skip(Transaction& transaction, const Task& parent, const BlockedTask& child) {
    if (const auto beyond = why_not_reached(parent, child)) {
        transaction.pass_over_task(child.id, *beyond);
    } else {
        const std::string why = parent.label + " " + std::string(name_of(parent.state)) +
                                " before it gave " + child.input;
        transaction.fail_task(child.id, TaskEvent::skip, {std::nullopt, why});
    }
}

}  // namespace

void settle_children(Store& store, const DataFolder& data, const std::string& parent_id) {
    const std::vector<BlockedTask> children = store.blocked_children(parent_id);
    if (children.empty()) return;
    const std::optional<Task> parent = store.task(parent_id);
    if (!parent) return;  // removed
    // The file decides, not the FEM's end: snapshots before the mesh entangled are good.
    const std::set<std::string> files = outputs_of(data, *parent);
    std::vector<BlockedTask> released;
    std::vector<BlockedTask> skipped;
    for (const BlockedTask& child : children) {
        const bool delivered = child.release == Release::file_exists ? files.contains(child.input)
                                                                     : has_output(parent->state);
        if (delivered) {
            released.push_back(child);
        } else if (is_final(parent->state)) {
            skipped.push_back(child);
        }
    }
    if (released.empty() && skipped.empty()) return;
    store.write([&](Transaction& transaction) {
        for (const BlockedTask& each : released)
            transaction.try_move_task(each.id, TaskEvent::release);
        for (const BlockedTask& each : skipped) skip(transaction, *parent, each);
    });
    // A skipped task is final, so that its own children are skipped too. Depth: three phases.
    for (const BlockedTask& each : skipped) settle_children(store, data, each.id);
}

void settle_all_children(Store& store, const DataFolder& data, const std::stop_token& stop) {
    for (const std::string& parent : store.parents_of_blocked()) {
        if (stop.stop_requested()) return;
        settle_children(store, data, parent);
    }
}

void release_due_retries(Store& store) {
    for (const std::string& task : store.due_retries(epoch_ms())) {
        store.write([&](Transaction& transaction) {
            transaction.try_move_task(task, TaskEvent::wait_over);
        });
    }
}

}  // namespace breach::orchestrator
