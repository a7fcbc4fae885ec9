#include "services/report/read/verdict.hpp"

#include <algorithm>
#include <set>

#include "core/phases/phases.hpp"
#include "services/findings/flags.hpp"
#include "services/findings/verdict.hpp"
#include "services/report/chart/axis.hpp"

namespace breach::report {

using fault::Flag;
using fault::Severity;
using findings::listed;
using nlohmann::json;

namespace {

bool is_entangled(const PhaseFolder& phase) {
    return phase.result.is_object() && phase.result.value("ended", "") == "entangled";
}

/// ", x = 34.1 m"; empty: the number is missing.
std::string with(const json& facts, const char* key, const std::string& name,
                 const std::string& unit, double in_si = 1.0) {
    if (!facts.contains(key) || !facts.at(key).is_number()) return "";
    return ", " + name + rounded(facts.at(key).get<double>() / in_si, 4) + unit;
}

/// Null: unknown.
json time_of_entanglement(const PhaseFolder& fem) {
    const json facts = fem.result.value("entanglement", json::object());
    return facts.value("time", fem.result.value("end_time", json()));
}

/// "entangled at 6.7 s in element 212 (region tailings, x = 34.1 m, y = 12 m)".
std::string entangled_where(const PhaseFolder& fem) {
    const json facts = fem.result.value("entanglement", json::object());
    const json time = time_of_entanglement(fem);
    std::string text = "entangled";
    if (time.is_number()) text += " at " + short_number(time) + " s";
    if (facts.contains("element")) text += " in element " + facts.at("element").dump();
    std::string place;
    if (facts.value("region", json()).is_string()) {
        place = ", region " + facts.at("region").get<std::string>();
    }
    place += with(facts, "x", "x = ", " m") + with(facts, "y", "y = ", " m");
    return place.empty() ? text : text + " (" + place.substr(2) + ")";
}

bool is_corner(const PhaseFolder& fem) {
    return fem.result.value("entanglement", json::object()).value("kind", "") == "corner";
}

std::string kind_of(const PhaseFolder& fem) {
    if (is_corner(fem)) return "at one bad corner, not in a failure's band";
    const json facts = fem.result.value("entanglement", json::object());
    return facts.value("kind", "") == "band" ? "in the failure's band" : "";
}

bool has_result(const PhaseFolder* phase) { return phase->result.is_object(); }

/// Each flag of each phase, with the number of results that have it.
std::vector<findings::Raised> raised_in(const Run& run) {
    std::vector<findings::Raised> raised;
    for (const PhaseFolder& phase : run.phases) {
        std::set<std::pair<std::string, Severity>> counted;  // once per result
        for (const Flag& flag : findings::flags_of(phase.result)) {
            if (!counted.insert({flag.code, flag.severity}).second) continue;
            const auto same = std::ranges::find_if(raised, [&](const findings::Raised& each) {
                return each.phase == phase.phase && each.flag.code == flag.code &&
                       each.flag.severity == flag.severity;
            });
            if (same != raised.end()) {
                ++same->results;
                if (phase.label < same->first) {
                    same->flag = flag;
                    same->first = phase.label;
                }
                continue;
            }
            const auto all = phases_named(run, phase.phase);
            raised.push_back(
                {flag, phase.phase, 1, std::ranges::count_if(all, has_result), phase.label});
        }
    }
    return raised;
}

/// Excludes samples: some are expected to fail, and their share is the result.
std::optional<findings::Unstable> unstable_in(const Run& run) {
    if (run.study.is_object() &&
        (run.study.contains("uncertainty") || run.study.value("known_failure", false)))
        return std::nullopt;
    findings::Unstable found{0, 0, 1.0, ""};
    for (const PhaseFolder* each : phases_named(run, phases::lem.program)) {
        if (!has_result(each)) continue;
        ++found.of_analyses;
        const json factor = each->result.value("factor_of_safety", json());
        if (!factor.is_number() || factor >= 1.0) continue;
        ++found.analyses;
        if (factor < found.least) {
            found.least = factor;
            found.variant = each->variant;
        }
    }
    return found.analyses > 0 ? std::optional(found) : std::nullopt;
}

std::optional<findings::Early> early_in(const Run& run) {
    findings::Early found{0, 0, 0.0, 0.0};
    for (const PhaseFolder* each : phases_named(run, phases::transfer.program)) {
        const PhaseFolder* fem = source_of(run, *each);
        if (!has_result(each) || !fem || !has_result(fem)) continue;
        ++found.of_transfers;
        const json liquefied = fem->result.value("/milestones/liquefied/time"_json_pointer, json());
        if (!liquefied.is_number() || !each->transfer_time || *each->transfer_time >= liquefied)
            continue;
        if (found.transfers++ > 0 && found.first <= *each->transfer_time) continue;
        found.first = *each->transfer_time;
        found.liquefied_at = liquefied;
    }
    return found.transfers > 0 ? std::optional(found) : std::nullopt;
}

std::vector<findings::Broken> broken_in(const Run& run) {
    std::vector<findings::Broken> broken;
    for (const phases::Phase& phase : phases::all) {
        const auto all = phases_named(run, phase.program);
        const auto without =
            all.size() - static_cast<std::size_t>(std::ranges::count_if(all, has_result));
        if (without == 0) continue;
        const PhaseFolder* first = nullptr;
        for (const PhaseFolder* each : all)
            if (!has_result(each) && (!first || each->label < first->label)) first = each;
        broken.push_back({phase.program, static_cast<std::int64_t>(without),
                          static_cast<std::int64_t>(all.size()), first->fault});
    }
    return broken;
}

findings::Facts facts_of(const Run& run) {
    findings::Facts facts{
        .state = run.state,
        .submitted = findings::flags_in(run.warnings),
        .raised = raised_in(run),
        .unstable = unstable_in(run),
        .has_runout = std::ranges::any_of(phases_named(run, phases::mpm.program), has_result),
        .early = early_in(run),
        .broken = broken_in(run),
        .same_results = run.same_results};
    for (const json& each : run.without_transfer)
        facts.without_transfer.push_back(
            {each.value("variant", ""), each.value("stood", false), each.value("reason", "")});
    for (const json& each : run.not_reached)
        facts.without_transfer.push_back(
            {each.at("variant"), false, each.value("reason", ""), "/transfer_times"});
    return facts;
}

std::string capital(std::string text) {
    if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] += 'A' - 'a';
    return text;
}

}  // namespace

