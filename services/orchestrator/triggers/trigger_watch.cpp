#include "services/orchestrator/triggers/trigger_watch.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "core/exchange/provenance.hpp"
#include "core/fault/fault.hpp"
#include "core/phases/files.hpp"
#include "core/phases/phases.hpp"
#include "core/statistics/bisection.hpp"
#include "core/statistics/repeats.hpp"
#include "core/words/number.hpp"
#include "services/orchestrator/files/failpoint.hpp"
#include "services/orchestrator/files/frames.hpp"
#include "services/orchestrator/records/identity.hpp"
#include "services/orchestrator/study/graph.hpp"

namespace breach::orchestrator {

using nlohmann::json;
using Clock = std::chrono::steady_clock;

namespace {

constexpr double slack = 1e-6;  // names of snapshots carry six decimals [s]
constexpr auto reload_interval = std::chrono::milliseconds(1000);
constexpr auto look_for_telemetry = std::chrono::milliseconds(20);
constexpr auto ask_again_after = std::chrono::seconds(1);

bool has_ended(TaskState state) { return is_final(state) || state == TaskState::finalizing; }

/// It ended, and neither at its end nor by a breakdown, which is a result: the disk was full, it was
/// killed, or cancelled. What it has written is the beginning of what a retry makes of it.
bool was_cut_short(const Task& fem) {
    constexpr auto breakdown = static_cast<std::int64_t>(fault::ExitCode::breakdown);
    if (fem.state == TaskState::failed) return !fem.fault || fem.fault->exit_code != breakdown;
    return is_final(fem.state) && !has_output(fem.state);
}

std::string until_a_retry(const std::string& what_failed, const std::string& how) {
    return what_failed + " (" + how + "); a retry of the run arms this trigger again";
}

std::string how_it_ended(const Task& task) {
    return task.fault ? task.fault->summary : std::string(name_of(task.state));
}

std::string cut_short_text(const Task& fem) {
    return until_a_retry("the FEM did not come to its end", how_it_ended(fem));
}

bool has_regular_snapshots(const Task& fem, const json& scene) {
    const std::string key = "/fem/snapshot_interval=";
    for (const std::string& each : fem.overrides) {
        if (each.starts_with(key)) return std::stod(each.substr(key.size())) > 0.0;
    }
    return scene.at("fem").value("snapshot_interval", 0.0) > 0.0;
}

/// The values on the line on which the condition became true, by name.
json crossing_of(const criteria::Expression& condition, const criteria::Line& line) {
    json values{{"time", line.time}, {"step", line.step}};
    for (std::size_t i = 0; i < line.values.size(); ++i)
        values[condition.fields[i]] = line.values[i];
    return values;
}

json crossing_of(const criteria::Criterion& criterion) {
    return crossing_of(criterion.expression(), *criterion.crossing());
}

std::string in_short(double value) { return words::text_of(value, 4); }

/// Why the condition was not met by the FEM's end, and how near it came: what it asks for on the
/// last line.
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

/// Decided by a mean that may lie on the other side of the level: its own scatter and that of the
/// largest, of which the level is a share.
bool straddles(const statistics::Repeats& sample, const statistics::Repeats& largest,
               double share) {
    const double half = statistics::half_width_of_mean(sample).value_or(0.0);
    const double of_level = share * statistics::half_width_of_mean(largest).value_or(0.0);
    return std::abs(sample.mean - share * largest.mean) <= std::hypot(half, of_level);
}

/// Where the study has draws: which times were decided by a mean whose band straddles the level,
/// and which by fewer draws than were asked for.
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

std::int64_t written_at(const std::filesystem::path& file) {
    const auto time = std::chrono::file_clock::to_sys(std::filesystem::last_write_time(file));
    return std::chrono::duration_cast<std::chrono::milliseconds>(time.time_since_epoch()).count();
}

}  // namespace

void TriggerWatch::look() {
    watch_.changes();
    load_open_triggers();
    for (auto& [id, fem] : fems_) look_alone(fem);
}

/// Files of one FEM that cannot be read must not hold up the others: it is looked at again.
void TriggerWatch::look_alone(Fem& fem) {
    std::string trouble;
    try {
        read_on(fem);
        for (Armed& each : fem.armed) {
            feed(fem, each);
            if (lacks_depth(fem, each))
                expire_without_depth(fem, each);
            else if (each.lines_taken == fem.lines.size())
                settle(fem, each);
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

std::chrono::milliseconds TriggerWatch::patience() const {
    if (store_.last_event() != seen_event_) return std::chrono::milliseconds(0);
    const bool blind = std::ranges::any_of(
        fems_, [](const auto& entry) { return !entry.second.ended && entry.second.watch < 0; });
    return blind ? look_for_telemetry : reload_interval;
}

/// Only when something was stored since the last time, or a second has passed.
void TriggerWatch::load_open_triggers() {
    const std::int64_t newest = store_.last_event();
    if (newest == seen_event_ && Clock::now() - loaded_ < reload_interval) return;
    seen_event_ = newest;
    loaded_ = Clock::now();
    const std::vector<Trigger> open = store_.open_triggers();
    const auto is_open = [&](const Armed& armed) {
        return std::ranges::find(open, armed.trigger.id, &Trigger::id) != open.end();
    };
    for (auto& [id, fem] : fems_)
        std::erase_if(fem.armed, [&](const Armed& each) { return !is_open(each); });
    std::erase_if(fems_, [&](const auto& entry) {
        const Fem& fem = entry.second;
        if (fem.armed.empty()) watch_.remove(fem.watch);
        return fem.armed.empty();
    });
    for (const Trigger& trigger : open) {
        auto found = fems_.find(trigger.fem_task);
        if (found == fems_.end()) {
            auto stored = store_.task(trigger.fem_task);
            if (!stored) continue;  // disarmed and removed meanwhile
            Task task = std::move(*stored);
            const auto output = data_.output(task);
            const bool regular =
                has_regular_snapshots(task, json::parse(store_.scene_of(task.run).value()));
            const bool planned = store_.plans_transfers_of(task);
            Fem fem{.task = std::move(task),
                    .output = output,
                    .tail = telemetry::Tail(output / phases::files::telemetry),
                    .regular = regular,
                    .planned = planned};
            found = fems_.emplace(trigger.fem_task, std::move(fem)).first;
        }
        arm(found->second, trigger);
    }
    for (auto& [id, fem] : fems_)
        if (auto now = store_.task(id)) fem.task = std::move(*now);
}

void TriggerWatch::arm(Fem& fem, const Trigger& trigger) {
    for (Armed& each : fem.armed) {
        if (each.trigger.id != trigger.id) continue;
        each.trigger.state = trigger.state;
        return;
    }
    fem.armed.push_back(
        {.trigger = trigger, .work = work_of({trigger.name, trigger.kind, trigger.spec})});
    Armed& armed = fem.armed.back();
    if (trigger.kind == "manual") armed.noticed_at = epoch_ms();
}

void TriggerWatch::read_on(Fem& fem) {
    // Asked before reading: what ended before was written before.
    fem.ended = has_ended(fem.task.state);
    if (!fem.ended) fem.watch = watch_.add(fem.tail.file(), Notice::every_change);
    for (telemetry::Line& line : fem.tail.fresh()) fem.lines.push_back(std::move(line));
    if (!fem.critical_depth) look_for_stability(fem);
    fem.snapshots.clear();
    for (Frame& each : frames_in(fem.output, fem.task.phase))
        fem.snapshots.push_back({each.time, std::move(each.name)});
}

/// Only when a trigger asks: a run may be large. One that failed says nothing of the dam: it is
/// looked at again, as it may be retried while the FEM runs.
void TriggerWatch::look_for_stability(Fem& fem) {
    const auto asks = [](const Armed& each) { return asks_for_critical_depth(each.work); };
    if (!std::ranges::any_of(fem.armed, asks)) return;
    const std::optional<Task> lem = store_.stability_of(fem.task.run, fem.task.variant);
    fem.why_no_depth.clear();
    if (lem && !has_output(lem->state)) {
        if (is_final(lem->state)) fem.why_no_depth = how_it_ended(*lem);
        return;
    }
    double depth = std::numeric_limits<double>::quiet_NaN();
    if (lem && lem->result && lem->result->contains("critical_depth")) {
        depth = lem->result->at("critical_depth");
    }
    fem.critical_depth = depth;
}

bool TriggerWatch::lacks_depth(const Fem& fem, const Armed& armed) {
    return asks_for_critical_depth(armed.work) && !fem.critical_depth;
}

/// Not before the FEM's end: until then a retry of the stability analysis is in time.
void TriggerWatch::expire_without_depth(const Fem& fem, Armed& armed) {
    if (!fem.ended || fem.why_no_depth.empty() || is_final(armed.trigger.state)) return;
    const std::string why =
        until_a_retry("its stability analysis gave no critical depth", fem.why_no_depth);
    move(armed, TriggerEvent::expire, {{"why", why}});
}

/// A trigger that asks for the critical depth takes no line before that is known, so that what it
/// decides does not depend on which phase was faster.
void TriggerWatch::feed(const Fem& fem, Armed& armed) {
    if (lacks_depth(fem, armed)) return;
    for (; armed.lines_taken < fem.lines.size(); ++armed.lines_taken) {
        take_line(fem, armed, fem.lines[armed.lines_taken]);
    }
}

criteria::Line TriggerWatch::line_for(const Fem& fem, const criteria::Expression& condition,
                                      const telemetry::Line& line) {
    std::map<std::string, double> beside;
    if (fem.critical_depth) beside.emplace(critical_depth_field, *fem.critical_depth);
    return criteria::line_for(condition, line, beside);
}

/// What was true at the end and only not for long enough has begun: that is no sign of a dam that
/// stands.
void TriggerWatch::expire_unmet(const Fem& fem, Armed& armed,
                                const criteria::Criterion& criterion) {
    std::optional<criteria::Line> last;
    if (!fem.lines.empty()) last = line_for(fem, criterion.expression(), fem.lines.back());
    const bool begun = criterion.state() == criteria::Criterion::State::holding;
    expire(armed, never_met(criterion, armed.trigger.spec.value("hold_s", 0.0), last),
           begun ? WasMet::yes : WasMet::no);
}

void TriggerWatch::take_line(const Fem& fem, Armed& armed, const telemetry::Line& line) {
    const auto on = [&](const criteria::Expression& condition) {
        return line_for(fem, condition, line);
    };
    const auto note = [&](const criteria::Expression& condition, const criteria::Line& crossing) {
        armed.noticed_at = epoch_ms();
        armed.crossed = crossing_of(condition, crossing);
        armed.crossed_step = crossing.step;
    };
    const auto take = [&](const criteria::Criterion& criterion, const auto& take_on) {
        using State = criteria::Criterion::State;
        const bool before = criterion.state() == State::met;
        take_on(on(criterion.expression()));
        if (!before && criterion.state() == State::met)
            note(criterion.expression(), *criterion.crossing());
    };
    if (auto* when = std::get_if<When>(&armed.work)) {
        take(when->criterion, [&](const criteria::Line& each) { when->criterion.take(each); });
    } else if (auto* between = std::get_if<Between>(&armed.work)) {
        criteria::Window& window = between->window;
        const bool before = window.upper_edge().has_value();
        take(window.lower(), [&](const criteria::Line& each) { window.take_lower(each); });
        window.take_upper(on(window.upper()));
        const auto upper = window.upper_edge();
        if (!before && upper) note(window.upper(), *upper);
    }
}

// ---------------------------------------------------------------- deciding

void TriggerWatch::settle(Fem& fem, Armed& armed) {
    if (is_final(armed.trigger.state)) return;
    if (!fem.planned) {
        move(armed, TriggerEvent::expire,
             {{"why", "the run has no plan of transfers from its " + fem.task.label +
                          "; submit the study with this trigger"}});
        return;
    }
    std::visit([&](auto& work) { settle_work(fem, armed, work); }, armed.work);
}

void TriggerWatch::settle_work(Fem& fem, Armed& armed, Manual& manual) {
    if (armed.trigger.state == TriggerState::armed) move(armed, TriggerEvent::cross, {});
    take_first_from(fem, armed, manual.after);
}

void TriggerWatch::settle_work(Fem& fem, Armed& armed, When& when) {
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

void TriggerWatch::settle_work(Fem& fem, Armed& armed, Between& between) {
    using State = criteria::Criterion::State;
    const criteria::Criterion& lower = between.window.lower();
    const criteria::Expression& upper = between.window.upper();
    if (lower.state() != State::met) {
        if (fem.ended) expire_unmet(fem, armed, lower);
        return;
    }
    if (const auto since = between.window.shut_since()) {
        expire(armed,
               "there is no window: " + upper.text + " is true since " + in_short(since->time) +
                   " s, and " + lower.expression().text + " only from " +
                   in_short(lower.crossing()->time) +
                   " s on; post a trigger with other conditions to the run, or add transfer times "
                   "to it (breach extend)",
               WasMet::yes);
        return;
    }
    if (armed.trigger.state == TriggerState::armed)
        move(armed, TriggerEvent::cross, {{"crossed", crossing_of(lower)}});
    const double lower_edge = lower.crossing()->time;
    const bool wants_first = between.pick == criteria::Pick::first;
    const Snapshot* first = first_from(fem, lower_edge);
    if (wants_first && first && between.window.is_open_at(first->time)) {
        // As noted at the lower edge: how much was read of what follows must not matter.
        armed.crossed = crossing_of(lower);
        armed.crossed_step = lower.crossing()->step;
        take(fem, armed, *first, lower_edge);
        return;
    }
    const std::optional<criteria::Line> edge = between.window.upper_edge();
    if (!edge && !fem.ended) {
        if (wants_first && !first && !fem.regular) ask_for_snapshot(fem);
        return;
    }
    if (!edge && was_cut_short(fem.task)) {
        expire(armed, cut_short_text(fem.task), WasMet::yes);
        return;
    }
    // Snapshots before the edge were written in earlier steps and are all there. A FEM that never
    // got too distorted closes the window with its end.
    std::vector<double> times;
    const double limit = edge ? edge->time : std::numeric_limits<double>::max();
    for (const Snapshot& each : fem.snapshots) {
        if (each.time < limit - slack) times.push_back(each.time);
    }
    const double upper_edge = edge ? limit : times.empty() ? lower_edge : times.back();
    const auto time = criteria::picked(between.pick, lower_edge, upper_edge, times);
    if (!edge && !first) {
        expire(armed, "the FEM ended without a snapshot at or after " + spelt(lower_edge) + " s",
               WasMet::yes);
        return;
    }
    if (!time) {
        expire(armed,
               "no snapshot lies between " + spelt(lower_edge) + " s and " + spelt(upper_edge) +
                   " s; give a shorter snapshot_interval_s",
               WasMet::yes);
        return;
    }
    armed.crossed = {{"lower", crossing_of(lower)},
                     {"upper", edge ? crossing_of(upper, *edge) : json("the FEM's end")}};
    if (armed.noticed_at == 0) armed.noticed_at = epoch_ms();
    const double wanted = wants_first ? lower_edge
                          : between.pick == criteria::Pick::midpoint
                              ? 0.5 * (lower_edge + upper_edge)
                              : *time;
    take(fem, armed, *std::ranges::find(fem.snapshots, *time, &Snapshot::time), wanted);
}

void TriggerWatch::settle_work(Fem& fem, Armed& armed, Bisect& bisect) {
    if (!fem.ended) return;
    if (was_cut_short(fem.task)) {
        move(armed, TriggerEvent::expire, {{"why", cut_short_text(fem.task)}});
        return;
    }
    std::vector<double> times;
    std::vector<Snapshot> at;
    for (const Snapshot& each : fem.snapshots) {
        const bool inside = each.time >= bisect.from - slack && each.time <= bisect.to + slack;
        const bool apart = times.empty() || each.time - times.back() >= bisect.tolerance - slack;
        if (!inside || !apart) continue;
        times.push_back(each.time);
        at.push_back(each);
    }
    const std::vector<Sample> samples = store_.samples_of(armed.trigger.id);
    std::vector<std::optional<double>> runouts(times.size());
    for (const Sample& each : samples) {
        if (!each.ended) return;  // one round at a time: halving needs both answers
        const auto found = std::ranges::find(times, each.transfer_time);
        if (found != times.end())
            runouts[static_cast<std::size_t>(found - times.begin())] =
                each.runouts.empty() ? statistics::no_runout
                                     : statistics::repeats_of(each.runouts).mean;
    }
    const auto is_lost = [](const Sample& each) { return each.lost_by.has_value(); };
    if (const auto lost = std::ranges::find_if(samples, is_lost); lost != samples.end()) {
        const std::string what = "the runout at " + spelt(lost->transfer_time) + " s failed";
        move(armed, TriggerEvent::expire, {{"why", until_a_retry(what, *lost->lost_by)}});
        return;
    }
    if (times.empty()) {
        move(armed, TriggerEvent::expire, {{"why", "no snapshot lies in the range"}});
        return;
    }
    const statistics::Advice advice =
        statistics::advise(times, runouts, bisect.share, bisect.seeds);
    const bool enough = samples.size() >= static_cast<std::size_t>(bisect.most_runs);
    if (!advice.run_next.empty() && !enough) {
        if (armed.trigger.state == TriggerState::armed) move(armed, TriggerEvent::cross, {});
        armed.noticed_at = epoch_ms();
        std::vector<Firing> firings;
        for (const std::size_t i : advice.run_next)
            firings.push_back(firing_of(fem, armed, at[i], times[i]));
        store_.write([&](Transaction& transaction) {
            for (const Firing& each : firings) transaction.add_firing(armed.trigger, each);
        });
        return;
    }
    json result{{"runs", samples.size()},
                {"uniform_runs", times.size()},
                {"complete", advice.run_next.empty()}};
    tell_draws(samples, bisect.share, advice.plateau, result);
    if (advice.plateau) {
        const auto edge = [](const statistics::Edge& each) {
            return json{{"off", each.off ? json(*each.off) : json(nullptr)}, {"on", each.on}};
        };
        result["lower"] = edge(advice.plateau->lower);
        result["upper"] = edge(advice.plateau->upper);
        result["largest_runout"] = advice.plateau->largest;
        result["largest_at"] = advice.plateau->largest_at;
    }
    const TriggerEvent event = advice.plateau ? TriggerEvent::fire : TriggerEvent::expire;
    json detail{{"result", result}};
    if (!advice.plateau) detail["why"] = "no transfer time gave a runout above zero";
    move(armed, event, detail, result);
}

// ---------------------------------------------------------------- firing

const TriggerWatch::Snapshot* TriggerWatch::first_from(const Fem& fem, double wanted) {
    const auto first = std::ranges::find_if(
        fem.snapshots, [&](const Snapshot& each) { return each.time >= wanted - slack; });
    return first == fem.snapshots.end() ? nullptr : &*first;
}

void TriggerWatch::take_first_from(Fem& fem, Armed& armed, double wanted) {
    if (const Snapshot* first = first_from(fem, wanted)) {
        take(fem, armed, *first, wanted);
    } else if (fem.ended) {
        expire(armed, "the FEM ended without a snapshot at or after " + spelt(wanted) + " s",
               WasMet::yes);
    } else if (!fem.regular) {
        ask_for_snapshot(fem);
    }
}

void TriggerWatch::take(Fem& fem, Armed& armed, const Snapshot& snapshot, double wanted) {
    const double within = armed.trigger.spec.value("within_s", std::numeric_limits<double>::max());
    const double lag = snapshot.time - wanted;
    if (lag > within + slack) {
        expire(armed,
               "the first snapshot after " + spelt(wanted) + " s is at " + spelt(snapshot.time) +
                   " s, later than within_s = " + spelt(within) +
                   " s allows; give snapshot_interval_s",
               WasMet::yes);
        return;
    }
    const Firing firing = firing_of(fem, armed, snapshot, wanted);
    reach(Failpoint::firing_before);
    store_.write([&](Transaction& transaction) {
        if (!transaction.add_firing(armed.trigger, firing)) return;
        transaction.move_trigger(armed.trigger, TriggerEvent::fire,
                                 {{"transfer_time", firing.transfer_time}});
    });
    reach(Failpoint::firing_after);
    armed.trigger.state = TriggerState::fired;
    spdlog::info("{}: trigger {} fired, {} for {:.6f} s", fem.task.id, armed.trigger.name,
                 snapshot.name, wanted);
}

Firing TriggerWatch::firing_of(const Fem& fem, const Armed& armed, const Snapshot& snapshot,
                               double wanted) const {
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

/// Renamed into place. Asked again when nothing came: a FEM that was killed has not answered.
void TriggerWatch::ask_for_snapshot(Fem& fem) {
    const auto request = fem.output / phases::files::request;
    if (std::filesystem::exists(request) || Clock::now() - fem.asked < ask_again_after) return;
    const auto draft = fem.output / (std::string(phases::files::request) + ".new");
    std::ofstream(draft) << utc_now() << "\n";
    std::error_code error;
    std::filesystem::rename(draft, request, error);
    fem.asked = Clock::now();
}

void TriggerWatch::expire(Armed& armed, const std::string& why, WasMet was_met) {
    move(armed, TriggerEvent::expire, {{"why", why}}, {{"was_met", was_met == WasMet::yes}});
}

void TriggerWatch::move(Armed& armed, TriggerEvent event, json detail, const json& result) {
    store_.write([&](Transaction& transaction) {
        if (!result.is_null()) transaction.keep_trigger_result(armed.trigger.id, result);
        transaction.move_trigger(armed.trigger, event, detail);
    });
    armed.trigger.state = *next(armed.trigger.state, event);
}

}  // namespace breach::orchestrator
