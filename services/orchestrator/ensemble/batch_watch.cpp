#include "services/orchestrator/ensemble/batch_watch.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>

#include "core/fault/fault.hpp"
#include "core/statistics/percentiles.hpp"
#include "services/orchestrator/ensemble/inverse_search.hpp"
#include "services/orchestrator/records/or_null.hpp"
#include "services/orchestrator/study/sweep_extension.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

constexpr const char* name_of_trigger = "until (samples)";  // not a name that a study can use

std::string condition_of(const Until& until) {
    const auto number = [](double value) { return json(value).dump(); };
    return "half the interval of percentile " + number(until.percentile) + " of " + until.quantity +
           " <= " + number(until.half_width) + " of it";
}

/// Results of the samples that have the quantity.
std::vector<double> results_of(const Store& store, const std::string& run,
                               const std::string& quantity) {
    const auto ensemble = ensemble_of(store, run);
    std::vector<double> values;
    for (const SampleRow& each : ensemble->samples)
        if (const auto value = result_of(each, quantity)) values.push_back(*value);
    return values;
}

/// How well a percentile is known.
struct Narrowness {
    std::size_t samples;                 ///< with a result
    std::optional<double> value;         ///< of the percentile; nothing: too few samples
    std::optional<double> half_width{};  ///< of its interval, over its value
    bool reached = false;
};
/// spec: of the trigger.
Narrowness narrowness_of(const std::vector<double>& results, const json& spec) {
    Narrowness narrowness{.samples = results.size(), .value = {}};
    const double p = spec.at("percentile");
    if (results.size() < statistics::samples_needed(p)) return narrowness;
    const statistics::Interval interval = statistics::percentile(results, p);
    narrowness.value = interval.value;
    if (interval.value != 0.0)
        narrowness.half_width = 0.5 * (interval.high - interval.low) / std::abs(interval.value);
    narrowness.reached =
        narrowness.half_width && *narrowness.half_width <= spec.at("half_width").get<double>();
    return narrowness;
}

json as_json(const Narrowness& narrowness, const json& spec) {
    return {{"quantity", spec.at("quantity")},
            {"percentile", spec.at("percentile")},
            {"samples", narrowness.samples},
            {"value", or_null(narrowness.value)},
            {"half_width", or_null(narrowness.half_width)},
            {"reached", narrowness.reached}};
}

}  // namespace

std::optional<TriggerPlan> batches_of(const Study& study) {
    if (study.target) {
        const statistics::InverseQuestion& question = study.target->question;
        return TriggerPlan{name_of_trigger,
                           "criterion",
                           {{"when", question.quantity + " = " + json(question.target).dump()},
                            {"target", question.target}}};
    }
    if (!study.uncertainty || !study.uncertainty->until) return std::nullopt;
    const Until& until = *study.uncertainty->until;
    return TriggerPlan{name_of_trigger,
                       "criterion",
                       {{"when", condition_of(until)},
                        {"quantity", until.quantity},
                        {"percentile", until.percentile},
                        {"half_width", until.half_width},
                        {"batch", until.batch}}};
}

bool BatchWatch::look() {
    const std::int64_t newest = store_.last_event();
    if (newest == seen_event_) return false;
    bool added = false;
    std::map<std::string, std::string> troubles;
    for (const Trigger& each : store_.open_batches()) {
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

bool BatchWatch::has_ended(const std::string& run) const {
    const auto known = store_.run(run);
    if (!known || known->tasks_ended < known->tasks_total) return false;
    const std::vector<Trigger> triggers = store_.triggers_of(run);
    return std::ranges::all_of(triggers, [](const Trigger& each) {
        return each.name == name_of_trigger || is_final(each.state);
    });
}

bool BatchWatch::settle(const Trigger& trigger) {
    if (!has_ended(trigger.run)) return false;
    if (trigger.spec.contains("target")) return search_on(trigger);
    const json study = still(store_.study_of(trigger.run));
    const json& entry = study.at("uncertainty");
    const std::string quantity = trigger.spec.at("quantity");
    const auto results = results_of(store_, trigger.run, quantity);
    const Narrowness narrowness = narrowness_of(results, trigger.spec);
    const json result = as_json(narrowness, trigger.spec);
    if (narrowness.reached) {
        end(trigger, TriggerEvent::fire, result, "");
    } else if (results.empty()) {
        end(trigger, TriggerEvent::expire, result, "no sample has a result: no more are drawn");
    } else if (entry.at("drawn") >= entry.at("samples")) {
        end(trigger, TriggerEvent::expire, result,
            "all samples are used and the interval is still too wide; extend the run by more "
            "samples");
    } else {
        return draw_on(trigger, study);
    }
    return false;
}

bool BatchWatch::draw_on(const Trigger& trigger, const json& study) {
    const json& entry = study.at("uncertainty");
    const std::size_t asked = entry.at("samples");
    const std::size_t drawn = std::min(
        asked, entry.at("drawn").get<std::size_t>() + trigger.spec.at("batch").get<std::size_t>());
    json wanted = entry;
    wanted["drawn"] = drawn;
    return extend(trigger, study, wanted);
}

/// Adds the next value of the inverse search.
bool BatchWatch::search_on(const Trigger& trigger) {
    const auto ensemble = ensemble_of(store_, trigger.run);
    const json scene = json::parse(still(store_.scene_of(trigger.run)));
    const statistics::InverseAdvice advice = inverse_search(*ensemble, scene)->advice;
    if (advice.run_next.empty()) {
        const TriggerEvent event = advice.found ? TriggerEvent::fire : TriggerEvent::expire;
        end(trigger, event, {{"value", advice.found ? json(advice.found->value) : json()}},
            advice.refused);
        return false;
    }
    json wanted = ensemble->entry;
    for (const double each : advice.run_next) wanted["target"]["values"].push_back(each);
    return extend(trigger, still(store_.study_of(trigger.run)), wanted);
}

bool BatchWatch::extend(const Trigger& trigger, const json& study, const json& entry) {
    bool added = false;
    try {
        const RunSoFar so_far{.study = study,
                              .scene = still(store_.scene_of(trigger.run)),
                              .tasks = store_.tasks_of(trigger.run)};
        const Extension extension = plan_more_variants(so_far, data_, numerics_, entry);
        added = store_.write([&](Transaction& transaction) {
            const bool open = transaction.is_open(trigger.id);
            if (open) transaction.extend_run(trigger.run, extension);
            return open;
        });
        if (added) spdlog::info("{}: {} more variants", trigger.run, extension.samples.size());
    } catch (const fault::BadInput& error) {
        end(trigger, TriggerEvent::expire, nullptr,
            std::string("the study cannot go on: ") + error.what());
    }
    return added;
}

void BatchWatch::end(const Trigger& trigger, TriggerEvent event, const json& result,
                     const std::string& why) {
    json detail{{"result", result}};
    if (!why.empty()) detail["why"] = why;
    store_.write([&](Transaction& transaction) {
        if (!transaction.is_open(trigger.id)) return;
        transaction.keep_trigger_result(trigger.id, result);
        transaction.move_trigger(trigger, event, detail);
    });
}

}  // namespace breach::orchestrator