bool still_moves(const PhaseFolder& mpm) { return findings::still_moves(mpm.result); }

bool any_moves(const std::vector<const PhaseFolder*>& runouts) {
    return std::ranges::any_of(runouts, [](const PhaseFolder* each) { return still_moves(*each); });
}

Certainty certainty_of(const PhaseFolder& mpm) {
    if (still_moves(mpm)) return Certainty::at_least;
    return fault::is_questionable(findings::flags_of(mpm.result)) ? Certainty::doubtful
                                                                  : Certainty::certain;
}

std::string bounded(const PhaseFolder& mpm, const std::string& distance) {
    return distance != "-" && still_moves(mpm) ? at_least + distance : distance;
}

std::string entanglement_of(const PhaseFolder& fem) {
    if (!is_entangled(fem)) return "";
    const json facts = fem.result.value("entanglement", json::object());
    std::string text = "The mesh " + entangled_where(fem);
    if (const std::string kind = kind_of(fem); !kind.empty()) text += ", " + kind;
    std::string state = with(facts, "mean_epsilon_q", "mean epsilon_q there ", " %", 0.01) +
                        with(facts, "failure_surfaces", "failure surfaces ", "");
    if (!state.empty()) text += "; then: " + state.substr(2);
    text += ". ";
    return text + (is_corner(fem)
                       ? "That is the mesh's doing and not the section's failure: refine "
                         "it there."
                       : "So ends the FEM of a section that fails; it is no fault.");
}

