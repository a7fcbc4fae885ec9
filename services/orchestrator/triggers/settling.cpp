// What each kind of trigger does with the lines read so far. TriggerWatch calls settle() for
// every open trigger in each round of the dispatcher; it decides from telemetry and snapshots
// alone, so that a killed service comes to the same decision when it reads the file again. A
// trigger goes from armed to holding (and back, if the condition ceases), then to fired or
// expired; a cancelled run disarms it.
#include "services/orchestrator/triggers/settling.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/exchange/provenance.hpp"
#include "core/statistics/bisection.hpp"
#include "core/statistics/repeats.hpp"
#include "core/words/number.hpp"
#include "services/orchestrator/files/failpoint.hpp"
#include "services/orchestrator/records/identity.hpp"
#include "services/orchestrator/records/or_null.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

/// The remedy is part of the reason: a user sees the reason only.
std::string until_a_retry(const std::string& what_failed, const std::string& how) {
    return what_failed + " (" + how + "); a retry of the run arms this trigger again";
}

std::string cut_short_text(const Task& fem) {
    return until_a_retry("the FEM did not come to its end", how_it_ended(fem));
}

std::string in_short(double value) { return words::text_of(value, 4); }

/// Why the condition was not met before the FEM's end, with its values on the last line.
std::string never_met(const criteria::Criterion& criterion, double hold,
                      const std::optional<criteria::Line>& last) {
    const criteria::Expression& condition = criterion.expression();
    if (!last) return "the FEM ended without a line of telemetry";
    std::string text = "the FEM ended at " + in_short(last->time) + " s, and " + condition.text;
    if (criterion.state() == criteria::Criterion::State::holding)
        text += " had been true for only " + in_short(last->time - criterion.crossing()->time) +
                " of " + in_short(hold) + " s";
    else
        text += hold > 0.0 ? " had not held for " + in_short(hold) + " s" : " had not been true";
    for (std::size_t i = 0; i < condition.fields.size(); ++i)
        text += (i == 0 ? "; at its end " : ", ") + condition.fields[i] + " = " +
                (std::isfinite(last->values[i]) ? in_short(last->values[i]) : "not known");
    return text;
}

std::string never_open(const criteria::Window& window, const criteria::Line& since) {
    return "there is no window: " + window.upper().text + " is true since " + in_short(since.time) +
           " s, and " + window.lower().expression().text + " only from " +
           in_short(window.lower().crossing()->time) +
           " s on; post a trigger with other conditions to the run, or add transfer times to it "
           "(breach extend)";
}

std::int64_t written_at(const std::filesystem::path& file) {
    const auto time = std::chrono::file_clock::to_sys(std::filesystem::last_write_time(file));
    return std::chrono::duration_cast<std::chrono::milliseconds>(time.time_since_epoch()).count();
}

Firing firing_of(const WatchedFem& fem, const ArmedTrigger& armed, const Frame& snapshot,
                 double wanted) {
    const auto file = fem.output / snapshot.name;
    return {.trigger = armed.trigger.id,
            .transfer_time = snapshot.time,
            .wanted_time = wanted,
            .snapshot = snapshot.name,
            .sha256 = exchange::sha256_of_file(file),
            .crossed = armed.crossed,
            .fem_step = armed.crossed_step,
            .noticed_at = armed.noticed_at,
            .written_at = written_at(file)};
}

// Samples and result of a bisection.

/// Whether the mean may be on the other side of the level, considering its own scatter and that of
/// the largest mean, which defines the level.
bool straddles(const statistics::Repeats& sample, const statistics::Repeats& largest,
               double share) {
    const double half = statistics::half_width_of_mean(sample).value_or(0.0);
    const double of_level = share * statistics::half_width_of_mean(largest).value_or(0.0);
    return std::abs(sample.mean - share * largest.mean) <= std::hypot(half, of_level);
}

