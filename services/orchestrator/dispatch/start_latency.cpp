#include "services/orchestrator/dispatch/start_latency.hpp"

namespace breach::orchestrator {

void StartLatency::note(const Store& store, const DataFolder& data, const Task& task) {
    const auto note = [&](Histogram& in, std::int64_t since) {
        if (const auto waited = clock_.seconds_since(since)) in.add(*waited);
    };
    if (const auto ready_at = store.ready_at(task.id)) note(queue_wait_, *ready_at);
    if (task.release != Release::file_exists) return;
    std::error_code error;
    const auto appeared =
        std::filesystem::last_write_time(data.input(task, store.task(*task.parent).value()), error);
    if (error) return;
    const auto since = std::chrono::file_clock::to_sys(appeared).time_since_epoch();
    note(snapshot_to_start_, std::chrono::duration_cast<std::chrono::milliseconds>(since).count());
}

}  // namespace breach::orchestrator
