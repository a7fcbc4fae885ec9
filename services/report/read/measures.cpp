#include "services/report/read/measures.hpp"

#include <algorithm>
#include <cmath>

#include "core/fault/fault.hpp"
#include "core/phases/files.hpp"
#include "core/phases/phases.hpp"
#include "services/findings/governing.hpp"
#include "services/report/chart/axis.hpp"
#include "services/report/read/verdict.hpp"

namespace breach::report {

using nlohmann::json;

namespace {

constexpr double runs_out = 1.0;   // smaller runouts count as none [m]
constexpr double same_time = 0.1;  // between requested and computed transfer times [s]

std::optional<double> number_at(const json& result, const char* key) {
    if (!result.is_object() || !result.contains(key) || !result.at(key).is_number()) return {};
    return result.at(key).get<double>();
}

double cpu_of(const PhaseFolder& phase) {
    return number_at(phase.result, "cpu_seconds").value_or(0.0);
}

void measure_stability(const Run& run, Measures& found) {
    const PhaseFolder* lem = phase_shown(run, phases::lem.program);
    if (!lem || !lem->result.is_object()) return;
    const auto slices = number_at(lem->result, "slices");
    const std::string error = slices ? short_number(*slices) + " slices" : "";
    const auto keep = [&](const std::string& key, std::optional<double> value) {
        if (value) found[key] = {*value, lem->label, cpu_of(*lem), error};
    };
    keep("factor_of_safety_intact", number_at(lem->result, "factor_of_safety"));
    keep("depth_at_fs_1", number_at(lem->result, "depth_at_fs_1"));
    keep("critical_depth", number_at(lem->result, "critical_depth"));
    const json stages = lem->result.value("stages", json::array());
    if (!stages.empty()) {
        keep("factor_of_safety_liquefied", number_at(stages.back(), "factor_of_safety"));
    }
}

/// Time of entanglement; for a result without it, the last line of telemetry.
std::optional<double> entangled_at(const PhaseFolder& fem, const Telemetry& telemetry) {
    if (fem.result.is_object()) {
        if (fem.result.value("ended", "") != "entangled") return {};
        return number_at(fem.result.value("entanglement", json::object()), "time");
    }
    if (fem.fault.find("entangled") == std::string::npos || telemetry.lines().empty()) return {};
    return telemetry.lines().back().time;
}

void measure_shaking(const Run& run, const std::optional<Paper>& paper, Measures& found) {
    const PhaseFolder* fem = phase_shown(run, phases::fem.program);
    if (!fem || !has_telemetry(*fem)) return;
    const Telemetry telemetry = telemetry_of(run, *fem);
    const auto keep = [&](const std::string& key, std::optional<double> time) {
        if (time) found[key] = {*time, fem->label, cpu_of(*fem), "telemetry interval"};
    };
    for (const PaperValue& each : paper ? paper->values : std::vector<PaperValue>{}) {
        if (!each.first_time.empty()) keep(each.key, telemetry.first_time(each.first_time));
    }
    keep("time_entangled", entangled_at(*fem, telemetry));
    const WindowEdges window = window_of(run, telemetry);
    keep("window_lower", window.lower);
    keep("window_upper", window.upper);
}

void measure_paper_times(const std::vector<const PhaseFolder*>& runouts, const std::string& suffix,
                         const Paper& paper, Measures& found) {
    for (const PaperValue& value : paper.values) {
        const bool mine =
            suffix.empty() ? value.key.find(':') == std::string::npos : value.key.ends_with(suffix);
        if (!value.runout_at || !mine) continue;
        for (const PhaseFolder* each : runouts) {
            if (std::abs(each->transfer_time.value_or(0.0) - *value.runout_at) >= same_time) {
                continue;
            }
            found[value.key] = {runout_of(each), each->label, cpu_of(*each),
                                "see the table of runouts", still_moves(*each)};
        }
    }
}

void measure_runout(const Run& run, const std::string& variant, const std::optional<Paper>& paper,
                    Measures& found) {
    const std::string suffix = variant.empty() ? "" : ":" + variant;
    const auto all = runouts_of(run, variant);
    if (is_static(run)) return;  // no transfer times, no plateau
    if (paper) measure_paper_times(all, suffix, *paper, found);
    bool begun = false;
    for (const PhaseFolder* each : all) {
        const double runout = runout_of(each), t_T = each->transfer_time.value_or(0.0);
        if (!begun && runout > runs_out) {
            begun = true;
            found["first_runout_time" + suffix] = {t_T, each->label, cpu_of(*each),
                                                   "spacing of t_T"};
        }
    }
    const auto plateau = plateau_of(run, variant);
    if (!plateau) return;
    std::vector<double> runouts, released;
    const auto moving = std::ranges::count_if(
        plateau->runouts, [](const PhaseFolder* each) { return still_moves(*each); });
    double cpu = 0.0;
    for (const PhaseFolder* each : plateau->runouts) {
        runouts.push_back(runout_of(each));
        if (const auto area = number_at(each->result, "area_beyond_toe")) released.push_back(*area);
        cpu += cpu_of(*each);
    }
    const auto keep_median = [&](const std::string& key, const std::vector<double>& values) {
        if (values.empty()) return;
        const auto [least, most] = std::ranges::minmax(values);
        found[key + suffix] = {
            median(values),
            "median of " + std::to_string(values.size()) + " runouts",
            cpu,
            "they lie between " + short_number(least) + " and " + short_number(most) +
                (moving > 0 ? "; " + std::to_string(moving) + " still moving" : ""),
            moving > 0,
            least,
            most};
    };
    keep_median("plateau_runout", runouts);
    keep_median("released_area", released);
    const std::string of = "runouts of at least 75 % of the largest";
    found["plateau_begin" + suffix] = {plateau->first, of, cpu, "spacing of t_T"};
    found["plateau_end" + suffix] = {plateau->last, of, cpu, "spacing of t_T"};
}

double largest_runout(const std::vector<const PhaseFolder*>& runouts) {
    double largest = 0.0;
    for (const PhaseFolder* each : runouts) largest = std::max(largest, runout_of(each));
    return largest;
}

/// Outermost transfer times around the largest runout that belong to the plateau.
Plateau edges_in(const std::vector<const PhaseFolder*>& runouts) {
    const auto top = std::ranges::max_element(runouts, {}, runout_of);
    const double level = plateau_share * runout_of(*top);
    auto first = top, last = top;
    while (first != runouts.begin() && runout_of(*(first - 1)) >= level) --first;
    while (last + 1 != runouts.end() && runout_of(*(last + 1)) >= level) ++last;
    return Plateau{(*first)->transfer_time.value_or(0.0), (*last)->transfer_time.value_or(0.0)};
}

/// Error of a ratio of two runouts with their spreads.
std::string error_of_ratio(const Measure& over, const Measure& under) {
    if (over.lower_bound || under.lower_bound) return "soil still moved: neither bound nor value";
    if (under.least <= runs_out) {
        return "says nothing: the smaller runouts go down to " + short_number(under.least) + " m";
    }
    return "between " + rounded(over.least / under.most, 3) + " and " +
           rounded(over.most / under.least, 3) + " by the runouts of either";
}

}  // namespace

double runout_of(const PhaseFolder* mpm) { return mpm->result.at("runout"); }

double median(std::vector<double> values) {
    std::ranges::sort(values);
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

/// The phase of this name that a runout came from; null: unknown.
static const PhaseFolder* phase_behind(const Run& run, const PhaseFolder* runout,
                                       const std::string& phase) {
    while (runout && runout->phase != phase) runout = source_of(run, *runout);
    return runout;
}

/// The FEM without a transfer of this variant, from the service; null: unknown.
static const PhaseFolder* fem_without_transfer(const Run& run, const std::string& variant) {
    for (const json& each : run.without_transfer) {
        if (each.at("variant") != variant) continue;
        const auto fem =
            std::ranges::find(run.phases, each.value("fem_task", ""), &PhaseFolder::task);
        return fem == run.phases.end() || fem->task.empty() ? nullptr : &*fem;
    }
    return nullptr;
}

const PhaseFolder* phase_of_variant(const Run& run, const std::string& phase,
                                    const std::string& variant) {
    const auto all = phases_named(run, phase);
    for (const PhaseFolder* each : all) {
        if (each->variant == variant || each->variant.empty()) return each;
    }
    if (all.size() == 1) return all.front();
    for (const char* later : {phases::mpm.program, phases::transfer.program})
        for (const PhaseFolder* each : phases_named(run, later)) {
            if (each->variant != variant) continue;
            if (const PhaseFolder* behind = phase_behind(run, each, phase)) return behind;
        }
    return phase == phases::fem.program ? fem_without_transfer(run, variant) : nullptr;
}

const PhaseFolder* farthest_runout(const Run& run) {
    std::vector<const PhaseFolder*> runouts;
    for (const std::string& variant : variants_of(run))
        for (const PhaseFolder* each : runouts_of(run, variant)) runouts.push_back(each);
    std::vector<findings::Candidate> candidates;
    for (const PhaseFolder* each : runouts) candidates.push_back({.runout = runout_of(each)});
    for (const json& mean : run.means) {
        if (!mean.at("runout").is_number()) continue;
        for (const PhaseFolder* draw : draws_of(run, mean))
            if (const auto place = std::ranges::find(runouts, draw); place != runouts.end())
                candidates[static_cast<std::size_t>(place - runouts.begin())].mean_runout =
                    mean.at("runout").get<double>();
    }
    const auto place = findings::governing(candidates);
    return place ? runouts[*place] : nullptr;
}

const PhaseFolder* least_factor(const Run& run) {
    const PhaseFolder* least = nullptr;
    const auto factor_of = [](const PhaseFolder* each) {
        return number_at(each->result, "factor_of_safety");
    };
    for (const PhaseFolder* each : phases_named(run, phases::lem.program))
        if (factor_of(each) && (!least || *factor_of(each) < *factor_of(least))) least = each;
    return least;
}

/// Null: the run has no runout, or its source is unknown.
static const PhaseFolder* behind_farthest(const Run& run, const std::string& phase) {
    const PhaseFolder* farthest = farthest_runout(run);
    if (!farthest) return nullptr;
    const PhaseFolder* behind = phase_behind(run, farthest, phase);
    return behind ? behind : phase_of_variant(run, phase, farthest->variant);
}

const PhaseFolder* phase_shown(const Run& run, const std::string& phase) {
    const PhaseFolder* behind = behind_farthest(run, phase);
    return behind ? behind : phase_named(run, phase);
}

std::string which_of_several(const Run& run, const PhaseFolder& shown, const std::string& plural) {
    const std::size_t count = phases_named(run, shown.phase).size();
    if (count < 2) return "";
    return "Of " + std::to_string(count) + " " + plural + " the " +
           (behind_farthest(run, shown.phase) ? "one behind the farthest runout: " : "first: ") +
           (shown.variant.empty() ? shown.label : shown.variant) + ". ";
}

Telemetry telemetry_of(const Run& run, const PhaseFolder& fem) {
    const PhaseFolder* lem = phase_of_variant(run, phases::lem.program, fem.variant);
    std::map<std::string, double> beside;
    if (const auto depth = lem ? number_at(lem->result, "critical_depth") : std::nullopt) {
        beside["critical_depth"] = *depth;
    }
    return Telemetry(fem.files / phases::files::telemetry, std::move(beside));
}

std::optional<Plateau> plateau_of(const Run& run, const std::string& variant) {
    const PhaseFolder* fem = phase_of_variant(run, phases::fem.program, variant);
    std::optional<Plateau> plateau;
    double farthest = 0.0;
    for (const std::string& each : variants_of(run)) {
        if (phase_of_variant(run, phases::fem.program, each) != fem) continue;
        const auto runouts = runouts_of(run, each);
        const double largest = largest_runout(runouts);
        if (largest <= farthest) continue;
        farthest = largest;
        plateau = edges_in(runouts);
    }
    if (!plateau) return {};
    for (const PhaseFolder* each : runouts_of(run, variant)) {
        const double t_T = each->transfer_time.value_or(0.0);
        if (t_T >= plateau->first && t_T <= plateau->last) plateau->runouts.push_back(each);
    }
    return plateau;
}

std::vector<const PhaseFolder*> runouts_of(const Run& run, const std::string& variant) {
    std::vector<const PhaseFolder*> found;
    for (const PhaseFolder* each : phases_named(run, phases::mpm.program)) {
        if (each->variant == variant && number_at(each->result, "runout")) found.push_back(each);
    }
    return found;
}

std::vector<std::string> variants_of(const Run& run) {
    std::vector<std::string> names;
    for (const PhaseFolder* each : phases_named(run, phases::mpm.program)) {
        if (std::ranges::find(names, each->variant) == names.end()) names.push_back(each->variant);
    }
    if (!run.study.is_object()) return names;
    const json listed = run.study.value("variants", json::array());
    std::ranges::stable_sort(names, {}, [&](const std::string& name) {
        return std::ranges::find_if(listed, [&](const json& v) { return v.at("name") == name; }) -
               listed.begin();
    });
    return names;
}

WindowEdges window_of(const Run& run, const Telemetry& fem) {
    json spec;
    if (run.study.is_object()) {
        for (const json& each : run.study.value("triggers", json::array())) {
            if (each.value("kind", "") == "window" && spec.is_null()) spec = each;
        }
    }
    if (spec.is_null() && run.scene.contains("transfer")) {
        spec = run.scene.at("transfer").value("window", json());
    }
    if (!spec.is_object()) return {};
    const auto condition = [&](const char* edge) {
        return criteria::parse(spec.at(edge).get<std::string>(), criteria::Kind::condition,
                               std::string("/window/") + edge);
    };
    criteria::Window window(condition("lower"), condition("upper"), spec.value("hold_s", 0.0));
    fem.show_to(window);
    const auto time_of = [](const std::optional<criteria::Line>& line) {
        return line ? std::optional(line->time) : std::nullopt;
    };
    const bool developed = window.lower().state() == criteria::Criterion::State::met;
    const auto shut = time_of(window.shut_since());
    return {developed ? time_of(window.lower().crossing()) : std::nullopt,
            shut ? shut : time_of(window.upper_edge())};
}

WindowEdges window_in(const Measures& measures) {
    const auto edge = [&](const char* key) {
        const auto found = measures.find(key);
        return found == measures.end() ? std::nullopt : std::optional(found->second.value);
    };
    return {edge("window_lower"), edge("window_upper")};
}

std::vector<Threshold> thresholds_in(const Run& run) {
    std::vector<std::string> conditions;
    const auto add = [&](const json& spec) {
        for (const char* key : {"when", "lower", "upper"}) {
            if (spec.is_object() && spec.contains(key)) conditions.push_back(spec.at(key));
        }
    };
    const json triggers =
        run.study.is_object() ? run.study.value("triggers", json::array()) : json();
    for (const json& each : triggers) add(each);
    if (conditions.empty() && run.scene.contains("transfer")) {
        add(run.scene.at("transfer").value("window", json()));
    }
    std::vector<Threshold> found;
    for (const std::string& text : conditions) {
        const auto condition = criteria::parse(text, criteria::Kind::condition, "/triggers");
        const auto& steps = condition.program;
        for (std::size_t k = 0; k + 2 < steps.size(); ++k) {
            using Code = criteria::Instruction::Code;
            const Code what = steps[k + 2].code;
            if (what != Code::less && what != Code::less_equal && what != Code::greater &&
                what != Code::greater_equal) {
                continue;
            }
            std::size_t field = k, number = k + 1;
            if (steps[field].code != Code::field) std::swap(field, number);
            if (steps[field].code != Code::field || steps[number].code != Code::constant) continue;
            const std::string& name = condition.fields[steps[field].index];
            if (name != "time") found.push_back({name, steps[number].value});
        }
    }
    return found;
}

Measures measures_of(const Run& run, const std::optional<Paper>& paper) {
    Measures found;
    measure_stability(run, found);
    measure_shaking(run, paper, found);
    for (const std::string& variant : variants_of(run)) {
        measure_runout(run, variant, paper, found);
    }
    const auto softened = found.find("plateau_runout:softened");
    const auto strong = found.find("plateau_runout:not_softened");
    if (softened != found.end() && strong != found.end() && strong->second.value > runs_out) {
        found["plateau_ratio"] = {softened->second.value / strong->second.value, "both variants",
                                  softened->second.cpu_seconds + strong->second.cpu_seconds,
                                  error_of_ratio(softened->second, strong->second)};
    }
    return found;
}

Table comparison(const Paper& paper, const Measures& ours) {
    Table table{"comparison",
                "The paper's numbers beside ours",
                {"quantity", "unit", "paper", "here", "here / paper", "from", "error", "CPU s"},
                {},
                "Paper: " + paper.source +
                    ". Plateau here: the transfer times around the largest runout of the variant "
                    "that runs farthest, as long as they give 75 % of it; its runout is their "
                    "median. Window: from the criteria and the FEM's telemetry."};
    for (const PaperValue& each : paper.values) {
        std::vector<std::string> row = {each.what, each.unit, short_number(each.value)};
        if (const auto it = ours.find(each.key); it != ours.end()) {
            const Measure& m = it->second;
            const std::string bound = m.lower_bound ? at_least : "";
            row.insert(row.end(),
                       {bound + short_number(m.value),
                        each.value == 0.0 ? "-" : bound + rounded(m.value / each.value, 3),
                        m.source, m.error, rounded(m.cpu_seconds, 3)});
        } else {
            row.insert(row.end(), {"-", "-", "not in this run", "", ""});
        }
        table.rows.push_back(std::move(row));
    }
    return table;
}

}  // namespace breach::report
