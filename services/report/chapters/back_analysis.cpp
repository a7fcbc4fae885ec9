// The chapter of a back analysis: which value of a parameter gives a known result.
#include <algorithm>

#include "services/report/chapters/assessment.hpp"
#include "services/report/read/samples.hpp"
#include "services/report/read/verdict.hpp"

namespace breach::report {

using nlohmann::json;

namespace {

std::string label_of(const json& inverse) {
    return words_of(inverse.at("quantity")) + unit_in_brackets(inverse);
}

bool has_result(const json& step) { return step.at("result").is_number(); }

Table table_of_steps(const json& inverse) {
    Table table{"back_analysis_steps",
                "Values that were run",
                {inverse.at("vary"), label_of(inverse), "of its lattices", "lower bounds", "state"},
                {},
                ""};
    for (const json& step : inverse.at("steps")) {
        std::string lattices;
        for (const json& each : step.at("results"))
            lattices += (lattices.empty() ? "" : "; ") + or_dash(each, 4);
        const bool bound = step.at("lower_bounds") > 0;
        table.rows.push_back(
            {or_dash(step.at("value"), 4), (bound ? at_least : "") + or_dash(step.at("result"), 4),
             lattices.empty() ? "-" : lattices,
             step.at("lower_bounds").dump() + " of " + std::to_string(step.at("results").size()),
             step.at("state")});
    }
    return table;
}

Figure figure_of_steps(const json& inverse) {
    Series means{
        "mean of the lattices, from the least to the largest", {}, {}, Style::line_and_points};
    for (const json& step : inverse.at("steps")) {
        if (!has_result(step)) continue;
        const auto [least, largest] =
            std::ranges::minmax(step.at("results").get<std::vector<double>>());
        means.x.push_back(step.at("value"));
        means.y.push_back(step.at("result"));
        means.low.push_back(least);
        means.high.push_back(largest);
        means.certainty.push_back(step.at("lower_bounds") > 0 ? Certainty::at_least
                                                              : Certainty::certain);
    }
    const bool positive = !means.x.empty() && means.x.front() > 0.0;
    Figure figure{"back_analysis",
                  {"Result against the value",
                   {inverse.at("vary"), positive ? Scale::logarithmic : Scale::linear},
                   {label_of(inverse)},
                   {means}},
                  "Dashed: the target. All other parameters have their medians."};
    figure.chart.marks.push_back({Mark::At::y, inverse.at("target"), "asked"});
    if (inverse.at("value").is_number())
        figure.chart.marks.push_back({Mark::At::x, inverse.at("value"), value_found(inverse)});
    return figure;
}

}  // namespace

std::string value_found(const json& inverse) {
    const json& bound = inverse.at("bound");
    return (bound == "at_least"  ? at_least
            : bound == "at_most" ? "\u2264 "
                                 : "") +
           or_dash(inverse.at("value"), 3);
}

Chapter back_analysis(const Run& run) {
    const json& inverse = run.uncertainty.at("inverse");
    Chapter chapter{"Back-analysis"};
    for (const json& each : run.uncertainty.at("sentences"))
        chapter.text += (chapter.text.empty() ? "" : " ") + each.get<std::string>();
    chapter.opens_page = true;
    chapter.cautions.push_back(
        "The value makes this model give the result: it holds what the model leaves out (see the "
        "limits on the first page), and is no strength that was measured. Only " +
        inverse.at("vary").get<std::string>() +
        " was moved; another parameter moved as well gives another value.");
    chapter.tables.push_back(table_of_steps(inverse));
    if (std::ranges::any_of(inverse.at("steps"), has_result))
        chapter.figures.push_back(figure_of_steps(inverse));
    return chapter;
}

}  // namespace breach::report
