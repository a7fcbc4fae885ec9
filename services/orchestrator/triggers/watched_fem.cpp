// What is known of one FEM for its triggers: telemetry, snapshots, critical depth, end. Used by
// TriggerWatch on the dispatcher's thread. All of it is derived from files and rows, none is
// stored.
#include "services/orchestrator/triggers/watched_fem.hpp"

#include <algorithm>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/fault/fault.hpp"
#include "core/phases/files.hpp"
#include "services/orchestrator/records/identity.hpp"
#include "services/orchestrator/study/graph.hpp"

namespace breach::orchestrator {

using nlohmann::json;
using Clock = std::chrono::steady_clock;

namespace {

constexpr auto ask_again_after = std::chrono::seconds(1);

bool has_regular_snapshots(const Task& fem, const json& scene) {
    const std::string key = "/fem/snapshot_interval=";
    for (const std::string& each : fem.overrides) {
        if (each.starts_with(key)) return std::stod(each.substr(key.size())) > 0.0;
    }
    return scene.at("fem").value("snapshot_interval", 0.0) > 0.0;
}

/// None before the first snapshot: a condition with an unknown value is not true.
std::optional<double> value_at(std::string_view field, const json& result, double time) {
    // Not a number: the analysis found none, and no comparison with it is true.
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    if (!result.is_object()) return none;
    if (field == critical_depth_field) return result.value("critical_depth", none);
    std::optional<double> latest;
    for (const json& row : result.at("after_shaking"))
        if (row.at("time").get<double>() <= time + snapshot_slack)
            latest = row.at("factor_of_safety").get<double>();
    return latest;
}

}  // namespace

std::string how_it_ended(const Task& task) {
    return task.fault ? task.fault->summary : std::string(name_of(task.state));
}

json crossing_of(const criteria::Expression& condition, const criteria::Line& line) {
    json values{{"time", line.time}, {"step", line.step}};
    for (std::size_t i = 0; i < line.values.size(); ++i)
        values[condition.fields[i]] = line.values[i];
    return values;
}

json crossing_of(const criteria::Criterion& criterion) {
    return crossing_of(criterion.expression(), *criterion.crossing());
}

// ---------------------------------------------------------------- the FEM

WatchedFem::WatchedFem(Task of, const Store& store, const DataFolder& data)
    : task(std::move(of)),
      output(data.output(task)),
      tail(output / phases::files::telemetry),
      regular(has_regular_snapshots(task, json::parse(store.scene_of(task.run).value()))),
      planned(store.plans_transfers_of(task)) {}

/// An entangled mesh or a breakdown is an end by physics, with valid snapshots before it; all
/// other failures and a cancel are not, and a retry may go further.
bool WatchedFem::was_cut_short() const {
    constexpr auto breakdown = static_cast<std::int64_t>(fault::ExitCode::breakdown);
    if (task.state == TaskState::failed) return !task.fault || task.fault->exit_code != breakdown;
    return is_final(task.state) && !has_output(task.state);
}

void WatchedFem::read_on(const Store& store, FolderWatch& watches) {
    // Before reading: everything written before the end is then read.
    ended = is_final(task.state) || task.state == TaskState::finalizing;
    if (!ended) watch = watches.add(tail.file(), Notice::every_change);
    for (telemetry::Line& line : tail.fresh()) lines.push_back(std::move(line));
    for (const StabilityField& each : stability_fields) look_for_stability(store, each);
    snapshots = frames_in(output, task.phase);
}

/// Only when a trigger uses it: a run may be large. A failed analysis does not count: it is looked
/// up again, because it may be retried while the FEM runs.
void WatchedFem::look_for_stability(const Store& store, const StabilityField& field) {
    const auto asks = [&](const ArmedTrigger& each) { return asks_for(each.work, field); };
    Stability& known = stability[field.name];
    if (known.result || !std::ranges::any_of(armed, asks)) return;
    const std::optional<Task> lem = store.stability_of(task.run, task.variant, field.phase);
    known.why_none.clear();
    if (lem && !has_output(lem->state)) {
        if (is_final(lem->state)) known.why_none = how_it_ended(*lem);
        return;
    }
    known.result = lem && lem->result ? *lem->result : json();
}

criteria::Line WatchedFem::line_for(const criteria::Expression& condition,
                                    const telemetry::Line& line) const {
    std::map<std::string, double> beside;
    for (const auto& [field, known] : stability)
        if (known.result)
            if (const auto value = value_at(field, *known.result, line.time))
                beside.emplace(field, *value);
    return criteria::line_for(condition, line, beside);
}

const Frame* WatchedFem::first_from(double wanted) const {
    const auto first = std::ranges::find_if(
        snapshots, [&](const Frame& each) { return each.time >= wanted - snapshot_slack; });
    return first == snapshots.end() ? nullptr : &*first;
}

/// Publishes by renaming. Repeats an unanswered request: the FEM may have been killed.
void WatchedFem::ask_for_snapshot() {
    const auto request = output / phases::files::request;
    if (std::filesystem::exists(request) || Clock::now() - asked < ask_again_after) return;
    const auto draft = output / (std::string(phases::files::request) + ".new");
    std::ofstream(draft) << utc_now() << "\n";
    std::error_code error;
    std::filesystem::rename(draft, request, error);
    asked = Clock::now();
}

// ---------------------------------------------------------------- its triggers

ArmedTrigger::ArmedTrigger(const Trigger& stored)
    : trigger(stored), work(work_of({stored.name, stored.kind, stored.spec})) {
    if (stored.kind == "manual") noticed_at = epoch_ms();
}

const StabilityField* ArmedTrigger::lacks(const WatchedFem& fem) const {
    const auto found = std::ranges::find_if(stability_fields, [&](const StabilityField& each) {
        const auto known = fem.stability.find(each.name);
        const bool is_known = known != fem.stability.end() && known->second.result;
        return asks_for(work, each) && !is_known;
    });
    return found == stability_fields.end() ? nullptr : &*found;
}

/// A trigger with a stability analysis reads no line before that has ended, so that its decision
/// does not depend on which phase was faster.
void ArmedTrigger::feed(const WatchedFem& fem) {
    if (lacks(fem)) return;
    for (; lines_taken < fem.lines.size(); ++lines_taken) take(fem, fem.lines[lines_taken]);
}

void ArmedTrigger::note(const criteria::Expression& condition, const criteria::Line& crossing) {
    noticed_at = epoch_ms();
    crossed = crossing_of(condition, crossing);
    crossed_step = crossing.step;
}

void ArmedTrigger::take(const WatchedFem& fem, const telemetry::Line& line) {
    const auto take_on = [&](const criteria::Criterion& criterion, const auto& take_line) {
        using State = criteria::Criterion::State;
        const bool before = criterion.state() == State::met;
        take_line(fem.line_for(criterion.expression(), line));
        if (!before && criterion.state() == State::met)
            note(criterion.expression(), *criterion.crossing());
    };
    if (auto* when = std::get_if<When>(&work)) {
        take_on(when->criterion, [&](const criteria::Line& each) { when->criterion.take(each); });
    } else if (auto* between = std::get_if<Between>(&work)) {
        criteria::Window& window = between->window;
        const bool before = window.upper_edge().has_value();
        take_on(window.lower(), [&](const criteria::Line& each) { window.take_lower(each); });
        window.take_upper(fem.line_for(window.upper(), line));
        const auto upper = window.upper_edge();
        if (!before && upper) note(window.upper(), *upper);
    }
}

}  // namespace breach::orchestrator
