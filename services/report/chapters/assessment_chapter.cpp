// What a dam-breach assessment has to say (GISTM 2.3; CDA 2021), of a study over distributions: what
// fails, when, how far, when it arrives and how deep, each with its spread and with what it rests on;
// and what cannot be said.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "core/exchange/archive.hpp"
#include "core/exchange/provenance.hpp"
#include "core/phases/files.hpp"
#include "core/phases/phases.hpp"
#include "services/report/chapters/chapters.hpp"
#include "services/report/figures/uncertainty_figures.hpp"
#include "services/report/read/samples.hpp"
#include "services/report/read/verdict.hpp"

namespace breach::report {

using nlohmann::json;
using namespace nlohmann::literals;

namespace {

constexpr std::size_t most_rows = 100;  // of a table that is printed
constexpr double never = std::numeric_limits<double>::infinity();

std::string count_of(const json& number, const std::string& noun) {
    return number.dump() + " " + noun + (number == 1 ? "" : "s");
}

/// In the order in which they are told: what is asked first, then the other distances.
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
        {"factor_of_safety", "Factor of safety"}};
    const auto found = words.find(quantity);
    return found == words.end() ? quantity : found->second;
}

std::string unit_in_brackets(const json& quantity) {
    const std::string unit = quantity.at("unit");
    return unit.empty() || unit == "1" ? "" : " [" + unit + "]";
}

// ---------------------------------------------------------------- what must be known first

std::string failed_caution(const json& samples) {
    if (samples.at("failed") == 0) return "";
    return count_of(samples.at("failed"), "sample") + " of " + samples.at("planned").dump() +
           " left no result and are in no number here. If they are the ones that run farthest, "
           "every percentile is too small.";
}

std::string moving_caution(const Run& run) {
    const auto moving = moving_samples(run);
    if (moving.empty()) return "";
    return std::to_string(moving.size()) + " of " + std::to_string(sampled_runouts(run).size()) +
           " samples were stopped while their soil still moved (flag \"still moving\"): their "
           "distances are lower bounds, and so is every percentile at or above the least of them "
           "(marked \u2265). How far they would have gone is not known; let them run longer "
           "(/mpm/duration).";
}

std::string few_caution(const json& quantity) {
    std::string lacking;
    for (const double p : {5.0, 10.0, 50.0, 90.0, 95.0})
        if (!percentile_in(quantity, p)) lacking += (lacking.empty() ? "p" : ", p") + rounded(p, 2);
    if (lacking.empty()) return "";
    return "Not told for lack of samples: " + lacking + ". " + quantity.at("count").dump() +
           " have a result.";
}

std::string cut_caution(const json& parameters) {
    std::string cut;
    for (const json& each : parameters)
        if (each.value("between", json()).is_array())
            cut += (cut.empty() ? "" : ", ") + each.at("name").get<std::string>();
    if (cut.empty()) return "";
    return "Nothing is drawn outside of the bounds given for " + cut +
           ": what lies beyond them is not rare here but impossible.";
}

std::string until_caution(const json& until) {
    if (!until.is_object() || until.value("reached", json(false)) == json(true)) return "";
    const json now = until.value("now", json());
    return "The study was to go on until p" + rounded(until.at("percentile").get<double>(), 4) +
           " of " + until.value("quantity", "the result") + " is known to \u00b1 " +
           rounded(100.0 * until.at("half_width").get<double>(), 3) + " % of its value; " +
           (now.is_number()
                ? "it is known to \u00b1 " + rounded(100.0 * now.get<double>(), 3) + " %."
                : std::string("so few samples do not tell it at all."));
}

std::string doubt_caution(const Run& run) {
    std::size_t doubtful = 0, unknown = 0;
    for (const PhaseFolder* each : sampled_runouts(run)) {
        if (certainty_of(*each) == Certainty::doubtful) ++doubtful;
        if (certainty_of(*each) == Certainty::unknown) ++unknown;
    }
    std::string text;
    if (doubtful > 0)
        text = std::to_string(doubtful) +
               " samples are questionable for other reasons than motion (table \"Flags\"); they "
               "are counted.";
    if (unknown > 0)
        text += (text.empty() ? "" : " ") + std::to_string(unknown) +
                " carry no flags: what may be wrong with them is not known.";
    return text;
}