/// Reports, for a study with repeats, times decided by a mean within the scatter of the level, and
/// by fewer repeats than requested.
void tell_draws(const std::vector<Sample>& samples, double share,
                const std::optional<statistics::Plateau>& plateau, json& result) {
    const auto repeated = std::ranges::max_element(samples, {}, &Sample::draws);
    if (repeated == samples.end() || repeated->draws < 2) return;
    result["draws"] = repeated->draws;
    result["straddling"] = json::array();
    result["with_fewer_draws"] = json::array();
    for (const Sample& each : samples)
        if (each.runouts.size() < each.draws)
            result["with_fewer_draws"].push_back(each.transfer_time);
    if (!plateau) return;
    const auto top = std::ranges::find(samples, plateau->largest_at, &Sample::transfer_time);
    const statistics::Repeats largest = statistics::repeats_of(top->runouts);
    for (const Sample& each : samples) {
        if (each.runouts.empty() || &each == &*top) continue;
        const statistics::Repeats sample = statistics::repeats_of(each.runouts);
        if (straddles(sample, largest, share))
            result["straddling"].push_back(
                {{"transfer_time", each.transfer_time},
                 {"runout", sample.mean},
                 {"half_width", statistics::half_width_of_mean(sample).value_or(0)}});
    }
}

json as_json(const statistics::Edge& edge) { return {{"off", or_null(edge.off)}, {"on", edge.on}}; }

/// Snapshots in the range, at least the tolerance apart.
std::vector<Frame> candidates_of(const Bisect& bisect, const std::vector<Frame>& snapshots) {
    std::vector<Frame> found;
    for (const Frame& each : snapshots) {
        const bool inside =
            each.time >= bisect.from - snapshot_slack && each.time <= bisect.to + snapshot_slack;
        const bool apart =
            found.empty() || each.time - found.back().time >= bisect.tolerance - snapshot_slack;
        if (inside && apart) found.push_back(each);
    }
    return found;
}

/// From the samples, which have all ended.
statistics::Advice advice_for(const Bisect& bisect, const std::vector<Frame>& candidates,
                              const std::vector<Sample>& samples) {
    std::vector<double> times;
    std::vector<std::optional<double>> runouts;
    for (const Frame& each : candidates) {
        times.push_back(each.time);
        const auto sample = std::ranges::find(samples, each.time, &Sample::transfer_time);
        runouts.push_back(sample == samples.end()   ? std::nullopt
                          : sample->runouts.empty() ? std::optional(statistics::no_runout)
                                                    : statistics::repeats_of(sample->runouts).mean);
    }
    return statistics::advise(times, runouts, bisect.share, bisect.seeds);
}

json result_of(const Bisect& bisect, const std::vector<Frame>& candidates,
               const std::vector<Sample>& samples, const statistics::Advice& advice) {
    json result{{"runs", samples.size()},
                {"uniform_runs", candidates.size()},
                {"complete", advice.run_next.empty()}};
    tell_draws(samples, bisect.share, advice.plateau, result);
    if (!advice.plateau) return result;
    result["lower"] = as_json(advice.plateau->lower);
    result["upper"] = as_json(advice.plateau->upper);
    result["largest_runout"] = advice.plateau->largest;
    result["largest_at"] = advice.plateau->largest_at;
    return result;
}

}  // namespace

void Settling::settle(WatchedFem& fem, ArmedTrigger& armed) {
    if (is_final(armed.trigger.state)) return;
    if (const StabilityField* field = armed.lacks(fem)) {
        // Waits for the FEM's end: until then a retry of the stability analysis can succeed.
        const auto known = fem.stability.find(field->name);
        if (!fem.ended || known == fem.stability.end() || known->second.why_none.empty()) return;
        expire(armed,
               until_a_retry("its stability analysis gave no " + std::string(field->name),
                             known->second.why_none),
               WasMet::not_told);
    } else if (armed.lines_taken < fem.lines.size()) {
        return;
    } else if (!fem.planned) {
        expire(armed,
               "the run has no plan of transfers from its " + fem.task.label +
                   "; submit the study with this trigger",
               WasMet::not_told);
    } else {
        std::visit([&](auto& work) { settle_work(fem, armed, work); }, armed.work);
    }
}

/// No condition: the order itself was the crossing.
void Settling::settle_work(WatchedFem& fem, ArmedTrigger& armed, Manual& manual) {
    if (armed.trigger.state == TriggerState::armed) move(armed, TriggerEvent::cross, {});
    take_first_from(fem, armed, manual.after);
}

