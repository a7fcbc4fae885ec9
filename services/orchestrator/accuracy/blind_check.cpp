#include "services/orchestrator/accuracy/blind_check.hpp"

#include <algorithm>
#include <cmath>

#include "core/statistics/repeats.hpp"
#include "services/orchestrator/accuracy/measured.hpp"
#include "services/orchestrator/accuracy/sentences.hpp"
#include "services/orchestrator/records/or_null.hpp"

namespace breach::orchestrator {

using fault::BadInput;
using nlohmann::json;

namespace {

[[noreturn]] void refuse(const std::string& pointer, const std::string& cause,
                         const std::string& remedy) {
    throw BadInput("check", {{pointer, cause, remedy}});
}

const AccuracyRow& recommended_row(const AccuracyTable& table) {
    if (!table.recommended)
        refuse("", "the study recommends no setting: " + table.recommendation,
               "wait for its end, name a rung with \"ladder\" and \"step\", or ask for less: "
               "\"asked_error\"");
    return table.rows[*table.recommended];
}

const AccuracyRow& wanted_row(const AccuracyTable& table, const CheckRequest& request) {
    if (!request.ladder && !request.step) return recommended_row(table);
    if (!request.ladder || !request.step)
        refuse(request.ladder ? "/step" : "/ladder", "a rung is named by its ladder and its step",
               "give both, or neither: then the recommended setting is checked");
    for (const AccuracyRow& row : table.rows)
        if (table.plan.ladders[row.setting.ladder].name == *request.ladder &&
            row.setting.step + 1 == *request.step)
            return row;
    refuse("/ladder",
           "the study has no rung " + std::to_string(*request.step) + " on a ladder \"" +
               *request.ladder + "\"",
           "GET .../accuracy lists ladders and steps");
}

/// The requested number, else as many repeats as keep the requested error, else one.
std::size_t draws_of_a_mean(const AccuracyRow& row, const CheckRequest& request) {
    if (request.mean_of) return *request.mean_of;
    return row.mean_within_asked ? row.mean_within_asked->draws : 1;
}

BlindMean judged(const BlindCheckPlan& plan, std::vector<std::string> variants,
                 const std::map<std::string, Measured>& measured) {
    BlindMean mean{.variants = std::move(variants)};
    std::vector<double> values;
    for (const std::string& each : mean.variants) {
        const auto found = measured.find(each);
        if (found == measured.end() || !found->second.value) {
            mean.reason =
                each + ": " +
                (found == measured.end() ? "its task is not there" : found->second.reason);
            continue;
        }
        values.push_back(*found->second.value);
        mean.questionable |= found->second.questionable;
    }
    if (values.size() < mean.variants.size()) return mean;
    mean.value = statistics::repeats_of(values).mean;
    mean.error = std::abs(*mean.value - plan.reference) / std::abs(plan.reference);
    mean.kept = *mean.error <= plan.asked_error;
    return mean;
}

json as_json(const BlindMean& mean) {
    return {{"variants", mean.variants},         {"value", or_null(mean.value)},
            {"error", or_null(mean.error)},      {"kept", mean.kept},
            {"questionable", mean.questionable}, {"reason", mean.reason}};
}

}  // namespace

json study_of_check(const Store& store, const std::string& run, const AccuracyTable& table,
                    const CheckRequest& request) {
    const AccuracyPlan& plan = table.plan;
    const AccuracyRow& row = wanted_row(table, request);
    const std::optional<double>& reference = table.ladders[row.setting.ladder].reference;
    if (!reference)
        refuse("/ladder", "there is no reference yet: " + table.ladders[row.setting.ladder].message,
               "wait for the study's end, or check a rung of another ladder");
    const std::size_t mean_of = draws_of_a_mean(row, request);

    const json of = still(store.study_of(run));
    json study{{"format", of.at("format")},
               {"name", of.at("name")},
               {"title", "Blind check of " + run + ": " + plan.ladders[row.setting.ladder].name +
                             " " + std::to_string(row.setting.step + 1)},
               {"scene", json::parse(still(store.scene_of(run)))},
               {"overrides", overrides_of(plan, row.setting.ladder, row.setting.step)},
               {"draws", request.repeats * mean_of},
               {"first_draw", plan.draws},
               {"draws_of", name_of(plan.draws_of)},
               {"stability", false},
               {"resources", of.at("resources")},
               {"priority", of.at("priority")},
               {"reuse", of.at("reuse")}};
    if (of.contains("transfer_times")) study["transfer_times"] = of.at("transfer_times");
    study["check"] = {{"of", run},
                      {"quantity", text_of(plan.quantity)},
                      {"mean_of", mean_of},
                      {"reference", *reference},
                      {"asked_error", plan.asked_error}};
    return study;
}

std::optional<BlindCheck> blind_check(const Store& store, const DataFolder& data,
                                      const std::string& run) {
    const auto study = store.study_of(run);
    if (!study || !study->contains("check")) return std::nullopt;
    const json scene = json::parse(still(store.scene_of(run)));
    std::vector<fault::Fault> none;  // the study was checked when it was accepted
    BlindCheck check;
    check.plan = read_blind_check(study->at("check"), scene, draws_of(*study), none);
    const auto measured = measured_variants(store.tasks_of(run), check.plan.quantity, data);
    std::vector<std::string> variants;
    for (const json& each : study->at("variants")) {
        variants.push_back(each.at("name"));
        if (variants.size() < check.plan.mean_of) continue;
        check.means.push_back(judged(check.plan, std::move(variants), measured));
        variants.clear();
    }
    for (const BlindMean& each : check.means) {
        if (!each.value) continue;
        ++check.judged;
        if (each.kept) ++check.kept;
        check.furthest = std::max(check.furthest.value_or(0.0), *each.error);
    }
    return check;
}

json as_json(const BlindCheck& check) {
    const BlindCheckPlan& plan = check.plan;
    json means = json::array();
    for (const BlindMean& each : check.means) means.push_back(as_json(each));
    return {{"of", plan.of},
            {"quantity", text_of(plan.quantity)},
            {"unit", plan.quantity.unit},
            {"mean_of", plan.mean_of},
            {"reference", plan.reference},
            {"asked_error", plan.asked_error},
            {"means", std::move(means)},
            {"judged", check.judged},
            {"kept", check.kept},
            {"furthest", or_null(check.furthest)},
            {"verdict", verdict_in_words(check)}};
}

}  // namespace breach::orchestrator
