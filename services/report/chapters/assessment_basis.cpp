// The data behind an assessment: distributions, envelopes along x, hydrographs, samples.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/exchange/archive.hpp"
#include "core/phases/files.hpp"
#include "core/phases/phases.hpp"
#include "services/findings/flags.hpp"
#include "services/report/chapters/assessment.hpp"
#include "services/report/figures/uncertainty_figures.hpp"
#include "services/report/read/samples.hpp"
#include "services/report/read/verdict.hpp"

namespace breach::report {

using nlohmann::json;
using namespace nlohmann::literals;

namespace {

constexpr std::size_t most_rows = 100;  // of a printed table
constexpr double no_bound_yet = std::numeric_limits<double>::infinity();

/// Adds the paper's runout to the figure.
void add_published(const Material& from, const std::string& quantity, Figure& figure) {
    if (!from.paper || !quantity.starts_with("runout")) return;
    for (const PaperValue& each : from.paper->values)
        if (each.key == "plateau_runout:softened")
            figure.chart.marks.push_back(
                {Mark::At::x, each.value, "published: " + short_number(each.value) + " m"});
    const std::string& observed = from.paper->case_history_runout;
    const std::size_t digit = observed.find_first_of("0123456789");
    if (digit != std::string::npos)
        figure.chart.marks.push_back(
            {Mark::At::x, std::stod(observed.substr(digit)), "observed: " + observed + " m"});
}

std::optional<double> least_moving(const Run& run, const std::string& quantity) {
    std::optional<double> least;
    if (!findings::grows(quantity)) return least;
    for (const PhaseFolder* each : moving_samples(run))
        if (const json value = each->result.value(quantity, json()); value.is_number())
            least = std::min(least.value_or(no_bound_yet), value.get<double>());
    return least;
}

/// Discharge at every section of the samples whose runout lies nearest to p50 and to p90.
void add_hydrographs(const Run& run, const std::string& name, Chapter& chapter) {
    const json& quantity = run.uncertainty.at("quantities").at(name);
    for (const double p : {50.0, 90.0}) {
        const json* wanted = percentile_in(quantity, p);
        auto samples = sampled_runouts(run);
        std::erase_if(samples, [&](const PhaseFolder* each) {
            return !each->result.value(name, json()).is_number();
        });
        if (!wanted || samples.empty()) continue;
        const double value = wanted->at("value");
        const PhaseFolder& nearest =
            **std::ranges::min_element(samples, {}, [&](const PhaseFolder* each) {
                return std::abs(each->result.at(name).get<double>() - value);
            });
        const auto file = nearest.files / phases::files::history;
        if (!std::filesystem::is_regular_file(file)) continue;
        const auto archive = exchange::read_archive(file, "mpm_history", 1);
        const auto times = archive.reals.find("time");
        if (times == archive.reals.end()) continue;
        Figure figure{"hydrographs_p" + rounded(p, 2),
                      {"Discharge at the sections, sample nearest to p" + rounded(p, 2),
                       {"time [s]"},
                       {"discharge [m3/s per m of width]"},
                       {}},
                      "Sample " + nearest.variant + ", with " + name + " of " +
                          bounded(nearest, rounded(nearest.result.at(name).get<double>(), 4)) +
                          ": one run, no envelope. The hydrograph of a percentile of the runout "
                          "is not the percentile of the hydrographs."};
        for (const json& section : run.scene.value("/mpm/sections"_json_pointer, json::array())) {
            const std::string of = section.at("name");
            const auto found = archive.reals.find("section." + of + ".discharge");
            if (found == archive.reals.end() || found->second.size() != times->second.size())
                continue;
            figure.chart.series.push_back({of, times->second, found->second, Style::line});
        }
        if (!figure.chart.series.empty()) chapter.figures.push_back(std::move(figure));
    }
}

Table percentile_table(const Run& run) {
    Table table{
        "assessment_percentiles",
        "Percentiles",
        {"quantity", "samples", "mean", "standard deviation", "p5", "p10", "p50", "p90", "p95"},
        {},
        "In brackets: 90 % intervals. Mean and standard "
        "deviation of distances that are lower bounds in part are too small."};
    for (const std::string& name : quantities_of(run.uncertainty)) {
        const json& quantity = run.uncertainty.at("quantities").at(name);
        const bool bound = findings::grows(name) && !moving_samples(run).empty();
        std::vector<std::string> row{
            words_of(name) + unit_in_brackets(quantity),
            quantity.at("count").dump() + " of " + quantity.at("of").dump(),
            (bound ? at_least : "") + or_dash(quantity.at("mean"), 4), or_dash(quantity.at("sd"))};
        for (const double p : {5.0, 10.0, 50.0, 90.0, 95.0})
            row.push_back(percentile_text(run, name, p));
        table.rows.push_back(std::move(row));
    }
    return table;
}

Table importance_table(const json& quantity, const std::string& name) {
    Table table{"assessment_importance",
                "What decides " + name,
                {"parameter", "rank correlation", "its interval", "partial",
                 "share of the variance", "its interval"},
                {},
                "An interval that contains 0: the parameter may have no effect. The share is what "
                "the parameter explains alone. Options of a choice and lattices have no "
                "order, and so no rank correlation."};
    if (!quantity.at("importance").is_array()) return table;
    for (const json& each : quantity.at("importance"))
        table.rows.push_back({each.at("parameter"),
                              or_dash(each.value("rank_correlation", json()), 2),
                              ends_of(each, "low", "high"),
                              or_dash(each.value("partial_rank_correlation", json()), 2),
                              or_dash(each.value("first_order", json()), 2),
                              ends_of(each, "first_order_low", "first_order_high")});
    return table;
}

Table left_out_table(const json& samples) {
    Table table{
        "assessment_left_out", "Samples without a result", {"sample", "state", "why"}, {}, ""};
    for (const json& each : samples.at("left_out")) {
        const json why = each.value("reason", json());
        table.rows.push_back(
            {each.at("sample"), each.at("state"), why.is_string() ? why.get<std::string>() : "-"});
    }
    return table;
}

std::string drawn_text(const json& value) {
    if (value.is_number()) return rounded(value.get<double>(), 4);
    return value.is_string() ? value.get<std::string>() : "-";
}

Table sample_table(const Run& run, const std::string& name) {
    const json& answer = run.uncertainty;
    Table table{"assessment_samples", "The samples", {"sample", "state"}, {}, ""};
    for (const json& each : answer.at("parameters")) table.columns.push_back(each.at("name"));
    table.columns.push_back(name);
    const auto moving = moving_samples(run);
    for (const json& row : answer.at("rows")) {
        std::vector<std::string> cells{row.at("sample"), row.at("state")};
        for (const json& each : answer.at("parameters"))
            cells.push_back(
                drawn_text(row.at("values").value(each.at("name").get<std::string>(), json())));
        const json results = row.value("results", json());
        const std::string value =
            results.is_object() ? or_dash(results.value(name, json()), 4) : "-";
        const bool bound = findings::grows(name) && value != "-" &&
                           std::ranges::any_of(moving, [&](const PhaseFolder* each) {
                               return json(each->variant) == row.at("sample");
                           });
        cells.push_back((bound ? at_least : "") + value);
        table.rows.push_back(std::move(cells));
    }
    return table;
}

void add_envelopes(const Run& run, Chapter& chapter, Document& document) {
    if (!run.envelopes.is_object()) {
        document.left_out.push_back({"depth, velocity and arrival along x over the samples",
                                     "the folder has no envelopes.json"});
        return;
    }
    for (Figure& each : envelope_figures(run.envelopes)) chapter.figures.push_back(std::move(each));
}

}  // namespace

Chapter assessment_basis(const Material& from, const std::string& name, Document& document) {
    const Run& run = from.run;
    const json& quantity = run.uncertainty.at("quantities").at(name);
    const std::string label = words_of(name) + unit_in_brackets(quantity);
    Chapter chapter{"Basis of the assessment"};
    Figure exceedance = exceedance_figure(quantity, label, least_moving(run, name));
    add_published(from, name, exceedance);
    chapter.figures.push_back(std::move(exceedance));
    if (auto tornado = tornado_figure(quantity, label))
        chapter.figures.push_back(std::move(*tornado));
    else
        document.left_out.push_back(
            {"tornado: one parameter at a time", quantity.at("tornado").at("refused")});
    add_envelopes(run, chapter, document);
    add_hydrographs(run, name, chapter);
    chapter.tables = {percentile_table(run), importance_table(quantity, name),
                      left_out_table(run.uncertainty.at("samples"))};
    if (run.uncertainty.at("rows").size() <= most_rows)
        chapter.tables.push_back(sample_table(run, name));
    else
        document.left_out.push_back(
            {"the table of all samples", "it has more than " + std::to_string(most_rows) +
                                             " rows; they stand in uncertainty.json"});
    std::erase_if(chapter.tables, [](const Table& each) { return each.rows.empty(); });
    return chapter;
}

}  // namespace breach::report
