// The two chapters of a dam-breach assessment (GISTM 2.3; CDA 2021) from a study over
// distributions, and their shared wording.
#include <algorithm>
#include <map>

#include "services/report/chapters/assessment.hpp"
#include "services/report/read/samples.hpp"
#include "services/report/read/verdict.hpp"

namespace breach::report {

using nlohmann::json;

std::string count_of(const json& number, const std::string& noun) {
    return number.dump() + " " + noun + (number == 1 ? "" : "s");
}

std::vector<std::string> quantities_of(const json& answer) {
    std::vector<std::string> names{answer.at("quantity")};
    for (const auto& [name, quantity] : answer.at("quantities").items())
        if (name != names.front()) names.push_back(name);
    std::erase_if(names, [&](const auto& each) { return !answer.at("quantities").contains(each); });
    return names;
}

std::string words_of(const std::string& quantity) {
    static const std::map<std::string, std::string> words{
        {"runout", "Runout: 99 % of the mobile soil, from the toe"},
        {"runout_beyond_toe", "Of what passed the toe, 99 %"},
        {"runout_largest", "Farthest point"},
        {"area_beyond_toe", "Deposit beyond the toe, per metre of width"},
        {"factor_of_safety", "Factor of safety, nothing liquefied"},
        {"factor_of_safety_liquefied", "Factor of safety, every layer liquefied that may"}};
    const auto found = words.find(quantity);
    return found == words.end() ? quantity : found->second;
}

std::string unit_in_brackets(const json& quantity) {
    const std::string unit = quantity.at("unit");
    return unit.empty() || unit == "1" ? "" : " [" + unit + "]";
}

std::string percentile_text(const Run& run, const std::string& name, double p) {
    const json& quantity = run.uncertainty.at("quantities").at(name);
    const json* found = percentile_in(quantity, p);
    if (!found) return why_no_percentile(quantity, p);
    const auto text = [&](const char* key) {
        const double value = found->at(key);
        return (is_lower_bound(run, name, value) ? at_least : "") + rounded(value, 4);
    };
    return text("value") + " (" + text("low") + " to " + text("high") + ")";
}

std::string known_of(const Run& run, const std::string& name) {
    const json& quantity = run.uncertainty.at("quantities").at(name);
    return quantity.at("count").dump() + " of " + quantity.at("of").dump() + " samples";
}

std::string or_dash(const json& value, int digits) {
    return value.is_number() ? rounded(value.get<double>(), digits) : "-";
}

std::string ends_of(const json& each, const char* low, const char* high) {
    if (!each.value(low, json()).is_number()) return "-";
    return or_dash(each.at(low), 2) + " to " + or_dash(each.at(high), 2);
}

void add_assessment(const Material& from, Document& document) {
    const Run& run = from.run;
    if (!has_samples(run)) {
        if (run.study.is_object() && run.study.contains("uncertainty"))
            document.left_out.push_back(
                {"dam-breach assessment",
                 "the folder has no uncertainty.json: export the run again"});
        return;
    }
    if (is_back_analysis(run)) {
        document.chapters.push_back(back_analysis(run));
        return;
    }
    const auto names = quantities_of(run.uncertainty);
    if (names.empty()) {
        document.left_out.push_back({"dam-breach assessment", "no sample has a result"});
        return;
    }
    document.chapters.push_back(assessment_page(run, names.front()));
    document.chapters.push_back(assessment_basis(from, names.front(), document));
}

std::optional<std::vector<std::string>> sampled_answer(const Run& run) {
    if (!has_samples(run)) return {};
    if (is_back_analysis(run)) {
        const json& inverse = run.uncertainty.at("inverse");
        return std::vector<std::string>{
            inverse.at("vary").get<std::string>() + " for " + words_of(inverse.at("quantity")) +
                " of " + or_dash(inverse.at("target"), 4) + " " +
                inverse.at("unit").get<std::string>(),
            value_found(inverse), or_dash(inverse.at("low")) + " to " + or_dash(inverse.at("high")),
            "by the scatter of lattices alone; chapter \"Back-analysis\""};
    }
    const auto names = quantities_of(run.uncertainty);
    if (names.empty()) return {};
    return std::vector<std::string>{
        words_of(names.front()) +
            unit_in_brackets(run.uncertainty.at("quantities").at(names.front())) +
            ", over the samples",
        "p50: " + percentile_text(run, names.front(), 50),
        "p10: " + percentile_text(run, names.front(), 10) +
            "; p90: " + percentile_text(run, names.front(), 90),
        known_of(run, names.front()) + "; chapter \"Dam-breach assessment\""};
}

}  // namespace breach::report