void Settling::settle_work(WatchedFem& fem, ArmedTrigger& armed, When& when) {
    using State = criteria::Criterion::State;
    const State state = when.criterion.state();
    const bool holding = armed.trigger.state == TriggerState::holding;
    if (state == State::armed && holding) move(armed, TriggerEvent::uncross, {});
    if (state != State::armed && !holding)
        move(armed, TriggerEvent::cross, {{"crossed", crossing_of(when.criterion)}});
    if (state == State::met) {
        take_first_from(fem, armed, when.criterion.met_at());
    } else if (fem.ended) {
        expire_unmet(fem, armed, when.criterion);
    }
}

void Settling::settle_work(WatchedFem& fem, ArmedTrigger& armed, Between& between) {
    const criteria::Window& window = between.window;
    const criteria::Criterion& lower = window.lower();
    if (lower.state() != criteria::Criterion::State::met) {
        if (fem.ended) expire_unmet(fem, armed, lower);
        return;
    }
    if (const auto since = window.shut_since())
        return expire(armed, never_open(window, *since), WasMet::yes);
    if (armed.trigger.state == TriggerState::armed)
        move(armed, TriggerEvent::cross, {{"crossed", crossing_of(lower)}});
    const double lower_edge = lower.crossing()->time;
    const bool wants_first = between.pick == criteria::Pick::first;
    const Frame* first = fem.first_from(lower_edge);
    if (wants_first && first && window.is_open_at(first->time)) {
        // Values at the lower edge: independent of how much was read after it.
        armed.crossed = crossing_of(lower);
        armed.crossed_step = lower.crossing()->step;
        take(fem, armed, *first, lower_edge);
    } else if (window.upper_edge() || fem.ended) {
        pick_in_window(fem, armed, between);
    } else if (wants_first && !first && !fem.regular) {
        fem.ask_for_snapshot();
    }
}

/// Snapshots before the upper edge were written in earlier steps, so all exist. The end of a FEM
/// whose mesh stays good closes the window.
void Settling::pick_in_window(const WatchedFem& fem, ArmedTrigger& armed, const Between& between) {
    const criteria::Criterion& lower = between.window.lower();
    const double lower_edge = lower.crossing()->time;
    const std::optional<criteria::Line> edge = between.window.upper_edge();
    if (!edge && fem.was_cut_short()) return expire(armed, cut_short_text(fem.task), WasMet::yes);
    if (!edge && !fem.first_from(lower_edge)) return expire_without_snapshot(armed, lower_edge);
    std::vector<double> times;
    const double limit = edge ? edge->time : std::numeric_limits<double>::max();
    for (const Frame& each : fem.snapshots)
        if (each.time < limit - snapshot_slack) times.push_back(each.time);
    const double upper_edge = edge ? limit : times.empty() ? lower_edge : times.back();
    const auto time = criteria::picked(between.pick, lower_edge, upper_edge, times);
    if (!time)
        return expire(armed,
                      "no snapshot lies between " + spelt(lower_edge) + " s and " +
                          spelt(upper_edge) + " s; give a shorter snapshot_interval_s",
                      WasMet::yes);
    armed.crossed = {
        {"lower", crossing_of(lower)},
        {"upper", edge ? crossing_of(between.window.upper(), *edge) : json("the FEM's end")}};
    if (armed.noticed_at == 0) armed.noticed_at = epoch_ms();
    const double wanted = between.pick == criteria::Pick::first ? lower_edge
                          : between.pick == criteria::Pick::midpoint
                              ? 0.5 * (lower_edge + upper_edge)
                              : *time;
    take(fem, armed, *std::ranges::find(fem.snapshots, *time, &Frame::time), wanted);
}

