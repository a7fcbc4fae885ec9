// Joins a run's variants with their rows of results. A sample has a row, or no transfer, or
// nothing yet; each counts differently, as a slope that stood is a result and a failed sample is
// none. Built anew for each request and each look of BatchWatch; the run may be removed at any
// moment.
#include "services/orchestrator/uncertainty/ensemble.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>

#include "core/statistics/percentiles.hpp"
#include "services/findings/flags.hpp"
#include "services/orchestrator/records/or_null.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

constexpr const char* safety = "factor_of_safety";
constexpr const char* safety_liquefied = "factor_of_safety_liquefied";
// What a person asks an uncertainty study for, in the order in which pages list it. Error measures
// are left out: their percentiles mean nothing.
constexpr std::array<const char*, 6> answers{"runout_beyond_toe", "runout", "runout_largest",
                                             "area_beyond_toe",   safety,   safety_liquefied};

/// state: of a row of results.
/// A questionable result is a result: leaving it out would favour runs that went well.
SampleEnd end_of_sample(const std::string& state) {
    if (state == "succeeded" || state == "questionable") return SampleEnd::done;
    constexpr std::array ended{"failed", "skipped", "cancelled", "not_reached"};
    return std::ranges::find(ended, state) == ended.end() ? SampleEnd::open : SampleEnd::failed;
}

const ResultColumn& column_named(std::string_view name) {
    const auto columns = result_columns();
    const auto found = std::ranges::find(columns, name, &ResultColumn::name);
    assert(found != columns.end());
    return *found;
}

}  // namespace

std::optional<Ensemble> ensemble_of(const Store& store, const std::string& run) {
    const auto study = store.study_of(run);
    auto about = store.run(run);  // it may be removed at any moment
    if (!study || !study->contains("uncertainty") || !about) return std::nullopt;
    Ensemble ensemble{std::move(*about), study->at("uncertainty"), {}};
    std::map<std::string, ResultRow> rows;
    for (ResultRow& each : store.results(run))
        rows.emplace(value_of(each, "variant").get<std::string>(), std::move(each));
    std::map<std::string, WithoutTransfer> without;
    for (WithoutTransfer& each : store.without_transfer(run))
        without.emplace(each.variant, std::move(each));
    if (const auto batches = store.batches_of(run)) ensemble.ended = batches->reason;
    const auto factors = store.factors_of_safety(run);
    for (const json& variant : study->at("variants")) {
        if (!variant.contains("sample")) continue;
        SampleRow sample{.name = variant.at("name"),
                         .state = "queued",
                         .end = SampleEnd::open,
                         .reason = "",
                         .drawn = variant.at("sample").at("values"),
                         .row = std::nullopt,
                         .safety = {}};
        // The name "" is of an analysis that all variants share; a sample's own comes second and
        // wins.
        for (const std::string& each : {std::string(), sample.name})
            if (const auto own = factors.find(each); own != factors.end())
                sample.safety = own->second;
        // A sample with an MPM task has a row, even when it failed. Without one, the store says why
        // there was no transfer; a sample that neither knows may still get there.
        if (const auto found = rows.find(sample.name); found != rows.end()) {
            sample.state = value_of(found->second, "state");
            sample.end = end_of_sample(sample.state);
            sample.row = std::move(found->second);
            sample.reason = value_of(*sample.row, "reason").get<std::string>();
        } else if (const auto none = without.find(sample.name); none != without.end()) {
            sample.state = none->second.state;
            sample.end = none->second.stood ? SampleEnd::no_transfer : SampleEnd::failed;
            sample.reason = none->second.reason;
        }
        ensemble.samples.push_back(std::move(sample));
    }
    return ensemble;
}

std::optional<double> result_of(const SampleRow& sample, std::string_view quantity) {
    if (quantity == safety) return sample.safety.intact;
    if (quantity == safety_liquefied) return sample.safety.liquefied;
    if (sample.end != SampleEnd::done) return std::nullopt;
    const json& value = value_of(*sample.row, quantity);
    return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
}

bool is_lower_bound(const SampleRow& sample, std::string_view quantity) {
    return findings::grows(quantity) && sample.row && value_of(*sample.row, "lower_bound") == true;
}

std::string first_quantity(const Ensemble& ensemble) {
    return ensemble.entry.value("quantity", answers.front());
}

std::vector<const ResultColumn*> quantities_of(const Ensemble& ensemble) {
    std::vector<std::string> names{first_quantity(ensemble)};
    if (const json until = ensemble.entry.value("until", json()); until.contains("quantity"))
        names.push_back(until.at("quantity"));
    // What the study names comes first, and once.
    names.insert(names.end(), answers.begin(), answers.end());
    std::vector<const ResultColumn*> found;
    for (const std::string& name : names) {
        const ResultColumn* column = &column_named(name);
        const bool told = std::ranges::find(found, column) != found.end();
        if (!told && std::ranges::any_of(ensemble.samples, [&](const SampleRow& each) {
                return result_of(each, name).has_value();
            }))
            found.push_back(column);
    }
    return found;
}

/// Samples that have ended without the quantity will never have it and are left out.
Narrowness narrowness_of(const Ensemble& ensemble) {
    const json& until = ensemble.entry.at("until");
    Narrowness now{.quantity = until.value("quantity", first_quantity(ensemble))};
    std::vector<double> results;
    for (const SampleRow& each : ensemble.samples)
        if (const auto value = result_of(each, now.quantity)) results.push_back(*value);
    now.results = results.size();
    const double p = until.at("percentile");
    if (now.results < statistics::samples_needed(p)) return now;
    const statistics::Interval interval = statistics::percentile(results, p);
    if (interval.value == 0.0) return now;
    now.half_width = 0.5 * (interval.high - interval.low) / std::abs(interval.value);
    now.reached = *now.half_width <= until.at("half_width").get<double>();
    return now;
}

SampleTable sample_table(const Ensemble& ensemble) {
    SampleTable table;
    const auto quantities = quantities_of(ensemble);
    const json& parameters = ensemble.entry.at("parameters");
    table.names.reserve(parameters.size());  // columns point to them
    const auto add = [&](const ResultColumn& column) { table.columns.push_back(column); };
    add({"sample", "", ColumnKind::word, "", "sample", "its variant"});
    add(column_named("state"));
    for (const json& each : parameters) {
        const std::string name = each.at("name");
        const bool taken = std::ranges::any_of(
            result_columns(), [&](const ResultColumn& other) { return other.name == name; });
        // A parameter may be called like a result; a table must not have two columns of one name.
        table.names.push_back(taken || name == "sample" ? name + " (draw)" : name);
        add({table.names.back().c_str(), "",
             each.contains("one_of") ? ColumnKind::word : ColumnKind::number, "", "",
             "what the sample has drawn"});
    }
    for (const ResultColumn* each : quantities) add(*each);
    for (const char* name : {"questionable", "flags", "reason", "mpm_task"})
        add(column_named(name));
    for (const SampleRow& sample : ensemble.samples) {
        ResultRow row{sample.name, sample.state};
        for (const json& each : parameters)
            row.push_back(sample.drawn.value(each.at("name").get<std::string>(), json()));
        const auto take = [&](const char* name) {
            row.push_back(sample.row ? value_of(*sample.row, name) : json());
        };
        for (const ResultColumn* each : quantities)
            row.push_back(or_null(result_of(sample, each->name)));
        take("questionable");
        take("flags");
        row.emplace_back(sample.reason);
        take("mpm_task");
        table.rows.push_back(std::move(row));
    }
    return table;
}

}  // namespace breach::orchestrator
