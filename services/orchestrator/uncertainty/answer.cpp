// Everything that the pages, the CLI and the report say about samples comes from this document. It
// is computed for each request from the store: a running study's answer changes with every sample.
#include "services/orchestrator/uncertainty/answer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/statistics/percentiles.hpp"
#include "core/statistics/repeats.hpp"
#include "core/statistics/surrogate.hpp"
#include "services/findings/flags.hpp"
#include "services/findings/uncertainty.hpp"
#include "services/orchestrator/records/or_null.hpp"
#include "services/orchestrator/uncertainty/inverse_search.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

// The percentiles that need 59, 29 and 5 samples; one that has too few is listed as lacking.
constexpr std::array shown_percentiles{5.0, 10.0, 50.0, 90.0, 95.0};

/// By the keys of the study's entry. numerical: the lattice of the points, no property of the soil.
std::string kind_of(const json& parameter) {
    if (parameter.contains("one_of")) return "choice";
    if (parameter.contains("factor_on")) return "factor";
    return parameter.contains("sets") ? "value" : "numerical";
}

/// A correlation stands once in the study and is listed at both of its parameters here.
json parameters_of(const json& entry) {
    json list = json::array();
    for (const json& each : entry.at("parameters")) {
        json asked = json::object();
        for (const json& pair : entry.value("correlation", json::array())) {
            if (pair[0] == each.at("name")) asked[pair[1].get<std::string>()] = pair[2];
            if (pair[1] == each.at("name")) asked[pair[0].get<std::string>()] = pair[2];
        }
        const std::string kind = kind_of(each);
        list.push_back(
            {{"name", each.at("name")},
             {"kind", kind},
             {"distribution", each.value("distribution", json())},
             {"between", each.value("between", json())},
             {"entries", each.value(kind == "factor" ? "factor_on" : "sets", json::array())},
             {"asked_correlation", asked}});
    }
    return list;
}

/// The samples that have one quantity.
struct Measured {
    std::vector<double> results;
    std::vector<const SampleRow*> samples;
    std::optional<double> least_bound;  ///< least result of a sample with moving soil
};

/// The count differs by quantity: factors of safety exist for samples whose runout failed.
Measured measured(const Ensemble& ensemble, std::string_view quantity) {
    Measured found;
    for (const SampleRow& each : ensemble.samples) {
        const auto value = result_of(each, quantity);
        if (!value) continue;
        found.results.push_back(*value);
        found.samples.push_back(&each);
        if (is_lower_bound(each, quantity))
            found.least_bound = std::min(*value, found.least_bound.value_or(*value));
    }
    return found;
}

/// Numbers options in the order of their names.
statistics::Drawn drawn_of(const json& parameter, const std::vector<const SampleRow*>& samples) {
    statistics::Drawn drawn{
        .name = parameter.at("name"),
        // A lattice's number has no order either.
        .is_choice = kind_of(parameter) == "choice" || kind_of(parameter) == "numerical",
        .values = {}};
    std::set<json> options;
    for (const SampleRow* each : samples) options.insert(each->drawn.at(drawn.name));
    for (const SampleRow* each : samples) {
        const json& value = each->drawn.at(drawn.name);
        drawn.values.push_back(drawn.is_choice ? static_cast<double>(std::distance(
                                                     options.begin(), options.find(value)))
                                               : value.get<double>());
    }
    return drawn;
}

void add(json& into, const std::optional<statistics::Interval>& found, const char* name,
         const char* low, const char* high) {
    into[name] = found ? json(found->value) : json();
    into[low] = found ? json(found->low) : json();
    into[high] = found ? json(found->high) : json();
}

/// measure names the number that fits the parameter's kind: a choice has no order, so no rank.
json as_json(const statistics::Importance& found, const json& parameter) {
    const std::string kind = kind_of(parameter);
    const bool ranked = kind == "factor" || kind == "value";
    json made{{"parameter", parameter.at("name")},
              {"measure", ranked ? "rank_correlation" : "correlation_ratio"}};
    add(made, found.rank_correlation, "rank_correlation", "low", "high");
    add(made, found.partial_rank_correlation, "partial_rank_correlation", "partial_low",
        "partial_high");
    add(made, found.first_order, "first_order", "first_order_low", "first_order_high");
    return made;
}

