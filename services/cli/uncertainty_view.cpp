// Tables of `breach uncertainty`, from the server's findings; it computes nothing. A result is
// marked as a lower bound where soil of a sample was still moving.
#include "services/cli/uncertainty_view.hpp"

#include <nlohmann/json.hpp>

#include "services/cli/table.hpp"

namespace breach::cli {

using nlohmann::json;

namespace {

/// "12.3 (11.1 to 13.4)"; "-" for null.
std::string with_interval(const json& object, const char* value, const char* low,
                          const char* high) {
    if (!object.at(value).is_number()) return "-";
    return cell(object, value) + " (" + cell(object, low) + " to " + cell(object, high) + ")";
}

/// Both counts, as percentiles of the samples that ended may be those of the easy ones.
std::string title_of(const std::string& name, const json& statistics) {
    const std::string unit = cell(statistics, "unit");
    return name + (unit == "1" ? "" : " [" + unit + "]") + ", " + cell(statistics, "count") +
           " of " + cell(statistics, "of") + " samples";
}

/// ">= 12.3" if a sample at or below this value still moved.
std::string marked(const json& value, const json& statistics) {
    const json bound = statistics.value("bound_from", json());
    return (bound.is_number() && value.is_number() && value >= bound ? ">= " : "") + cell(value);
}

/// The server may refuse percentiles; its reason stands where they would.
std::string percentile_table(const std::string& name, const json& statistics) {
    const bool moves = statistics.value("bound_from", json()).is_number();
    std::vector<Cells> rows{{"mean", (moves ? ">= " : "") + cell(statistics, "mean"), ""},
                            {"standard deviation", cell(statistics, "sd"), ""}};
    const json& percentiles = statistics.at("percentiles");
    if (percentiles.is_array())
        for (const json& each : percentiles)
            rows.push_back({"p" + cell(each, "p"), marked(each.at("value"), statistics),
                            marked(each.at("low"), statistics) + " to " +
                                marked(each.at("high"), statistics)});
    std::string text =
        as_table({{title_of(name, statistics), Align::left}, {"", right}, {"90 % interval"}}, rows);
    if (percentiles.is_object()) text += cell(percentiles, "refused") + "\n";
    return text;
}

/// The parameter's bar in the tornado; "-": none.
std::string bar_of(const json& tornado, const json& parameter) {
    if (tornado.contains("bars"))
        for (const json& each : tornado.at("bars"))
            if (each.at("parameter") == parameter)
                return cell(each, "p10") + " / " + cell(each, "p90");
    return "-";
}

/// One row per parameter and one column per measure of its influence, each with its interval; the
/// sentence below says of which model p10 and p90 are.
/// A polynomial is fitted only where the server finds it good enough; Q2 is its share of the
/// variance in samples that it was not fitted to.
std::string importance_table(const json& statistics) {
    std::vector<Cells> rows;
    const json& tornado = statistics.at("tornado");
    for (const json& each : statistics.at("importance"))
        rows.push_back(
            {cell(each, "parameter"), with_interval(each, "rank_correlation", "low", "high"),
             with_interval(each, "partial_rank_correlation", "partial_low", "partial_high"),
             with_interval(each, "first_order", "first_order_low", "first_order_high"),
             bar_of(tornado, each.at("parameter"))});
    std::string text = as_table(
        {{"parameter"}, {"rank correlation"}, {"partial"}, {"share of variance"}, {"at p10 / p90"}},
        rows);
    if (tornado.contains("bars"))
        text += "at p10 / p90: by a polynomial (" + cell(tornado, "form") + ", Q2 " +
                cell(tornado, "q2") +
                "), the others at their medians: " + cell(tornado, "at_median") + "\n";
    return text;
}

/// Samples without a result, and why.
std::string left_out(const json& samples) {
    std::string text;
    for (const json& each : samples.at("left_out"))
        text +=
            cell(each, "sample") + " " + cell(each, "state") + ": " + cell(each, "reason") + "\n";
    return text.empty() ? text : text + "\n";
}

/// The values that the study tried, with the result of each.
std::string inverse_table(const json& inverse) {
    if (!inverse.is_object()) return "";
    std::vector<Cells> rows;
    for (const json& each : inverse.at("steps"))
        rows.push_back({cell(each, "value"), cell(each, "result"),
                        std::to_string(each.at("results").size()), cell(each, "state")});
    return as_table({{cell(inverse, "vary"), Align::right},
                     {cell(inverse, "quantity"), Align::right},
                     {"lattices", right},
                     {"state"}},
                    rows) +
           "\n";
}

}  // namespace

std::string as_uncertainty_view(const json& answer) {
    std::string text = inverse_table(answer.at("inverse"));
    for (const auto& [name, statistics] : answer.at("quantities").items())
        text += percentile_table(name, statistics) + "\n" + importance_table(statistics) + "\n";
    text += left_out(answer.at("samples"));
    for (const json& each : answer.at("sentences")) text += cell(each) + "\n";
    return text;
}

}  // namespace breach::cli