std::string entanglements_of(const std::vector<const PhaseFolder*>& fems) {
    if (fems.size() == 1) return entanglement_of(*fems.front());
    std::set<double> times;
    std::size_t entangled = 0, corners = 0;
    for (const PhaseFolder* each : fems) {
        if (!is_entangled(*each)) continue;
        ++entangled;
        if (is_corner(*each)) ++corners;
        if (const json time = time_of_entanglement(*each); time.is_number())
            times.insert(time.get<double>());
    }
    if (entangled == 0) return "";
    std::string text =
        std::to_string(entangled) + " of " + std::to_string(fems.size()) + " meshes entangled";
    if (times.size() == 1) text += ", at " + short_number(*times.begin()) + " s";
    if (times.size() > 1)
        text += ", from " + short_number(*times.begin()) + " to " + short_number(*times.rbegin()) +
                " s";
    if (corners == 0) return text + ".";
    return text + "; " + std::to_string(corners) +
           " of them at one bad corner, which is the mesh's doing and not the section's failure.";
}

std::string how_it_ended(const PhaseFolder& phase) {
    if (!phase.fault.empty()) return phase.fault;
    std::vector<Flag> flags = findings::flags_of(phase.result);
    std::string text;
    if (is_entangled(phase)) {
        text = entangled_where(phase);
        if (const std::string kind = kind_of(phase); !kind.empty()) text += ", " + kind;
    }
    const auto add = [&](const std::string& more) { text += (text.empty() ? "" : "; ") + more; };
    if (fault::is_questionable(flags)) {
        add("questionable: " + listed(flags, Severity::questionable));
    } else if (text.empty()) {
        text = "well";
    }
    // the end is in the text already
    std::erase_if(flags, [](const Flag& flag) { return flag.code.starts_with("entangled"); });
    if (const std::string warnings = listed(flags, Severity::warning); !warnings.empty())
        add("warnings: " + warnings);
    return text;
}

std::string how_they_ended(const std::vector<const PhaseFolder*>& runouts) {
    if (runouts.empty()) return "none";
    std::vector<Flag> cautions;
    std::size_t questionable = 0;
    for (const PhaseFolder* each : runouts) {
        if (!each->fault.empty()) return each->fault;
        const auto flags = findings::flags_of(each->result);
        if (!fault::is_questionable(flags)) continue;
        ++questionable;
        cautions.insert(cautions.end(), flags.begin(), flags.end());
    }
    if (questionable == 0) return "well";
    return std::to_string(questionable) + " of " + std::to_string(runouts.size()) +
           " questionable: " + listed(cautions, Severity::questionable);
}

Verdict verdict_of(const Run& run) {
    const findings::Verdict found = findings::verdict_of(facts_of(run));
    Verdict verdict{.word = findings::phrase_of(found.usable),
                    .usable = found.usable != findings::Usable::no};
    for (const findings::Reason& each : found.reasons) {
        if (each.code.starts_with("entangled")) continue;  // added below, with place and time
        const bool caution = each.usable > findings::Usable::with_remarks;
        (caution ? verdict.cautions : verdict.notes).push_back(each.text);
    }
    for (const PhaseFolder* fem : phases_named(run, phases::fem.program)) {
        const std::string end = entanglement_of(*fem);
        if (end.empty()) continue;
        const std::string of = fem->variant.empty() ? "" : capital(fem->variant) + ": ";
        (is_corner(*fem) ? verdict.cautions : verdict.notes).push_back(of + end);
    }
    if (verdict.cautions.empty() && verdict.notes.empty())
        verdict.notes.emplace_back("No phase of this run raised a flag.");
    return verdict;
}

Table flag_table(const Run& run) {
    Table table{"flags",
                "Flags",
                {"run", "t_T [s]", "variant", "flag", "severity", "what", "entry of the scene"},
                {},
                "questionable: a number of that result is a bound or cannot be relied on. warning: "
                "the result holds, but is less certain."};
    for (const PhaseFolder& phase : run.phases) {
        for (const Flag& flag : findings::flags_of(phase.result)) {
            table.rows.push_back(
                {phase.label, phase.transfer_time ? short_number(*phase.transfer_time) : "-",
                 phase.variant.empty() ? "all" : phase.variant, findings::worded(flag.code),
                 name_of(flag.severity), flag.message, flag.pointer.empty() ? "-" : flag.pointer});
        }
    }
    return table;
}

}  // namespace breach::report