std::vector<std::string> cautions_of(const Run& run, const json& quantity) {
    const json& answer = run.uncertainty;
    std::vector<std::string> said{failed_caution(answer.at("samples")),
                                  moving_caution(run),
                                  doubt_caution(run),
                                  few_caution(quantity),
                                  cut_caution(answer.at("parameters")),
                                  until_caution(answer.value("until", json()))};
    if (answer.at("samples").at("open") > 0)
        said.push_back(count_of(answer.at("samples").at("open"), "sample") +
                       " had not ended when this was written: the numbers will change.");
    std::erase(said, "");
    said.emplace_back(
        "Percentiles are over the parameters named below, as they are distributed there, and over "
        "nothing else. What the model leaves out (table of CDA's cases below) is in none of them.");
    return said;
}

// ---------------------------------------------------------------- what fails, when, how far

std::string what_fails(const Run& run) {
    const json& scene = asked_scene(run);
    std::string text = run.title;
    const json liquefied = scene.value("/transfer/liquefied"_json_pointer, json());
    if (liquefied.is_object()) {
        std::string regions;
        for (const json& each : liquefied.value("regions", json::array()))
            regions += (regions.empty() ? "" : ", ") + each.get<std::string>();
        text += "; soil liquefies" + (regions.empty() ? "" : " in " + regions);
    }
    for (const PhaseFolder* each : phases_named(run, phases::fem.program))
        if (const std::string end = entanglement_of(*each); !end.empty()) return text + ". " + end;
    for (const PhaseFolder* each : phases_named(run, phases::lem.program))
        if (each->result.is_object() && each->result.contains("factor_of_safety"))
            return text + "; factor of safety " + fact(each->result, "/factor_of_safety") +
                   (each->variant.empty() ? "." : " (" + each->variant + ").");
    return text + ".";
}

std::string when_it_fails(const Run& run) {
    std::set<double> times;
    for (const PhaseFolder* each : sampled_runouts(run))
        if (each->transfer_time) times.insert(*each->transfer_time);
    if (times.empty())
        return "Not asked: a static scene, whose soil is let go as it stands. Times below count "
               "from then.";
    const std::string first = short_number(*times.begin());
    return "The failing mesh becomes material points at t_T = " + first +
           (times.size() > 1 ? " to " + short_number(*times.rbegin()) : std::string()) +
           " s after the beginning of the shaking. Times below count from t_T.";
}

/// "38.5 (32.6 to 45.5)", marked where it is a lower bound.
std::string percentile_text(const Run& run, const std::string& name, double p) {
    const json& quantity = run.uncertainty.at("quantities").at(name);
    const json* found = percentile_in(quantity, p);
    if (!found) return why_no_percentile(quantity, p);
    const double value = found->at("value");
    return (is_lower_bound(run, name, value) ? at_least : "") + rounded(value, 4) + " (" +
           rounded(found->at("low").get<double>(), 4) + " to " +
           rounded(found->at("high").get<double>(), 4) + ")";
}

std::string known_of(const Run& run, const std::string& name) {
    const json& quantity = run.uncertainty.at("quantities").at(name);
    return quantity.at("count").dump() + " of " + quantity.at("of").dump() + " samples";
}

std::string spread_text(const std::optional<double>& value, bool bound) {
    if (!value) return "not enough samples";
    if (!std::isfinite(*value)) return "not by the end";
    return (bound ? at_least : "") + rounded(*value, 3);
}

/// One fact of the samples' results; absent: what it counts as where it is not there. What grows while
/// soil moves is a lower bound where a sample at or below it was stopped in motion.
std::vector<std::string> fact_row(const Run& run, const std::string& what, const std::string& fact,
                                  double absent, const std::string& came) {
    const json::json_pointer at(fact);
    const Spread spread = spread_of(run, at, absent);
    std::optional<double> least;
    if (absent == 0.0)
        for (const PhaseFolder* each : moving_samples(run)) {
            const json value = each->result.contains(at) ? each->result.at(at) : json();
            least =
                std::min(least.value_or(never), value.is_number() ? value.get<double>() : absent);
        }
    std::vector<std::string> row{what};
    for (const double p : {50.0, 10.0, 90.0}) {
        const auto value = spread.percentile(p);
        row.push_back(spread_text(value, value && least && *least <= *value));
    }
    row.push_back(std::to_string(spread.count) + " of " +
                  run.uncertainty.at("samples").at("planned").dump() + " samples" + came);
    return row;
}

