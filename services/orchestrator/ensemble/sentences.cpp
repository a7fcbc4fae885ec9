#include "services/orchestrator/ensemble/sentences.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace breach::orchestrator {

using nlohmann::json;

namespace {

std::string shown(const json& value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value.get<double>());
    return text;
}

std::string with_unit(const json& value, const json& statistics) {
    const std::string unit = statistics.at("unit");
    return shown(value) + (unit == "1" || unit.empty() ? "" : " " + unit);
}

std::string counted(const json& number, const std::string& noun) {
    return number.dump() + " " + noun + (number == 1 ? "" : "s");
}

std::string counts_in_words(const json& samples) {
    std::string words = samples.at("done").dump() + " of " +
                        counted(samples.at("planned"), "sample") + " ended with a result";
    if (samples.at("failed") > 0) words += "; " + samples.at("failed").dump() + " without one";
    if (samples.at("no_transfer") > 0)
        words += "; of " + samples.at("no_transfer").dump() + " nothing was transferred";
    if (samples.at("open") > 0) words += "; " + samples.at("open").dump() + " are open";
    words += ".";
    if (samples.at("failed") > 0)
        words +=
            " What those without one would have given is in no number here: if they are the ones "
            "that go farthest, every percentile is too small.";
    if (samples.at("no_transfer") > 0)
        words +=
            " Where nothing was transferred the FEM ended and its triggers had not fired: if the "
            "dam stands there, nothing runs out, and what is told here is told of dams that fail.";
    if (samples.at("questionable") > 0)
        words += " " + samples.at("questionable").dump() +
                 " of the results carry a flag that forbids to rely on them (a runout that still "
                 "moves is a lower bound); they are counted.";
    return words;
}

const json* percentile_in(const json& statistics, double p) {
    const json& list = statistics.at("percentiles");
    if (!list.is_array()) return nullptr;
    for (const json& each : list)
        if (each.at("p") == p) return &each;
    return nullptr;
}

std::string interval_in_words(const json& found, const json& statistics) {
    const json& bound = statistics.at("bound_from");
    const bool at_least = bound.is_number() && found.at("value") >= bound;
    return (at_least ? "at least " : "") + with_unit(found.at("value"), statistics) + " (" +
           shown(found.at("low")) + " to " + shown(found.at("high")) + ")";
}

std::string percentiles_in_words(const std::string& quantity, const json& statistics) {
    const std::string rests = " It rests on " + statistics.at("count").dump() + " of " +
                              counted(statistics.at("of"), "sample") + ".";
    const json* median = percentile_in(statistics, 50);
    if (median == nullptr)
        return quantity + ": " + statistics.at("percentiles").at("refused").get<std::string>() +
               ".";
    std::string words = quantity + ": median " + interval_in_words(*median, statistics);
    if (const json* upper = percentile_in(statistics, 90))
        words += "; one in ten exceeds " + interval_in_words(*upper, statistics);
    words += ".";
    for (const json& each : statistics.at("percentiles_lacking")) {
        words += words.ends_with(".") ? " Not told for lack of samples: p" : ", p";
        words += shown(each.at("p")) + " (needs " + each.at("needs").dump() + ")";
    }
    if (!words.ends_with(".")) words += ".";
    return words + rests;
}

std::string importance_in_words(const json& statistics) {
    const json* first = nullptr;
    for (const json& each : statistics.at("importance"))
        if (each.at("first_order").is_number() &&
            (first == nullptr || each.at("first_order") > first->at("first_order")))
            first = &each;
    if (first == nullptr) return "Too few results, or too alike, to tell which parameter matters.";
    const double least = first->at("first_order_low");
    std::string words = "Most of the spread goes by " + first->at("parameter").get<std::string>() +
                        ": by itself " + shown(100.0 * first->at("first_order").get<double>()) +
                        " % of the variance (" + shown(100.0 * least) + " to " +
                        shown(100.0 * first->at("first_order_high").get<double>()) + " %)";
    if (least == 0.0) words = "No parameter stands out from the noise of so few samples";
    return words + ".";
}

std::string inverse_in_words(const json& inverse) {
    const std::string vary = inverse.at("vary");
    const std::string target = inverse.at("quantity").get<std::string>() + " of " +
                               with_unit(inverse.at("target"), inverse);
    const auto& reason = inverse.at("reason").get_ref<const std::string&>();
    if (inverse.at("state") == "running")
        return "The " + vary + " for a " + target + " is searched.";
    if (inverse.at("state") == "refused") return "No " + vary + " is found: " + reason + ".";
    const json& bound = inverse.at("bound");
    std::string words = "A " + vary + " of " +
                        (bound == "at_least"  ? "at least "
                         : bound == "at_most" ? "at most "
                                              : "") +
                        shown(inverse.at("value"));
    if (inverse.at("low").is_number())
        words += " (" + shown(inverse.at("low")) + " to " + shown(inverse.at("high")) +
                 " by the scatter of lattices alone)";
    words += " gives a " + target + ", the other parameters at their medians.";
    return reason.empty() ? words : words + " Note: " + reason + ".";
}

std::string probability_in_words(const json& stability, const std::string& when) {
    const json& failed = stability.at("probability_of_failure");
    const auto percent = [&](const char* which) {
        return shown(100.0 * failed.at(which).get<double>());
    };
    return "Probability of failure (factor of safety below 1" + when +
           "), by the same draws as the other results: " + percent("value") + " % (" +
           percent("low") + " to " + percent("high") + " %), of " +
           counted(stability.at("count"), "sample") + ".";
}

}  // namespace

std::vector<std::string> sentences_of(const json& findings) {
    std::vector<std::string> sentences{counts_in_words(findings.at("samples"))};
    if (findings.at("inverse").is_object()) {
        sentences.push_back(inverse_in_words(findings.at("inverse")));
        return sentences;
    }
    const std::string quantity = findings.at("quantity");
    const json& quantities = findings.at("quantities");
    if (quantities.contains(quantity)) {
        const json& statistics = quantities.at(quantity);
        sentences.push_back(percentiles_in_words(quantity, statistics));
        sentences.push_back(importance_in_words(statistics));
        if (statistics.at("tornado").contains("refused"))
            sentences.push_back(
                "No tornado: " + statistics.at("tornado").at("refused").get<std::string>() +
                ". A fitted polynomial would not tell what one parameter does.");
    }
    const bool liquefies = quantities.contains("factor_of_safety_liquefied");
    if (quantities.contains("factor_of_safety"))
        sentences.push_back(probability_in_words(quantities.at("factor_of_safety"),
                                                 liquefies ? " before any layer liquefies" : ""));
    if (liquefies)
        sentences.push_back(probability_in_words(quantities.at("factor_of_safety_liquefied"),
                                                 " with every layer liquefied that may"));
    const json& parameters = findings.at("parameters");
    const auto of_kind = [&](const char* kind) {
        return std::ranges::any_of(parameters,
                                   [&](const json& each) { return each.at("kind") == kind; });
    };
    if (of_kind("choice"))
        sentences.emplace_back(
            "A choice has no order, so no rank correlation: its importance is the correlation "
            "ratio.");
    if (std::ranges::any_of(parameters,
                            [](const json& each) { return !each.at("asked_correlation").empty(); }))
        sentences.emplace_back(
            "Parameters are correlated: each one's share of the variance has some of the others' "
            "in it, and the tornado moves one without the others.");
    sentences.emplace_back(
        "Intervals are of 90 % and take the samples as independent; those of a Latin hypercube or "
        "a Sobol sequence scatter less, so these are rather too wide than too narrow.");
    return sentences;
}

}  // namespace breach::orchestrator
