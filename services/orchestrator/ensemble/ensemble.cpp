#include "services/orchestrator/ensemble/ensemble.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <map>

#include "core/phases/phases.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

constexpr std::array<const char*, 5> answers{"runout_beyond_toe", "runout", "runout_largest",
                                             "area_beyond_toe", "factor_of_safety"};

/// Of a row's state, which is that of a task, "questionable" or "not_reached".
Fate fate_of(const std::string& state) {
    if (state == "succeeded" || state == "questionable") return Fate::done;
    constexpr std::array ended{"failed", "skipped", "cancelled", "not_reached"};
    return std::ranges::find(ended, state) == ended.end() ? Fate::open : Fate::failed;
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
    if (!study || !study->contains("uncertainty")) return std::nullopt;
    Ensemble ensemble{*store.run(run), study->at("uncertainty"), {}};
    std::map<std::string, ResultRow> rows;
    for (ResultRow& each : store.results(run))
        rows.emplace(value_of(each, "variant").get<std::string>(), std::move(each));
    for (const json& variant : study->at("variants")) {
        if (!variant.contains("sample")) continue;
        SampleRow sample{.name = variant.at("name"),
                         .state = "queued",
                         .fate = Fate::open,
                         .drawn = variant.at("sample").at("values"),
                         .row = std::nullopt};
        if (const auto found = rows.find(sample.name); found != rows.end()) {
            sample.state = value_of(found->second, "state");
            sample.fate = fate_of(sample.state);
            sample.row = std::move(found->second);
        }
        ensemble.samples.push_back(std::move(sample));
    }
    return ensemble;
}

std::optional<double> result_of(const SampleRow& sample, std::string_view quantity) {
    if (sample.fate != Fate::done) return std::nullopt;
    const json& value = value_of(*sample.row, quantity);
    return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
}

bool is_lower_bound(const SampleRow& sample, std::string_view quantity) {
    return phases::grows(quantity) && sample.row && value_of(*sample.row, "at_rest") == false;
}

std::string first_quantity(const Ensemble& ensemble) {
    return ensemble.entry.value("quantity", answers.front());
}

std::vector<const ResultColumn*> quantities_of(const Ensemble& ensemble) {
    std::vector<std::string> names{first_quantity(ensemble)};
    if (const json until = ensemble.entry.value("until", json()); until.contains("quantity"))
        names.push_back(until.at("quantity"));
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
        for (const ResultColumn* each : quantities) take(each->name);
        for (const char* name : {"questionable", "flags", "reason", "mpm_task"}) take(name);
        table.rows.push_back(std::move(row));
    }
    return table;
}

}  // namespace breach::orchestrator
