// Sentences and cautions from the document of uncertainty/answer.cpp, which calls it. Words are
// made on the server, so that page, CLI and report say the same. Sentences say what was found;
// cautions say why a number may be wrong and what to do about it.
#include "services/findings/uncertainty.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/words/number.hpp"

namespace breach::findings {

using nlohmann::json;

namespace {

std::string shown(const json& value) { return words::text_of(value.get<double>(), 3); }

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
    return words;
}

/// Nothing where percentiles are refused, or where this one has too few samples.
const json* percentile_in(const json& statistics, double p) {
    const json& list = statistics.at("percentiles");
    if (!list.is_array()) return nullptr;
    for (const json& each : list)
        if (each.at("p") == p) return &each;
    return nullptr;
}

/// Only percentiles at or above the least lower bound are lower bounds themselves.
std::string interval_in_words(const json& found, const json& statistics) {
    const json& bound = statistics.at("bound_from");
    const bool at_least = bound.is_number() && found.at("value") >= bound;
    return (at_least ? "at least " : "") + with_unit(found.at("value"), statistics) + " (" +
           shown(found.at("low")) + " to " + shown(found.at("high")) + ")";
}

std::string percentiles_in_words(const std::string& quantity, const json& statistics) {
    const std::string rests = " From " + statistics.at("count").dump() + " of " +
                              counted(statistics.at("of"), "sample") + ".";
    const json* median = percentile_in(statistics, 50);
    if (median == nullptr)
        return quantity + ": " + statistics.at("percentiles").at("refused").get<std::string>() +
               ".";
    std::string words = quantity + ": median " + interval_in_words(*median, statistics);
    if (const json* upper = percentile_in(statistics, 90))
        words += "; one in ten exceeds " + interval_in_words(*upper, statistics);
    words += ".";
    return words + rests;
}

/// Names one parameter, and only when its interval excludes 0: with few samples the largest of many
/// estimates is often noise.
std::string importance_in_words(const json& statistics) {
    const json* first = nullptr;
    for (const json& each : statistics.at("importance"))
        if (each.at("first_order").is_number() &&
            (first == nullptr || each.at("first_order") > first->at("first_order")))
            first = &each;
    if (first == nullptr) return "Too few results, or too alike, to tell which parameter matters.";
    const double least = first->at("first_order_low");
    std::string words = "Most of the spread comes from " +
                        first->at("parameter").get<std::string>() + ": alone it explains " +
                        shown(100.0 * first->at("first_order").get<double>()) +
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
           "), from the same samples as the other results: " + percent("value") + " % (" +
           percent("low") + " to " + percent("high") + " %), of " +
           counted(stability.at("count"), "sample") + ".";
}

/// Whether failed samples would run far is not known, so the caution says which way the error goes.
std::string failed_caution(const json& samples) {
    if (samples.at("failed") == 0) return "";
    return counted(samples.at("failed"), "sample") + " of " + samples.at("planned").dump() +
           " left no result and are in no number here. If they are the ones that run farthest, "
           "every percentile is too small.";
}

std::string standing_caution(const json& samples) {
    if (samples.at("no_transfer") == 0) return "";
    return "No transfer from " + counted(samples.at("no_transfer"), "sample") + " of " +
           samples.at("planned").dump() +
           ": the FEM ended and no trigger fired. If the dam does not fail there, nothing runs "
           "out; every "
           "number here is of the samples with a transfer.";
}

/// one_value: an inverse study, which has no percentiles.
std::string moving_caution(const json& samples, bool one_value) {
    if (samples.at("moving") == 0) return "";
    std::string text =
        samples.at("moving").dump() + " of " + counted(samples.at("done"), "sample") +
        " were stopped while their soil still moved: their distances are lower bounds";
    if (!one_value)
        text +=
            ", and so are the mean and every percentile at or above the least of them (marked "
            "\u2265). Importance and tornado take them as values";
    return text + ". Let them run longer (/mpm/duration).";
}

std::string questionable_caution(const json& samples) {
    if (samples.at("doubtful") == 0) return "";
    return counted(samples.at("doubtful"), "sample") +
           " are questionable, although their soil came to rest (see their flags). The results "
           "include them.";
}

std::string few_caution(const json& answer) {
    const json& quantities = answer.at("quantities");
    const std::string quantity = answer.at("quantity");
    if (!quantities.contains(quantity)) return "";
    std::string lacking;
    for (const json& each : quantities.at(quantity).at("percentiles_lacking"))
        lacking += (lacking.empty() ? "p" : ", p") + shown(each.at("p")) + " (needs " +
                   each.at("needs").dump() + ")";
    if (lacking.empty()) return "";
    return "Too few samples for " + lacking + ": " + quantities.at(quantity).at("count").dump() +
           " have a result.";
}

/// Bounds of a parameter cut its distribution: a result that needs a value beyond them has no
/// probability here.
std::string cut_caution(const json& parameters) {
    std::string cut;
    for (const json& each : parameters)
        if (each.value("between", json()).is_array())
            cut += (cut.empty() ? "" : ", ") + each.at("name").get<std::string>();
    if (cut.empty()) return "";
    return "No value is drawn outside of the bounds given for " + cut +
           ": what lies beyond them is impossible here, not rare.";
}

std::string until_caution(const json& until) {
    if (!until.is_object() || until.at("reached") == true) return "";
    const json& now = until.at("now");
    const auto percent = [](const json& share) {
        return shown(100.0 * share.get<double>()) + " %";
    };
    return "Wanted: p" + shown(until.at("percentile")) + " of " +
           until.at("quantity").get<std::string>() + " to \u00b1 " +
           percent(until.at("half_width")) + " of its value. " +
           (now.is_number() ? "Reached: \u00b1 " + percent(now) + "."
                            : "Too few samples to tell how near it is.");
}

std::string open_caution(const json& samples) {
    if (samples.at("open") == 0) return "";
    return counted(samples.at("open"), "sample") + " have not ended: the numbers will change.";
}

}  // namespace

std::vector<std::string> sentences_of(const json& answer) {
    std::vector<std::string> sentences{counts_in_words(answer.at("samples"))};
    // An inverse study's values are chosen by the search: statistics over them would mean nothing.
    if (answer.at("inverse").is_object()) {
        sentences.push_back(inverse_in_words(answer.at("inverse")));
        return sentences;
    }
    const std::string quantity = answer.at("quantity");
    const json& quantities = answer.at("quantities");
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
    const json& parameters = answer.at("parameters");
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

std::vector<std::string> cautions_of(const json& answer) {
    const json& samples = answer.at("samples");
    std::vector<std::string> said{failed_caution(samples),
                                  standing_caution(samples),
                                  moving_caution(samples, answer.at("inverse").is_object()),
                                  questionable_caution(samples),
                                  few_caution(answer),
                                  cut_caution(answer.at("parameters")),
                                  until_caution(answer.at("until")),
                                  open_caution(samples)};
    // The order of cautions is that of their weight: missing samples first, what will change last.
    std::erase(said, "");
    return said;
}

}  // namespace breach::findings
