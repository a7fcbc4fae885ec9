// The chapter of a study of several motions.
#include <cmath>

#include "core/statistics/quantiles.hpp"
#include "services/report/chapters/chapters.hpp"

namespace breach::report {

using nlohmann::json;

namespace {

std::string with_interval(const json& found, const char* value) {
    return rounded(found.at(value), 3) + " (" + rounded(found.at("low"), 3) + " to " +
           rounded(found.at("high"), 3) + ")";
}

std::string correlation(const json& found) {
    return found.is_null() ? "-" : with_interval(found, "value");
}

Table measures_of_motions(const json& found) {
    Table table{"motion_measures",
                "Which measure goes with what",
                {"measure", "with liquefied depth", "with runout", "half past the toe at"},
                {}};
    table.caption =
        "Rank correlation with its 90 % interval; median of the lognormal fragility curve, with "
        "its interval, or why there is none.";
    for (const json& each : found.at("measures")) {
        const json& curve = each.at("fragility");
        table.rows.push_back(
            {each.at("title").get<std::string>() + " [" + each.at("unit").get<std::string>() + "]",
             correlation(each.at("with_depth")), correlation(each.at("with_runout")),
             curve.contains("refused") ? curve.at("refused").get<std::string>()
                                       : with_interval(curve, "median")});
    }
    return table;
}

Table rows_of_motions(const json& found) {
    Table table{"motions_of_study",
                "The motions",
                {"variant", "liquefied depth [m]", "runout past the toe [m]"},
                {}};
    for (const json& each : found.at("measures"))
        table.columns.push_back(each.at("title").get<std::string>() + " [" +
                                each.at("unit").get<std::string>() + "]");
    for (const json& row : found.at("rows")) {
        const bool bound = row.at("lower_bound");
        table.rows.push_back({row.at("variant"), rounded(row.at("liquefaction_depth"), 3),
                              row.at("runout").is_null()
                                  ? "-"
                                  : (bound ? "\u2265 " : "") + rounded(row.at("runout"), 3)});
        for (const json& each : found.at("measures"))
            table.rows.back().push_back(rounded(row.at(each.at("name").get<std::string>()), 3));
    }
    return table;
}

Figure runout_against_depth(const json& found) {
    Series points{"motions", {}, {}, Style::points};
    for (const json& row : found.at("rows")) {
        if (row.at("runout").is_null()) continue;
        points.x.push_back(row.at("liquefaction_depth"));
        points.y.push_back(row.at("runout"));
        points.certainty.push_back(row.at("lower_bound") ? Certainty::at_least
                                                         : Certainty::certain);
    }
    Chart chart{"Runout against liquefied depth",
                {"liquefied depth [m]"},
                {"runout past the toe [m]"},
                {std::move(points)}};
    if (const json& onset = found.at("onset"); !onset.is_null())
        chart.marks.push_back({Mark::At::x, onset.at("depth"), "soil passes the toe"});
    if (const json& full = found.at("saturation"); !full.is_null())
        chart.marks.push_back({Mark::At::x, full.at("depth"), "90 % of the largest"});
    return {"runout_against_liquefied_depth", std::move(chart), "One point per motion."};
}

/// For the measure that correlates best with the liquefied depth; nothing: it has no curve.
std::optional<Figure> fragility_figure(const json& found) {
    for (const json& each : found.at("measures")) {
        const json& curve = each.at("fragility");
        if (each.at("name") != found.at("best") || curve.contains("refused")) continue;
        const double median = curve.at("median"), beta = curve.at("beta");
        Series line{"lognormal", {}, {}},
            points{"motions: past the toe or not", {}, {}, Style::points};
        for (double z = -3.0; z <= 3.0; z += 0.1) {
            line.x.push_back(median * std::exp(beta * z));
            line.y.push_back(statistics::normal_cdf(z));
        }
        for (const json& row : found.at("rows")) {
            if (row.at("runout").is_null()) continue;
            points.x.push_back(row.at(each.at("name").get<std::string>()));
            points.y.push_back(row.at("runout") > 0 ? 1.0 : 0.0);
        }
        const std::string label =
            each.at("title").get<std::string>() + " [" + each.at("unit").get<std::string>() + "]";
        return Figure{"fragility",
                      {"Fragility",
                       {label},
                       {"probability that soil passes the toe"},
                       {std::move(line), std::move(points)}},
                      "Of these motions, which are no sample of the site's earthquakes."};
    }
    return std::nullopt;
}

}  // namespace

void add_motions(const Material& from, Document& document) {
    const json& found = from.run.motions;
    if (!found.is_object()) return;
    Chapter chapter{"Several motions"};
    for (const json& each : found.at("sentences"))
        chapter.text += (chapter.text.empty() ? "" : " ") + each.get<std::string>();
    chapter.figures.push_back(runout_against_depth(found));
    if (auto curve = fragility_figure(found)) chapter.figures.push_back(std::move(*curve));
    chapter.tables = {measures_of_motions(found), rows_of_motions(found)};
    document.chapters.push_back(std::move(chapter));
}

}  // namespace breach::report