/// Refused where the fitted polynomial predicts left-out samples badly (q2): its bars would be
/// noise.
json as_json(const statistics::Tornado& tornado) {
    if (!tornado.refused.empty()) return {{"refused", tornado.refused}, {"q2", tornado.q2}};
    json bars = json::array();
    for (const statistics::TornadoBar& each : tornado.bars)
        bars.push_back({{"parameter", each.name}, {"p10", each.p10}, {"p90", each.p90}});
    return {{"q2", tornado.q2},
            {"form", tornado.form},
            {"at_median", tornado.at_median},
            {"bars", std::move(bars)}};
}

/// The list, or {"refused"} where there are too few samples for any.
json percentiles_of(const std::vector<double>& results) {
    json list = json::array();
    for (const double p : shown_percentiles) {
        if (results.size() < statistics::samples_needed(p)) continue;
        const statistics::Interval found = statistics::percentile(results, p);
        list.push_back(
            {{"p", p}, {"value", found.value}, {"low", found.low}, {"high", found.high}});
    }
    if (list.empty()) return {{"refused", statistics::not_enough(results.size(), 50.0)}};
    return list;
}

json exceedance_of(const std::vector<double>& results) {
    json list = json::array();
    for (const statistics::Exceedance& each : statistics::exceedance(results))
        list.push_back({{"value", each.value},
                        {"probability", each.probability.value},
                        {"low", each.probability.low},
                        {"high", each.probability.high}});
    return list;
}

/// The lattice is scatter of the method: it gets a share of the variance, but it is not a parameter
/// that others are corrected for or that a surrogate could use.
void add_importance(json& into, const json& parameters, const Measured& measured) {
    std::vector<statistics::Drawn> physical;
    json importance = json::array();
    for (const json& each : parameters)
        if (kind_of(each) != "numerical") physical.push_back(drawn_of(each, measured.samples));
    const auto found = statistics::importance_of(physical, measured.results);
    std::size_t next = 0;
    for (const json& each : parameters) {
        if (kind_of(each) != "numerical") {
            importance.push_back(as_json(found[next++], each));
            continue;
        }
        const std::array lattice{drawn_of(each, measured.samples)};
        importance.push_back(
            as_json(statistics::importance_of(lattice, measured.results).front(), each));
    }
    into["importance"] = std::move(importance);
    into["tornado"] = as_json(statistics::tornado_of(physical, measured.results));
}

json statistics_of(const Ensemble& ensemble, const ResultColumn& quantity) {
    const Measured found = measured(ensemble, quantity.name);
    const statistics::Repeats repeats = statistics::repeats_of(found.results);
    json made{{"label", quantity.meaning},
              {"unit", quantity.unit},
              {"grows", findings::grows(quantity.name)},
              {"count", found.results.size()},
              {"of", ensemble.samples.size()},
              {"mean", repeats.mean},
              {"sd", or_null(repeats.deviation)},
              {"bound_from", or_null(found.least_bound)},
              {"percentiles", percentiles_of(found.results)},
              {"exceedance", exceedance_of(found.results)}};
    json lacking = json::array();
    for (const double p : shown_percentiles)
        if (found.results.size() < statistics::samples_needed(p))
            lacking.push_back({{"p", p}, {"needs", statistics::samples_needed(p)}});
    made["percentiles_lacking"] = std::move(lacking);
    // A factor below 1 is a failure; no such limit is known for a distance.
    if (std::string_view(quantity.name).starts_with("factor_of_safety")) {
        const statistics::Interval failed = statistics::share_below(found.results, 1.0);
        made["probability_of_failure"] = {
            {"value", failed.value}, {"low", failed.low}, {"high", failed.high}};
    }
    add_importance(made, ensemble.entry.at("parameters"), found);
    return made;
}