void add_gauges(const Run& run, Table& table) {
    for (const json& gauge : asked_scene(run).value("/mpm/gauges"_json_pointer, json::array())) {
        const std::string name = gauge.at("name"), at = "/gauges/" + name;
        const std::string where =
            "Gauge " + name + " (x = " + short_number(gauge.at("x")) + " m): ";
        table.rows.push_back(fact_row(run, where + "arrival [s]", at + "/arrival_time", never,
                                      ": there the flow came"));
        table.rows.push_back(
            fact_row(run, where + "largest depth [m]", at + "/largest_depth", 0.0, ""));
        table.rows.push_back(
            fact_row(run, where + "largest velocity [m/s]", at + "/largest_velocity", 0.0, ""));
    }
}

void add_sections(const Run& run, Table& table) {
    for (const json& section :
         asked_scene(run).value("/mpm/sections"_json_pointer, json::array())) {
        const std::string name = section.at("name"), at = "/sections/" + name;
        const std::string where =
            "Section " + name + " (x = " + short_number(section.at("x")) + " m): ";
        table.rows.push_back(
            fact_row(run, where + "volume passed [m3 per m of width]", at + "/volume", 0.0, ""));
        table.rows.push_back(fact_row(run, where + "largest discharge [m3/s per m of width]",
                                      at + "/largest_discharge", 0.0, ""));
        // [low, best, high] of the breach's width: the best one.
        if (asked_scene(run).contains("/mpm/breach_width"_json_pointer)) {
            table.rows.push_back(fact_row(run, where + "volume times the breach's width [m3]",
                                          at + "/breach/volume/1", 0.0, ""));
            table.rows.push_back(
                fact_row(run, where + "largest discharge times the breach's width [m3/s]",
                         at + "/breach/largest_discharge/1", 0.0, ""));
        }
    }
}

Table answers_of(const Run& run) {
    Table table{
        "assessment",
        "How far, when, how deep, how fast",
        {"what", "p50", "p10", "p90", "rests on"},
        {},
        "In brackets: the percentile's 90 % interval for so many samples. "
        "\u2265: a lower bound, soil still moved. At a gauge a sample whose flow never came "
        "is 0 deep and arrives after all others."};
    for (const std::string& name : quantities_of(run.uncertainty))
        table.rows.push_back(
            {words_of(name) + unit_in_brackets(run.uncertainty.at("quantities").at(name)),
             percentile_text(run, name, 50), percentile_text(run, name, 10),
             percentile_text(run, name, 90), known_of(run, name)});
    add_gauges(run, table);
    add_sections(run, table);
    return table;
}

// ---------------------------------------------------------------- assumptions and limits

std::string distribution_text(const json& parameter) {
    const json distribution = parameter.value("distribution", json());
    if (parameter.at("kind") == "numerical")
        return "the lattice of material points: the method's own scatter";
    if (!distribution.is_object()) return "one of several, by their weights";
    std::string text = distribution.value("type", "");
    std::ranges::replace(text, '_', ' ');
    for (const auto& [key, value] : distribution.items())
        if (value.is_number()) text += ", " + key + " " + short_number(value.get<double>());
    return text;
}

Table assumptions_of(const Run& run) {
    Table table{"assessment_parameters",
                "What is taken as uncertain",
                {"parameter", "sets", "distribution", "only between", "asked rank correlation"},
                {},
                "All else is as the scene says (chapter of inputs), as if it were known."};
    for (const json& each : run.uncertainty.at("parameters")) {
        std::string sets = each.at("kind") == "factor" ? "a factor on " : "";
        std::size_t told = 0;
        for (const json& entry : each.value("entries", json::array()))
            if (told++ < 3) sets += (told > 1 ? ", " : "") + entry.get<std::string>();
        if (told > 3) sets += " and " + std::to_string(told - 3) + " more";
        if (told == 0) sets = "-";
        std::string between = "-", correlations;
        if (const json bounds = each.value("between", json()); bounds.is_array())
            between = short_number(bounds[0]) + " and " + short_number(bounds[1]);
        const json asked = each.value("asked_correlation", json::object());
        for (const auto& [other, value] : asked.items())
            correlations += (correlations.empty() ? "" : ", ") + other + " " +
                            short_number(value.get<double>());
        table.rows.push_back({each.at("name"), sets, distribution_text(each), between,
                              correlations.empty() ? "-" : correlations});
    }
    return table;
}

