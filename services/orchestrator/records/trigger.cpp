// The table of moves is the only rule: the store asks next() and refuses what is not there. Specs
// are checked here at submission, so that a watcher can rely on them.
#include "services/orchestrator/records/trigger.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/criteria/ranges.hpp"
#include "core/telemetry/columns.hpp"
#include "core/words/number.hpp"
#include "core/words/words.hpp"

namespace breach::orchestrator {

using fault::Fault;
using nlohmann::json;

static constexpr auto words_of(TriggerState) {
    using enum TriggerState;
    return words::in_order<TriggerState>({{armed, "armed"},
                                          {holding, "holding"},
                                          {fired, "fired"},
                                          {expired, "expired"},
                                          {disarmed, "disarmed"}});
}

static constexpr auto words_of(TriggerEvent) {
    using enum TriggerEvent;
    return words::in_order<TriggerEvent>({{cross, "cross"},
                                          {uncross, "uncross"},
                                          {fire, "fire"},
                                          {expire, "expire"},
                                          {disarm, "disarm"},
                                          {rearm, "rearm"}});
}

namespace {

struct TriggerRule {
    TriggerState from;
    TriggerEvent event;
    TriggerState to;
};

constexpr auto trigger_table = [] {
    using enum TriggerState;
    using enum TriggerEvent;
    return std::array{
        TriggerRule{armed, cross, holding},    TriggerRule{armed, fire, fired},
        TriggerRule{armed, expire, expired},   TriggerRule{armed, disarm, disarmed},
        TriggerRule{holding, uncross, armed},  TriggerRule{holding, fire, fired},
        TriggerRule{holding, expire, expired}, TriggerRule{holding, disarm, disarmed},
        TriggerRule{expired, rearm, armed},    TriggerRule{disarmed, rearm, armed},
    };
}();

constexpr double default_within_share = 0.05;    // of the dynamic stages
constexpr double default_window_shares = 100.0;  // snapshots over the dynamic stages

/// Entries that a kind must and may have, besides "kind" and "name".
struct KindRule {
    std::string_view kind;
    std::vector<std::string> needs;
    std::vector<std::string> takes;
};

const std::vector<KindRule>& kind_rules() {
    static const std::vector<KindRule> rules{
        {"at_time", {"times"}, {}},
        {"manual", {}, {"within_s"}},
        {"criterion", {"when"}, {"hold_s", "within_s", "snapshot_interval_s"}},
        {"window", {"lower", "upper"}, {"hold_s", "pick", "snapshot_interval_s", "within_s"}},
        {"bisect", {}, {"share", "tolerance_s", "from", "to", "seeds", "most_runs"}}};
    return rules;
}

void check_entries(const json& entry, const KindRule& rule, const std::string& pointer,
                   std::vector<Fault>& faults) {
    for (const std::string& each : rule.needs) {
        if (!entry.contains(each))
            faults.push_back({pointer + "/" + each,
                              "a trigger of kind \"" + std::string(rule.kind) + "\" needs this",
                              "add \"" + each + "\""});
    }
    for (const auto& [key, value] : entry.items()) {
        const auto in = [&](const std::vector<std::string>& list) {
            return std::ranges::find(list, key) != list.end();
        };
        if (key == "kind" || key == "name" || in(rule.needs) || in(rule.takes)) continue;
        faults.push_back({pointer + "/" + key,
                          "has no meaning in a trigger of kind \"" + std::string(rule.kind) + "\"",
                          "remove it"});
    }
}

criteria::Range range_of(const std::string& field) {
    const telemetry::Column* column = telemetry::column_named(field);
    return column ? criteria::Range{column->least, column->most} : criteria::Range{};
}

std::string ranges_of(const criteria::Expression& condition) {
    std::string text;
    for (const std::string& field : condition.fields) {
        const auto [least, most] = range_of(field);
        if (std::isinf(least) && std::isinf(most)) continue;
        text += (text.empty() ? "" : ", ") + field;
        if (std::isinf(most))
            text += " is at least " + words::text_of(least);
        else
            text += " goes from " + words::text_of(least) + " to " + words::text_of(most);
    }
    return text;
}

void check_condition(const json& spec, const char* key, const std::string& pointer,
                     std::vector<Fault>& faults) {
    if (!spec.contains(key)) return;
    try {
        const auto asked = criteria::parse(spec[key].get<std::string>(), criteria::Kind::condition,
                                           pointer + "/" + key, telemetry_fields());
        const bool can_be = criteria::can_be_true(asked, range_of);
        if (!can_be && std::string_view(key) != "upper")
            faults.push_back({pointer + "/" + key, "can never be true: " + asked.text,
                              "check sign and unit: " + ranges_of(asked)});
    } catch (const fault::BadInput& error) {
        faults.insert(faults.end(), error.faults().begin(), error.faults().end());
    }
}

/// Fills in the defaults, so that the stored trigger is complete.
json completed(json spec, double span) {
    const std::string kind = spec["kind"];
    const auto otherwise = [&](const char* key, const json& value) {
        if (!spec.contains(key)) spec[key] = value;
    };
    if (kind != "bisect") otherwise("within_s", default_within_share * span);
    if (kind == "criterion" || kind == "window") otherwise("hold_s", 0.0);
    if (kind == "window") {
        otherwise("pick", "midpoint");
        otherwise("snapshot_interval_s", span / default_window_shares);
    }
    if (kind == "bisect") {
        otherwise("share", 0.75);
        otherwise("tolerance_s", span / default_window_shares);
        otherwise("from", 0.0);
        otherwise("to", span);
        otherwise("seeds", 4);
        otherwise("most_runs", 100);
    }
    return spec;
}

criteria::Expression condition(const json& spec, const char* key) {
    return criteria::parse(spec.at(key).get<std::string>(), criteria::Kind::condition, "");
}

}  // namespace

std::optional<TriggerState> next(TriggerState from, TriggerEvent event) {
    const auto found = std::ranges::find_if(trigger_table, [&](const TriggerRule& rule) {
        return rule.from == from && rule.event == event;
    });
    if (found == trigger_table.end()) return std::nullopt;
    return found->to;
}

bool is_final(TriggerState state) {
    return state != TriggerState::armed && state != TriggerState::holding;
}
std::string_view name_of(TriggerState state) { return words::name_of(state); }
std::string_view name_of(TriggerEvent event) { return words::name_of(event); }

TriggerState trigger_state_named(std::string_view name) { return words::named<TriggerState>(name); }

const std::vector<std::string>& telemetry_fields() {
    static const std::vector<std::string> fields = [] {
        std::vector<std::string> names;
        for (const auto& table : {telemetry::fem_columns(), telemetry::run_columns()})
            for (const telemetry::Column& column : table) names.emplace_back(column.name);
        return names;
    }();
    return fields;
}

Work work_of(const TriggerPlan& plan) {
    const json& spec = plan.spec;
    if (plan.kind == "manual") return Manual{spec.value("after", 0.0)};
    if (plan.kind == "criterion")
        return When{criteria::Criterion(condition(spec, "when"), spec.at("hold_s"))};
    if (plan.kind == "window") {
        return Between{
            criteria::Window(condition(spec, "lower"), condition(spec, "upper"), spec.at("hold_s")),
            *criteria::pick_named(spec.at("pick").get<std::string>())};
    }
    return Bisect{.share = spec.at("share"),
                  .tolerance = spec.at("tolerance_s"),
                  .from = spec.at("from"),
                  .to = spec.at("to"),
                  .seeds = spec.at("seeds"),
                  .most_runs = spec.at("most_runs")};
}

CheckedTriggers check_triggers(const json& entries, double span, const std::string& pointer,
                               std::vector<Fault>& faults) {
    CheckedTriggers checked;
    std::set<std::string> names;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const std::string at = pointer + "/" + std::to_string(i);
        const json& entry = entries[i];
        const std::string kind = entry.at("kind");
        const std::size_t before = faults.size();
        check_entries(entry, *std::ranges::find(kind_rules(), kind, &KindRule::kind), at, faults);
        for (const char* key : {"when", "lower", "upper"}) check_condition(entry, key, at, faults);
        std::string name = entry.value("name", kind + "_" + std::to_string(i + 1));
        if (!names.insert(name).second)
            faults.push_back({at + "/name", "the name \"" + name + "\" is given twice",
                              "give each trigger a name of its own"});
        if (faults.size() > before) continue;
        if (kind == "at_time") {
            checked.at_time.push_back(entry["times"]);
            continue;
        }
        json spec = completed(entry, span);
        if (kind == "bisect" && spec["to"] <= spec["from"])
            faults.push_back({at + "/to", "the range ends before it begins", "give to > from"});
        const double wanted =
            spec.value(kind == "bisect" ? "tolerance_s" : "snapshot_interval_s", 0.0);
        if (wanted > 0.0)
            checked.snapshot_interval = checked.snapshot_interval > 0.0
                                            ? std::min(checked.snapshot_interval, wanted)
                                            : wanted;
        checked.live.push_back({std::move(name), kind, std::move(spec)});
    }
    return checked;
}

}  // namespace breach::orchestrator