/// Samples without a result are counted and named: leaving them out silently would bias every
/// number. doubtful: questionable for another reason than that soil still moved.
json counts_of(const Ensemble& ensemble) {
    const auto count = [&](SampleEnd end) {
        return std::ranges::count(ensemble.samples, end, &SampleRow::end);
    };
    json left_out = json::array();
    std::int64_t questionable = 0, moving = 0;
    for (const SampleRow& each : ensemble.samples) {
        if (each.state == "questionable") ++questionable;
        if (is_lower_bound(each, "runout")) ++moving;
        if (each.end == SampleEnd::failed || each.end == SampleEnd::no_transfer)
            left_out.push_back(
                {{"sample", each.name}, {"state", each.state}, {"reason", each.reason}});
    }
    return {{"planned", ensemble.samples.size()},
            {"done", count(SampleEnd::done)},
            {"failed", count(SampleEnd::failed)},
            {"open", count(SampleEnd::open)},
            {"no_transfer", count(SampleEnd::no_transfer)},
            {"questionable", questionable},
            {"moving", moving},
            {"doubtful", questionable - moving},
            {"left_out", std::move(left_out)}};
}

json rows_of(const Ensemble& ensemble) {
    json rows = json::array();
    // A row for every planned sample: one without a result still shows which parameters it had.
    const auto quantities = quantities_of(ensemble);
    for (const SampleRow& each : ensemble.samples) {
        json results = json::object();
        for (const ResultColumn* quantity : quantities)
            results[quantity->name] = or_null(result_of(each, quantity->name));
        rows.push_back({{"sample", each.name},
                        {"task", each.row ? value_of(*each.row, "mpm_task") : json()},
                        {"state", each.state},
                        {"values", each.drawn},
                        {"results", std::move(results)}});
    }
    return rows;
}

/// The entry "until", with the present accuracy of its percentile.
json until_of(const Ensemble& ensemble) {
    json made = ensemble.entry.value("until", json());
    if (!made.is_object()) return nullptr;
    const Narrowness now = narrowness_of(ensemble);
    made["quantity"] = now.quantity;
    made["reached"] = now.reached;
    made["now"] = or_null(now.half_width);
    made["ended"] = ensemble.ended;
    return made;
}

}  // namespace

json uncertainty_of(const Ensemble& ensemble, const json& scene, const std::string& quantity) {
    const auto search = inverse_search(ensemble, scene);
    json quantities = json::object();
    for (const ResultColumn* each : quantities_of(ensemble))
        if (!search && (quantity.empty() || quantity == each->name))
            quantities[each->name] = statistics_of(ensemble, *each);
    json answer{
        {"run", ensemble.run.id},
        {"name", ensemble.run.name},
        {"state", ensemble.run.state},
        {"quantity", quantity.empty() ? first_quantity(ensemble) : quantity},
        {"sampling", ensemble.entry.value("sampling", json())},
        {"seed", ensemble.entry.value("seed", json())},
        {"confidence", statistics::confidence},
        {"samples", counts_of(ensemble)},
        {"parameters", parameters_of(ensemble.entry)},
        {"rows", rows_of(ensemble)},
        {"quantities", std::move(quantities)},
        {"until", until_of(ensemble)},
        {"inverse", search ? as_json(*search, ensemble.entry.at("target").at("vary")) : json()}};
    // Last, because the words are made from the numbers of this very document.
    answer["sentences"] = findings::sentences_of(answer);
    answer["cautions"] = findings::cautions_of(answer);
    if (const json::json_pointer own("/lem/probability");
        scene.contains(own) && answer["quantities"].contains("factor_of_safety"))
        answer["sentences"].push_back(
            "/lem/probability of the scene samples strengths within each sample's "
            "stability "
            "analysis; the probability of failure here counts the samples only.");
    return answer;
}

}  // namespace breach::orchestrator