Table cases_of(const Run& run) {
    const bool liquefies = asked_scene(run).contains("/transfer/liquefied"_json_pointer);
    return {
        "assessment_cases",
        "Which cases of CDA (2021) this can answer",
        {"case", "free pond at the breach", "tailings liquefy", "covered", "because"},
        {{"1A", "yes", "yes", "no",
          "a pond that erodes the breach and carries tailings away is not in the model"},
         {"1B", "yes", "no", "no", "the same: erosion by water is the process, and it is absent"},
         {"2A", "no", "yes", liquefies ? "yes: this run" : "yes",
          "soil that lost its strength flows as far as that and its viscosity let it"},
         {"2B", "no", "no", liquefies ? "yes" : "yes: this run",
          "a slope that fails and slumps with the strength that it keeps"}},
        "Canadian Dam Association (2021), Technical Bulletin: Tailings Dam Breach Analysis. A "
        "dam with a pond needs an analysis of its release beside this one. Nor is there a "
        "channel or a valley that narrows: plane strain, so that no flow spreads or is "
        "confined sideways, and volumes are per metre of width."};
}

// ---------------------------------------------------------------- error, cost, origin

/// The spread of results beside what one run may be off, and what the samples cost.
Table worth_of(const Run& run, const std::string& name) {
    Table table{"assessment_error",
                "Error against run time",
                {"what", "value", "from"},
                {},
                "An error of the numerics as large as the spread over the parameters would make "
                "the spread meaningless."};
    const json& quantity = run.uncertainty.at("quantities").at(name);
    const json *low = percentile_in(quantity, 10), *high = percentile_in(quantity, 90);
    table.rows.push_back(
        {"spread of " + name + ", p10 to p90" + unit_in_brackets(quantity),
         low && high ? rounded(high->at("value").get<double>() - low->at("value").get<double>(), 3)
                     : "not known",
         low && high ? "the samples" : why_no_percentile(quantity, 90)});
    double error = 0.0, cpu = 0.0;
    std::string from;
    const auto samples = sampled_runouts(run);
    std::size_t known = 0;
    for (const PhaseFolder* each : samples) {
        cpu += each->result.value("cpu_seconds", 0.0);
        if (from.empty()) from = each->runout_error_from;
        if (!each->runout_error) continue;
        error = std::max(error, *each->runout_error);
        ++known;
        from = each->runout_error_from;
    }
    table.rows.push_back(
        {"error of one run's runout, the largest told [m]", known ? rounded(error, 3) : "not known",
         (known ? std::to_string(known) + " of " + std::to_string(samples.size()) + " samples: "
                : std::string()) +
             (from.empty() ? "no accuracy study of an equal scene (breach accuracy)" : from)});
    table.rows.push_back(
        {"CPU seconds of one sample's runout, mean",
         samples.empty() ? "-" : rounded(cpu / static_cast<double>(samples.size()), 3),
         "the results, also of those taken from an earlier run"});
    table.rows.push_back({"CPU seconds of all samples' runouts", rounded(cpu, 4), "the same"});
    return table;
}

Table origin_of(const Run& run) {
    Table table{"assessment_origin",
                "Where every number comes from",
                {"what", "which"},
                {},
                "Of each sample the export holds settings, logs and files with their SHA-256 "
                "(tasks/, ro-crate-metadata.json)."};
    if (!run.id.empty()) table.rows.push_back({"run", run.id + ", " + run.name});
    std::map<std::string, std::set<std::string>> versions;
    for (const PhaseFolder& each : run.phases) {
        if (!each.result.is_object()) continue;
        const json version = each.result.value("/provenance/version"_json_pointer, json());
        versions[each.phase].insert(version.is_string() ? version.get<std::string>() : "not told");
    }
    for (const auto& [phase, known] : versions) {
        std::string text;
        for (const std::string& each : known) text += (text.empty() ? "" : "; ") + each;
        table.rows.push_back({phase, text});
    }
    const json& answer = run.uncertainty;
    const json sampling = answer.value("sampling", json());
    table.rows.push_back(
        {"samples", (sampling.is_string() ? sampling.get<std::string>() : "not told") + ", seed " +
                        answer.value("seed", json("not told")).dump()});
    for (const char* file : {"study.json", "uncertainty.json", "envelopes.json", "results.json"})
        if (const auto path = run.folder / file; std::filesystem::is_regular_file(path))
            table.rows.push_back({std::string(file) + ", SHA-256", exchange::sha256_of_file(path)});
    return table;
}

// ---------------------------------------------------------------- figures and tables behind it

