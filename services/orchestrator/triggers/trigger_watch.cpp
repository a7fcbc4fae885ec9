// Keeps one WatchedFem per FEM with open triggers, in memory only: load_open_triggers makes it
// from the store, forget_what_is_not drops it with its last open trigger. After a restart the
// telemetry is read again from its first line.
#include "services/orchestrator/triggers/trigger_watch.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>

#include "core/fault/fault.hpp"

namespace breach::orchestrator {

using Clock = std::chrono::steady_clock;

namespace {

constexpr auto reload_interval = std::chrono::milliseconds(1000);
/// A FEM whose file does not exist yet cannot be watched; short, because a snapshot's delay
/// counts.
constexpr auto look_for_telemetry = std::chrono::milliseconds(20);

}  // namespace

void TriggerWatch::look() {
    watch_.changes();
    load_open_triggers();
    for (auto& [id, fem] : fems_) look_alone(fem);
}

/// Unreadable files of one FEM must not delay the others; it is read again in the next round.
void TriggerWatch::look_alone(WatchedFem& fem) {
    std::string trouble;
    try {
        fem.read_on(store_, watch_);
        for (ArmedTrigger& each : fem.armed) {
            each.feed(fem);
            settling_.settle(fem, each);
        }
    } catch (const fault::IoError& error) {
        trouble = error.what();
    } catch (const std::filesystem::filesystem_error& error) {
        trouble = error.what();
    }
    if (!trouble.empty() && trouble != fem.trouble)
        spdlog::error("{}: its triggers wait: {}", fem.task.id, trouble);
    fem.trouble = trouble;
}

/// Zero: something was stored since the last look, perhaps a new trigger.
std::chrono::milliseconds TriggerWatch::patience() const {
    if (store_.last_event() != seen_event_) return std::chrono::milliseconds(0);
    const bool blind = std::ranges::any_of(
        fems_, [](const auto& entry) { return !entry.second.ended && entry.second.watch < 0; });
    return blind ? look_for_telemetry : reload_interval;
}

/// Loads only when something was stored, or a second has passed.
void TriggerWatch::load_open_triggers() {
    const std::int64_t newest = store_.last_event();
    if (newest == seen_event_ && Clock::now() - loaded_ < reload_interval) return;
    seen_event_ = newest;
    loaded_ = Clock::now();
    const std::vector<Trigger> open = store_.open_triggers();
    forget_what_is_not(open);
    for (const Trigger& each : open) arm(each);
    for (auto& [id, fem] : fems_)
        if (auto now = store_.task(id)) fem.task = std::move(*now);
}

void TriggerWatch::forget_what_is_not(const std::vector<Trigger>& open) {
    for (auto& [id, fem] : fems_) {
        std::erase_if(fem.armed, [&](const ArmedTrigger& each) {
            return std::ranges::find(open, each.trigger.id, &Trigger::id) == open.end();
        });
        if (fem.armed.empty()) watch_.remove(fem.watch);
    }
    std::erase_if(fems_, [](const auto& entry) { return entry.second.armed.empty(); });
}

void TriggerWatch::arm(const Trigger& trigger) {
    auto found = fems_.find(trigger.fem_task);
    if (found == fems_.end()) {
        auto task = store_.task(trigger.fem_task);
        if (!task) return;  // disarmed and removed
        found = fems_.emplace(trigger.fem_task, WatchedFem(std::move(*task), store_, data_)).first;
    }
    auto& armed = found->second.armed;
    const auto known = std::ranges::find(armed, trigger.id,
                                         [](const ArmedTrigger& each) { return each.trigger.id; });
    if (known == armed.end())
        armed.emplace_back(trigger);
    else
        known->trigger.state = trigger.state;
}

}  // namespace breach::orchestrator
