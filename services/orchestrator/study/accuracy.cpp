// Reads ladders and turns each rung into variants. settings_of() is called when the study is read
// and again for each answer (accuracy/accuracy_table.cpp): it must give the same names both times,
// so it depends on the plan and the scene alone.
#include "services/orchestrator/study/accuracy.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>

#include "core/telemetry/columns.hpp"
#include "services/orchestrator/records/result_columns.hpp"

namespace breach::orchestrator {

using fault::Fault;
using nlohmann::json;

namespace {

// Each is a checked scene and several tasks; a slip in "draws" must not make millions.
constexpr std::size_t most_variants = 1000;
// Richardson's extrapolation has three unknowns.
constexpr std::size_t rungs_of_an_order = 3;

// ---------------------------------------------------------------- the quantity

/// Columns without a pointer are computed by the service and are in no result.json.
bool can_be_judged(const ResultColumn& column) {
    return column.kind == ColumnKind::number && *column.pointer != '\0';
}

/// "crest_displacement@4.5": of the FEM alone, so that no transfer is computed for it.
std::optional<Quantity> of_telemetry(const std::string& text, std::size_t at) {
    const std::string name = text.substr(0, at);
    const telemetry::Column* column = telemetry::column_named(name);
    char* end = nullptr;
    const std::string number = text.substr(at + 1);
    const double time = std::strtod(number.c_str(), &end);
    if (column == nullptr || number.empty() || *end != '\0' || !std::isfinite(time) || time < 0.0)
        return std::nullopt;
    return Quantity{name, Reach::fem, "", column->unit, time};
}

Quantity read_quantity(const json& entry, const std::string& at, const json& scene,
                       std::vector<Fault>& faults) {
    const std::string text = entry.at("quantity");
    if (auto known = quantity_named(text, scene)) return std::move(*known);
    faults.push_back({at + "/quantity", "\"" + text + "\" is nothing that a result has",
                      "give one of " + names_of_results() +
                          "; factor_of_safety; or a field of the FEM's telemetry with its time, "
                          "like crest_displacement@4.5"});
    return {text, Reach::chain, "", "", std::nullopt};
}

// ---------------------------------------------------------------- ladders

/// "=9" uses the pointer at the same place in the first rung.
/// Rungs usually change one entry, and its pointer is long.
std::vector<std::string> whole(const std::vector<std::string>& step,
                               const std::vector<std::string>& first, const std::string& at,
                               std::vector<Fault>& faults) {
    std::vector<std::string> overrides = step;
    for (std::size_t i = 0; i < overrides.size(); ++i) {
        if (!overrides[i].starts_with('=')) continue;
        const std::size_t equals = i < first.size() ? first[i].find('=') : std::string::npos;
        if (equals == std::string::npos || equals == 0) {
            faults.push_back({at + "/" + std::to_string(i),
                              "the first rung has no pointer at this place",
                              "write \"/json/pointer=value\""});
            continue;
        }
        overrides[i].insert(0, first[i].substr(0, equals));
    }
    return overrides;
}

std::vector<std::vector<std::string>> read_steps(const json& ladder, const std::string& at,
                                                 std::size_t least, std::vector<Fault>& faults) {
    const auto given = ladder.at("steps").get<std::vector<std::vector<std::string>>>();
    std::vector<std::vector<std::string>> steps;
    for (std::size_t k = 0; k < given.size(); ++k)
        steps.push_back(whole(given[k], given[0], at + "/steps/" + std::to_string(k), faults));
    if (steps.size() < least)
        faults.push_back(
            {at + "/steps",
             "the ladder has " + std::to_string(steps.size()) + " rung" +
                 (steps.size() == 1 ? "" : "s") +
                 (least > 2 ? ", and a limit needs three" : ": there is nothing to compare"),
             least > 2 ? "give three rungs or more, or another reference"
                       : "give two rungs or more; with three an order can be observed"});
    return steps;
}

/// The value of the rung's first override, if it is a positive number.
/// Only the first override: further ones of a rung follow it, such as a time step a cell size.
std::optional<double> first_value(const std::vector<std::string>& step) {
    const std::string text = step.front().substr(step.front().find('=') + 1);
    const json value = json::parse(text, nullptr, false);
    if (!value.is_number() || value.get<double>() <= 0.0) return std::nullopt;
    return value.get<double>();
}

/// Falling values are sizes; rising ones are numbers of divisions.
/// Empty where the values go up and down or are no numbers: then the author must give "sizes".
std::vector<double> sizes_of(const std::vector<std::vector<std::string>>& steps) {
    std::vector<double> values;
    for (const auto& each : steps) {
        const auto value = first_value(each);
        if (!value) return {};
        values.push_back(*value);
    }
    if (std::ranges::adjacent_find(values, std::less_equal<>()) == values.end()) return values;
    if (std::ranges::adjacent_find(values, std::greater_equal<>()) != values.end()) return {};
    for (double& each : values) each = 1.0 / each;
    return values;
}

std::vector<double> read_sizes(const json& ladder, const std::string& at,
                               const std::vector<std::vector<std::string>>& steps,
                               std::vector<Fault>& faults) {
    if (!ladder.contains("sizes")) return sizes_of(steps);
    const auto sizes = ladder.at("sizes").get<std::vector<double>>();
    if (sizes.size() != steps.size())
        faults.push_back({at + "/sizes",
                          "there are " + std::to_string(sizes.size()) + " sizes of " +
                              std::to_string(steps.size()) + " rungs",
                          "give one size for each rung, or leave \"sizes\" out"});
    if (std::ranges::adjacent_find(sizes, std::less_equal<>()) != sizes.end())
        faults.push_back({at + "/sizes", "the sizes do not fall",
                          "order the rungs from coarse to fine, the last one finest"});
    return sizes;
}

std::vector<Ladder> read_ladders(const json& entries, ReferenceKind reference,
                                 std::vector<Fault>& faults) {
    // A limit needs sizes and three rungs, on every ladder.
    const bool limit = reference == ReferenceKind::richardson;
    std::vector<Ladder> ladders;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const std::string at = "/accuracy/ladders/" + std::to_string(i);
        Ladder ladder{.name = entries[i].at("name"),
                      .steps = read_steps(entries[i], at, limit ? rungs_of_an_order : 2, faults),
                      .sizes = {}};
        ladder.sizes = read_sizes(entries[i], at, ladder.steps, faults);
        if (std::ranges::find(ladders, ladder.name, &Ladder::name) != ladders.end())
            faults.push_back({at + "/name", "the name \"" + ladder.name + "\" is given twice",
                              "give each ladder a name of its own"});
        if (limit && ladder.sizes.empty())
            faults.push_back({at + "/sizes", "a limit needs to know how coarse each rung is",
                              "give \"sizes\", one falling number for each rung"});
        ladders.push_back(std::move(ladder));
    }
    return ladders;
}

Reference read_reference(const json& entry, std::vector<Fault>& faults) {
    const json& reference = entry.at("reference");
    if (reference == "finest") return {};
    if (reference == "richardson") return {ReferenceKind::richardson, 0.0, ""};
    // A result such as runout_beyond_toe may be 0 for a dam that stands.
    if (reference.at("value") == 0.0)
        faults.push_back({"/accuracy/reference/value",
                          "errors are relative to the reference, and it is zero",
                          "judge a quantity that is not zero, such as runout_largest"});
    return {ReferenceKind::given, reference.at("value"), reference.at("source")};
}

/// From 1, as people count; steps are counted from 0 elsewhere.
std::string name_of_rung(const Ladder& ladder, std::size_t step) {
    return ladder.name + "_" + std::to_string(step + 1);
}

}  // namespace