/// What is published of the case stands in the figure, too.
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
    if (!grows(quantity)) return least;
    for (const PhaseFolder* each : moving_samples(run))
        if (const json value = each->result.value(quantity, json()); value.is_number())
            least = std::min(least.value_or(never), value.get<double>());
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
                      "Sample " + nearest.variant + ", with " + name + " = " +
                          bounded(nearest, rounded(nearest.result.at(name).get<double>(), 4)) +
                          ": one run, no envelope. The hydrograph of a percentile of the runout "
                          "is not the percentile of the hydrographs."};
        for (const json& section :
             asked_scene(run).value("/mpm/sections"_json_pointer, json::array())) {
            const std::string of = section.at("name");
            const auto found = archive.reals.find("section." + of + ".discharge");
            if (found == archive.reals.end() || found->second.size() != times->second.size())
                continue;
            figure.chart.series.push_back({of, times->second, found->second, Style::line});
        }
        if (!figure.chart.series.empty()) chapter.figures.push_back(std::move(figure));
    }
}

std::string or_dash(const json& value, int digits = 3) {
    return value.is_number() ? rounded(value.get<double>(), digits) : "-";
}

Table percentile_table(const Run& run) {
    Table table{
        "assessment_percentiles",
        "Percentiles",
        {"quantity", "samples", "mean", "standard deviation", "p5", "p10", "p50", "p90", "p95"},
        {},
        "In brackets: 90 % intervals for so many samples. Mean and standard "
        "deviation of distances that are lower bounds in part are too small."};
    for (const std::string& name : quantities_of(run.uncertainty)) {
        const json& quantity = run.uncertainty.at("quantities").at(name);
        const bool bound = grows(name) && !moving_samples(run).empty();
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

std::string ends_of(const json& each, const char* low, const char* high) {
    if (!each.value(low, json()).is_number()) return "-";
    return or_dash(each.at(low), 2) + " to " + or_dash(each.at(high), 2);
}

Table importance_table(const json& quantity, const std::string& name) {
    Table table{"assessment_importance",
                "What decides " + name,
                {"parameter", "rank correlation", "its interval", "partial",
                 "share of the variance", "its interval"},
                {},
                "An interval with 0 in it: not told from a parameter that does nothing. The share "
                "is what the parameter explains alone. Options of a choice and lattices have no "
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
        const bool bound = grows(name) && value != "-" &&
                           std::ranges::any_of(moving, [&](const PhaseFolder* each) {
                               return each->variant == row.at("sample");
                           });
        cells.push_back((bound ? at_least : "") + value);
        table.rows.push_back(std::move(cells));
    }
    return table;
}

Chapter first_page(const Run& run, const std::string& name) {
    const json& answer = run.uncertainty;
    const json& samples = answer.at("samples");
    Chapter chapter{"Dam-breach assessment",
                    "From " + samples.at("done").dump() + " of " +
                        count_of(samples.at("planned"), "sample") + " of " +
                        count_of(answer.at("parameters").size(), "uncertain parameter") + "."};
    chapter.opens_page = true;
    chapter.cautions = cautions_of(run, answer.at("quantities").at(name));
    chapter.tables = {{"assessment_what",
                       "What fails, and when",
                       {"question", "answer"},
                       {{"What fails", what_fails(run)}, {"When", when_it_fails(run)}},
                       ""},
                      answers_of(run),
                      assumptions_of(run),
                      cases_of(run),
                      worth_of(run, name),
                      origin_of(run)};
    if (const json inverse = answer.value("inverse", json()); inverse.is_object())
        chapter.tables.front().rows.push_back(
            {"Back-analysis", inverse.value("vary", "") + " = " + or_dash(inverse.at("value"), 4) +
                                  " (" + ends_of(inverse, "low", "high") + ") gives " +
                                  or_dash(inverse.at("target"), 4)});
    return chapter;
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

void add_assessment(const Material& from, Document& document) {
    const Run& run = from.run;
    if (!has_samples(run)) {
        if (run.study.is_object() && run.study.contains("uncertainty"))
            document.left_out.push_back(
                {"dam-breach assessment",
                 "the folder has no uncertainty.json: export the run again"});
        return;
    }
    const auto names = quantities_of(run.uncertainty);
    if (names.empty()) {
        document.left_out.push_back({"dam-breach assessment", "no sample has a result"});
        return;
    }
    const std::string& name = names.front();
    const json& quantity = run.uncertainty.at("quantities").at(name);
    const std::string label = words_of(name) + unit_in_brackets(quantity);
    document.chapters.push_back(first_page(run, name));
    Chapter chapter{"What the assessment rests on"};
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
    document.chapters.push_back(std::move(chapter));
}

std::optional<std::vector<std::string>> sampled_answer(const Run& run) {
    if (!has_samples(run)) return {};
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
