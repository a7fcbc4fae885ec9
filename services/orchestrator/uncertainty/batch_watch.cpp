// Called by the dispatcher in each round; does something only when an event was stored since. It
// waits until all tasks and triggers of a run have ended, then adds a batch or ends the plan.
// Killed before the transaction, the next start comes to the same batch: samples follow from the
// seed and the number drawn.
#include "services/orchestrator/uncertainty/batch_watch.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>

#include "core/fault/fault.hpp"
#include "services/orchestrator/study/sweep_extension.hpp"
#include "services/orchestrator/uncertainty/inverse_search.hpp"

namespace breach::orchestrator {

using nlohmann::json;

/// seen_event_ moves on only when no run had trouble: otherwise a run that failed for a full disk
/// would wait for the next event, which may never come. An error is logged when its text changes,
/// not in every round.
bool BatchWatch::look() {
    const std::int64_t newest = store_.last_event();
    if (newest == seen_event_) return false;
    bool added = false;
    std::map<std::string, std::string> troubles;
    for (const Batches& each : store_.open_batches()) {
        try {
            added |= settle(each);
        } catch (const std::exception& error) {
            troubles[each.run] = error.what();
            if (troubles_[each.run] != error.what())
                spdlog::error("{}: no more variants for now: {}", each.run, error.what());
        }
    }
    troubles_ = std::move(troubles);
    if (troubles_.empty()) seen_event_ = newest;
    return added;
}

/// A trigger that may still fire can add tasks, so it counts as open.
bool BatchWatch::has_ended(const std::string& run) const {
    const auto known = store_.run(run);
    if (!known || known->tasks_ended < known->tasks_total) return false;
    const std::vector<Trigger> triggers = store_.triggers_of(run);
    return std::ranges::all_of(triggers, [](const Trigger& each) { return is_final(each.state); });
}

bool BatchWatch::settle(const Batches& batches) {
    if (!has_ended(batches.run)) return false;
    // Two kinds of study share this watch and differ in their spec only.
    if (batches.spec.contains("target")) return search_on(batches);
    const json study = unless_removed(store_.study_of(batches.run));
    const json& entry = study.at("uncertainty");
    const Narrowness now = narrowness_of(unless_removed(ensemble_of(store_, batches.run)));
    if (now.reached) {
        end(batches, "met", "");
    } else if (now.results == 0) {
        // More of the same would cost as much and give as little.
        end(batches, "given_up", "no sample has a result: no more are drawn");
    } else if (entry.at("drawn") >= entry.at("samples")) {
        end(batches, "given_up",
            "all samples are used and the interval is still too wide; extend the run by more "
            "samples");
    } else {
        return draw_on(batches, study);
    }
    return false;
}

bool BatchWatch::draw_on(const Batches& batches, const json& study) {
    const json& entry = study.at("uncertainty");
    const std::size_t asked = entry.at("samples");
    const std::size_t drawn = std::min(
        asked, entry.at("drawn").get<std::size_t>() + batches.spec.at("batch").get<std::size_t>());
    json wanted = entry;
    wanted["drawn"] = drawn;
    return extend(batches, study, wanted);
}

/// Adds the next value of the inverse search.
bool BatchWatch::search_on(const Batches& batches) {
    const Ensemble ensemble = unless_removed(ensemble_of(store_, batches.run));
    const json scene = json::parse(unless_removed(store_.scene_of(batches.run)));
    const statistics::InverseAdvice advice = inverse_search(ensemble, scene)->advice;
    if (advice.run_next.empty()) {
        end(batches, advice.found ? "met" : "given_up", advice.refused);
        return false;
    }
    json wanted = ensemble.entry;
    for (const double each : advice.run_next) wanted["target"]["values"].push_back(each);
    return extend(batches, unless_removed(store_.study_of(batches.run)), wanted);
}

bool BatchWatch::extend(const Batches& batches, const json& study, const json& entry) {
    bool added = false;
    try {
        const RunSoFar so_far{.study = study,
                              .scene = unless_removed(store_.scene_of(batches.run)),
                              .tasks = store_.tasks_of(batches.run)};
        const Extension extension = plan_more_variants(so_far, data_, numerics_, entry);
        added = store_.write([&](Transaction& transaction) {
            // Asked again within the transaction: a cancel may have come since the row was read.
            const bool open = transaction.batches_are_open(batches.run);
            if (open) transaction.extend_run(batches.run, extension);
            return open;
        });
        if (added) spdlog::info("{}: {} more variants", batches.run, extension.samples.size());
    } catch (const fault::BadInput& error) {
        end(batches, "given_up", std::string("the study cannot go on: ") + error.what());
    }
    return added;
}

/// From "open" to its end; a retry of the run's tasks opens it again (Batches in records.hpp).
void BatchWatch::end(const Batches& batches, const char* state, const std::string& why) {
    store_.write(
        [&](Transaction& transaction) { transaction.end_batches(batches.run, state, why); });
}

}  // namespace breach::orchestrator