/// After the FEM's end, because its snapshots are the candidates; each round fires several times.
void Settling::settle_work(WatchedFem& fem, ArmedTrigger& armed, Bisect& bisect) {
    if (!fem.ended) return;
    if (fem.was_cut_short()) return expire(armed, cut_short_text(fem.task), WasMet::not_told);
    const std::vector<Sample> samples = store_.samples_of(armed.trigger.id);
    // One round at a time: halving needs both results.
    if (!std::ranges::all_of(samples, &Sample::ended)) return;
    const auto is_lost = [](const Sample& each) { return each.lost_by.has_value(); };
    if (const auto lost = std::ranges::find_if(samples, is_lost); lost != samples.end()) {
        const std::string what = "the runout at " + spelt(lost->transfer_time) + " s failed";
        return expire(armed, until_a_retry(what, *lost->lost_by), WasMet::not_told);
    }
    const std::vector<Frame> candidates = candidates_of(bisect, fem.snapshots);
    if (candidates.empty()) return expire(armed, "no snapshot lies in the range", WasMet::not_told);
    const statistics::Advice advice = advice_for(bisect, candidates, samples);
    const bool enough = samples.size() >= static_cast<std::size_t>(bisect.most_runs);
    if (!advice.run_next.empty() && !enough) {
        if (armed.trigger.state == TriggerState::armed) move(armed, TriggerEvent::cross, {});
        armed.noticed_at = epoch_ms();
        std::vector<Firing> firings;
        for (const std::size_t i : advice.run_next)
            firings.push_back(firing_of(fem, armed, candidates[i], candidates[i].time));
        store_.write([&](Transaction& transaction) {
            for (const Firing& each : firings) transaction.add_firing(armed.trigger, each);
        });
        return;
    }
    const json result = result_of(bisect, candidates, samples, advice);
    json detail{{"result", result}};
    if (!advice.plateau) detail["why"] = "no transfer time gave a runout above zero";
    move(armed, advice.plateau ? TriggerEvent::fire : TriggerEvent::expire, detail, result);
}

// ---------------------------------------------------------------- firing

void Settling::take_first_from(WatchedFem& fem, ArmedTrigger& armed, double wanted) {
    if (const Frame* first = fem.first_from(wanted)) {
        take(fem, armed, *first, wanted);
    } else if (fem.ended) {
        expire_without_snapshot(armed, wanted);
    } else if (!fem.regular) {
        fem.ask_for_snapshot();
    }
}

/// Firing and move in one transaction: killed before it, the trigger is still open and comes here
/// again.
void Settling::take(const WatchedFem& fem, ArmedTrigger& armed, const Frame& snapshot,
                    double wanted) {
    const double within = armed.trigger.spec.value("within_s", std::numeric_limits<double>::max());
    if (snapshot.time - wanted > within + snapshot_slack)
        return expire(armed,
                      "the first snapshot after " + spelt(wanted) + " s is at " +
                          spelt(snapshot.time) + " s, later than within_s = " + spelt(within) +
                          " s allows; give snapshot_interval_s",
                      WasMet::yes);
    const Firing firing = firing_of(fem, armed, snapshot, wanted);
    pass_failpoint("firing_before");
    store_.write([&](Transaction& transaction) {
        if (!transaction.add_firing(armed.trigger, firing)) return;
        transaction.move_trigger(armed.trigger, TriggerEvent::fire,
                                 {{"transfer_time", firing.transfer_time}});
    });
    pass_failpoint("firing_after");
    armed.trigger.state = TriggerState::fired;
    spdlog::info("{}: trigger {} fired, {} for {:.6f} s", fem.task.id, armed.trigger.name,
                 snapshot.name, wanted);
}

/// A condition that was true at the end but not for the hold counts as met: the dam does not stand.
void Settling::expire_unmet(const WatchedFem& fem, ArmedTrigger& armed,
                            const criteria::Criterion& criterion) {
    std::optional<criteria::Line> last;
    if (!fem.lines.empty()) last = fem.line_for(criterion.expression(), fem.lines.back());
    const bool begun = criterion.state() == criteria::Criterion::State::holding;
    expire(armed, never_met(criterion, armed.trigger.spec.value("hold_s", 0.0), last),
           begun ? WasMet::yes : WasMet::no);
}

void Settling::expire_without_snapshot(ArmedTrigger& armed, double wanted) {
    expire(armed, "the FEM ended without a snapshot at or after " + spelt(wanted) + " s",
           WasMet::yes);
}

void Settling::expire(ArmedTrigger& armed, const std::string& why, WasMet was_met) {
    const json result =
        was_met == WasMet::not_told ? json() : json{{"was_met", was_met == WasMet::yes}};
    move(armed, TriggerEvent::expire, {{"why", why}}, result);
}

void Settling::move(ArmedTrigger& armed, TriggerEvent event, json detail, const json& result) {
    store_.write([&](Transaction& transaction) {
        if (!result.is_null()) transaction.keep_trigger_result(armed.trigger.id, result);
        transaction.move_trigger(armed.trigger, event, detail);
    });
    armed.trigger.state = *next(armed.trigger.state, event);
}

}  // namespace breach::orchestrator
