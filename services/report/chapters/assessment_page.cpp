// The page for a regulator: what fails, when, how far, arrival and depth, each with its spread and
// basis; and the limits of the analysis.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "core/exchange/provenance.hpp"
#include "core/phases/phases.hpp"
#include "services/report/chapters/assessment.hpp"
#include "services/report/read/samples.hpp"
#include "services/report/read/verdict.hpp"

namespace breach::report {

using nlohmann::json;
using namespace nlohmann::literals;

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

// ---------------------------------------------------------------- what fails, when, how far

/// "; factor of safety 0.95 to 1.42 (63 of 64 analyses)"; empty: none is known.
std::string safety_of(const Run& run) {
    const auto all = phases_named(run, phases::lem.program);
    std::multiset<double> factors;
    for (const PhaseFolder* each : all) {
        const json factor =
            each->result.is_object() ? each->result.value("factor_of_safety", json()) : json();
        if (factor.is_number()) factors.insert(factor.get<double>());
    }
    if (factors.empty()) return "";
    const std::string before = "; factor of safety ";
    if (all.size() == 1)
        return before + fact(all.front()->result, "/factor_of_safety") +
               (all.front()->variant.empty() ? "" : " (" + all.front()->variant + ")");
    const std::string largest = factors.size() > 1 ? " to " + rounded(*factors.rbegin(), 4) : "";
    return before + rounded(*factors.begin(), 4) + largest + " (" + std::to_string(factors.size()) +
           " of " + std::to_string(all.size()) + " analyses)";
}

std::string what_fails(const Run& run) {
    const json& scene = run.scene;
    std::string text = run.title;
    const json liquefied = scene.value("/transfer/liquefied"_json_pointer, json());
    if (liquefied.is_object()) {
        std::string regions;
        for (const json& each : liquefied.value("regions", json::array()))
            regions += (regions.empty() ? "" : ", ") + each.get<std::string>();
        text += "; soil liquefies" + (regions.empty() ? "" : " in " + regions);
    }
    const std::string end = entanglements_of(phases_named(run, phases::fem.program));
    return end.empty() ? text + safety_of(run) + "." : text + ". " + end;
}

std::string when_it_fails(const Run& run) {
    std::set<double> times;
    for (const PhaseFolder* each : sampled_runouts(run))
        if (each->transfer_time) times.insert(*each->transfer_time);
    if (times.empty())
        return "Not applicable: a static scene. Times below count from the start of the runout.";
    const std::string first = short_number(*times.begin());
    return "The failing mesh becomes material points at t_T = " + first +
           (times.size() > 1 ? " to " + short_number(*times.rbegin()) : std::string()) +
           " s after the beginning of the " + (is_shaken(run) ? "shaking" : "dynamic analysis") +
           ". Times below count from t_T.";
}

std::string spread_text(const std::optional<double>& value, bool bound) {
    if (!value) return "not enough samples";
    if (!std::isfinite(*value)) return "not by the end";
    return (bound ? at_least : "") + rounded(*value, 3);
}

/// A row for one entry of the samples' results. absent: value of a missing entry. An entry that
/// grows while soil moves is a lower bound where a sample at or below it still moved.
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
    for (const json& gauge : run.scene.value("/mpm/gauges"_json_pointer, json::array())) {
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

/// "30 m (20 to 50 m)": one number, or [low, best, high].
std::string breach_text(const json& width) {
    if (!width.is_array()) return short_number(width) + " m";
    return short_number(width[1]) + " m (" + short_number(width[0]) + " to " +
           short_number(width[2]) + " m)";
}

void add_sections(const Run& run, Table& table) {
    const json& scene = run.scene;
    const json width = scene.value("/mpm/breach_width"_json_pointer, json());
    for (const json& section : scene.value("/mpm/sections"_json_pointer, json::array())) {
        const std::string name = section.at("name"), at = "/sections/" + name;
        const std::string where =
            "Section " + name + " (x = " + short_number(section.at("x")) + " m): ";
        table.rows.push_back(
            fact_row(run, where + "volume passed [m3 per m of width]", at + "/volume", 0.0, ""));
        table.rows.push_back(fact_row(run, where + "largest discharge [m3/s per m of width]",
                                      at + "/largest_discharge", 0.0, ""));
        if (width.is_null()) continue;
        const std::string times = " through a breach of " + breach_text(width);
        table.rows.push_back(
            fact_row(run, where + "volume" + times + " [m3]", at + "/breach/volume/1", 0.0, ""));
        table.rows.push_back(fact_row(run, where + "largest discharge" + times + " [m3/s]",
                                      at + "/breach/largest_discharge/1", 0.0, ""));
    }
}

Table answers_of(const Run& run) {
    Table table{
        "assessment",
        "How far, when, how deep, how fast",
        {"what", "p50", "p10", "p90", "rests on"},
        {},
        "In brackets: the percentile's 90 % interval. "
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
    const bool liquefies = run.scene.contains("/transfer/liquefied"_json_pointer);
    const bool keeps = !liquefies && !is_static(run);
    return {
        "assessment_cases",
        "Which cases of CDA (2021) this can answer",
        {"case", "free pond at the breach", "tailings liquefy", "covered", "because"},
        {{"1A", "yes", "yes", "no",
          "a pond that erodes the breach and carries tailings away is not in the model"},
         {"1B", "yes", "no", "no", "the same: erosion by water is the process, and it is absent"},
         {"2A", "no", "yes", liquefies ? "yes: this run" : "yes",
          "liquefied soil flows until its residual strength and viscosity stop it"},
         {"2B", "no", "no", keeps ? "yes: this run" : "yes",
          "a slope that fails and slumps with the strength that it keeps"}},
        std::string(liquefies || keeps
                        ? ""
                        : "Whether this static scene is 2A or 2B depends on whether its strengths "
                          "are those of liquefied soil, which the scene does not state. ") +
            "Canadian Dam Association (2021), Technical Bulletin: Tailings Dam Breach Analysis. "
            "A dam with a pond needs an analysis of its release beside this one. Nor is there a "
            "channel or a valley that narrows: plane strain, so that no flow spreads or is "
            "confined sideways, and volumes are per metre of width."};
}

// ---------------------------------------------------------------- error, cost, origin

/// The spread of results beside the error of one run, and the cost of the samples.
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
        {"largest known error of one runout [m]", known ? rounded(error, 3) : "not known",
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

}  // namespace

Chapter assessment_page(const Run& run, const std::string& name) {
    const json& answer = run.uncertainty;
    const json& samples = answer.at("samples");
    Chapter chapter{"Dam-breach assessment",
                    "From " + samples.at("done").dump() + " of " +
                        count_of(samples.at("planned"), "sample") + " of " +
                        count_of(answer.at("parameters").size(), "uncertain parameter") + "."};
    chapter.opens_page = true;
    for (const json& each : answer.at("cautions")) chapter.cautions.push_back(each);
    chapter.cautions.emplace_back(
        "Percentiles are over the parameters named below, as they are distributed there, and over "
        "nothing else. They leave out what the model leaves out (table of CDA's cases below).");
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
    return chapter;
}

}  // namespace breach::report