std::string names_of_results() {
    std::string names;
    for (const ResultColumn& each : result_columns())
        if (can_be_judged(each)) names.append(names.empty() ? "" : ", ").append(each.name);
    return names;
}

std::optional<Quantity> quantity_named(const std::string& text, const json& scene) {
    if (const std::size_t at = text.find('@'); at != std::string::npos)
        return of_telemetry(text, at);
    if (text == "factor_of_safety")
        return Quantity{text, Reach::lem, "/factor_of_safety", "1", std::nullopt};
    for (const ResultColumn& each : result_columns())
        if (each.name == text && can_be_judged(each))
            return Quantity{text, scene.contains("fem") ? Reach::chain : Reach::filled_mpm,
                            each.pointer, each.unit, std::nullopt};
    return std::nullopt;
}

std::string text_of(const Quantity& quantity) {
    return quantity.time ? quantity.name + "@" + json(*quantity.time).dump() : quantity.name;
}

AccuracyPlan read_accuracy(const json& entry, const json& scene, std::vector<Fault>& faults) {
    AccuracyPlan plan;
    plan.quantity = read_quantity(entry, "/accuracy", scene, faults);
    plan.reference = read_reference(entry, faults);
    plan.ladders = read_ladders(entry.at("ladders"), plan.reference.kind, faults);
    plan.base = entry.at("base").get<std::vector<std::string>>();
    plan.draws = entry.at("draws");
    plan.draws_of = redrawn_named(entry.value("draws_of", ""));
    plan.asked_error = entry.at("asked_error");
    check_draws({plan.draws, plan.draws_of}, plan.quantity.reach, "/accuracy", faults);
    std::size_t rungs = 0;
    for (const Ladder& each : plan.ladders) rungs += each.steps.size();
    if (rungs * plan.draws > most_variants)
        faults.push_back({"/accuracy/draws",
                          "rungs times repeats are more than " + std::to_string(most_variants),
                          "give fewer \"draws\", or split the study"});
    return plan;
}

/// The base first: a rung may change an entry that the base sets.
std::vector<std::string> overrides_of(const AccuracyPlan& plan, std::size_t ladder,
                                      std::size_t step) {
    std::vector<std::string> overrides = plan.base;
    const auto& own = plan.ladders[ladder].steps[step];
    overrides.insert(overrides.end(), own.begin(), own.end());
    return overrides;
}

std::vector<Setting> settings_of(const AccuracyPlan& plan, const json& scene) {
    std::vector<Setting> settings;
    std::map<json, std::size_t> first_with;  // index of the first setting with a scene
    const json base = changed(scene, plan.base);
    for (std::size_t i = 0; i < plan.ladders.size(); ++i) {
        for (std::size_t k = 0; k < plan.ladders[i].steps.size(); ++k) {
            Setting setting{.ladder = i, .step = k, .variants = {}};
            // By the whole changed scene, not by the overrides: two ways to write one setting are
            // one.
            const auto [same, is_new] =
                first_with.emplace(changed(scene, overrides_of(plan, i, k)), settings.size());
            const std::size_t first = same->second;
            setting.is_base = same->first == base;
            // Equal rungs within a ladder are a mistake, reported elsewhere.
            if (!is_new && settings[first].ladder != i) {
                setting.variants = settings[first].variants;
            } else {
                for (std::size_t d = 0; d < plan.draws; ++d)
                    setting.variants.push_back(name_of_draw(name_of_rung(plan.ladders[i], k), d));
            }
            settings.push_back(std::move(setting));
        }
    }
    return settings;
}

std::vector<VariantEntry> variants_of(const AccuracyPlan& plan, const json& scene) {
    std::vector<VariantEntry> entries;
    for (const Setting& setting : settings_of(plan, scene)) {
        const std::string rung = name_of_rung(plan.ladders[setting.ladder], setting.step);
        if (setting.variants.front() != rung) continue;  // shared with another ladder
        const std::string ladder = "/accuracy/ladders/" + std::to_string(setting.ladder);
        const auto overrides = overrides_of(plan, setting.ladder, setting.step);
        const json its_scene = changed(scene, overrides);
        for (std::size_t d = 0; d < plan.draws; ++d) {
            VariantEntry entry{.name = setting.variants[d],
                               .overrides = overrides,
                               .name_pointer = ladder + "/name",
                               .pointer = ladder + "/steps/" + std::to_string(setting.step),
                               .made_by = "accuracy"};
            draw(entry, d, "/accuracy/draws", plan.draws_of, plan.quantity.reach, its_scene);
            entries.push_back(std::move(entry));
        }
    }
    return entries;
}

}  // namespace breach::orchestrator
