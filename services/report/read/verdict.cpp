#include "services/report/read/verdict.hpp"

#include <algorithm>
#include <array>
#include <set>

#include "core/phases/phases.hpp"
#include "services/report/chart/axis.hpp"

namespace breach::report {

using fault::Flag;
using fault::Severity;
using nlohmann::json;

namespace {

constexpr const char* moving = "still_moving";

/// "still moving"
std::string worded(std::string code) {
    std::ranges::replace(code, '_', ' ');
    return code;
}

bool is_doubt(const Flag& flag) { return flag.severity == Severity::questionable; }

/// Codes in words, each once: "still moving, numerical share".
std::string listed(const std::vector<Flag>& flags, Severity severity) {
    std::vector<std::string> codes;
    for (const Flag& each : flags) {
        if (each.severity != severity) continue;
        if (std::ranges::find(codes, each.code) == codes.end()) codes.push_back(each.code);
    }
    std::string text;
    for (const std::string& each : codes) text += (text.empty() ? "" : ", ") + worded(each);
    return text;
}

bool is_entangled(const PhaseFolder& phase) {
    return phase.result.is_object() && phase.result.value("ended", "") == "entangled";
}

/// ", x = 34.1 m" for a number that is there.
std::string with(const json& facts, const char* key, const std::string& name,
                 const std::string& unit, double in_si = 1.0) {
    if (!facts.contains(key) || !facts.at(key).is_number()) return "";
    return ", " + name + rounded(facts.at(key).get<double>() / in_si, 4) + unit;
}

/// When; null: not known.
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

/// One kind of flag with all who raised it.
struct Finding {
    std::string phase;
    Flag flag;  ///< the first of them
    std::vector<std::string> labels;
    std::string elsewhere = {};  ///< other phases that say the same in the same words
};

std::vector<Finding> findings_of(const Run& run) {
    std::vector<Finding> found;
    for (const PhaseFolder& phase : run.phases) {
        for (const Flag& flag : flags_of(phase).value_or(std::vector<Flag>{})) {
            const auto same = std::ranges::find_if(found, [&](const Finding& f) {
                return f.phase == phase.phase && f.flag.code == flag.code &&
                       f.flag.severity == flag.severity;
            });
            if (same == found.end()) {
                found.push_back({phase.phase, flag, {phase.label}});
            } else if (same->labels.back() != phase.label) {
                same->labels.push_back(phase.label);
            }
        }
    }
    std::ranges::stable_sort(found, [](const Finding& a, const Finding& b) {
        return is_doubt(a.flag) && !is_doubt(b.flag);
    });
    return found;
}

std::size_t tasks_of_phase(const Run& run, const std::string& phase) {
    return phases_named(run, phase).size();
}

/// "12 of 51 runouts", "the FEM".
std::string whose(const Run& run, const std::string& phase, std::size_t count) {
    const phases::Phase* known = phases::named(phase);
    const std::size_t all = tasks_of_phase(run, phase);
    if (all == 1) return known ? known->one : phase;
    return std::to_string(count) + " of " + std::to_string(all) + " " +
           (known ? known->analyses : phase);
}

std::string capital(std::string text) {
    if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] += 'A' - 'a';
    return text;
}

/// What several phases say in the same words is said once.
std::vector<Finding> without_echoes(const Run& run, const std::vector<Finding>& all) {
    std::vector<Finding> found;
    for (const Finding& each : all) {
        const auto same = std::ranges::find_if(found, [&](const Finding& f) {
            return f.flag.code == each.flag.code && f.flag.severity == each.flag.severity &&
                   f.flag.message == each.flag.message;
        });
        if (same == found.end())
            found.push_back(each);
        else
            same->elsewhere += ", " + whose(run, each.phase, each.labels.size());
    }
    return found;
}

std::string sentence_of(const Run& run, const Finding& finding) {
    std::string text = capital(worded(finding.flag.code)) + ", " +
                       whose(run, finding.phase, finding.labels.size()) + finding.elsewhere + ": " +
                       finding.flag.message;
    if (finding.labels.size() > 1) text += " (" + finding.labels.front() + ", the first of them)";
    return text + (text.ends_with('.') ? "" : ".");
}

/// What phases without a result, and with one of an earlier version, leave open.
void add_what_is_not_known(const Run& run, Verdict& verdict) {
    for (const phases::Phase& phase : phases::all) {
        const char* kind = phase.program;
        std::size_t without = 0;
        std::string why;
        for (const PhaseFolder* each : phases_named(run, kind)) {
            if (each->result.is_object()) continue;
            if (without++ == 0) why = each->fault;
        }
        if (without == 0) continue;
        verdict.doubts.push_back(capital(whose(run, kind, without)) + " left no result: " + why +
                                 (why.ends_with('.') ? "" : ".") +
                                 " Its version, settings and numbers are not known.");
    }
    std::size_t silent = 0, bounds = 0, results = 0;
    for (const PhaseFolder& each : run.phases) {
        if (!each.result.is_object()) continue;
        ++results;
        if (flags_of(each)) continue;
        ++silent;
        if (each.phase == phases::mpm.program && still_moves(each)) ++bounds;
    }
    if (silent == 0) return;
    std::string text = std::to_string(silent) + " of " + std::to_string(results) +
                       " results carry no flags (an earlier version made them): what may be wrong "
                       "with them is not known.";
    if (bounds > 0) {
        text += " The soil of " + std::to_string(bounds) +
                " runouts among them still moved at the end: their distances are lower bounds.";
    }
    verdict.doubts.push_back(text);
}

void add_what_changes_nothing(const Run& run, Verdict& verdict) {
    for (const json& group : run.same_results) {
        std::string names;
        for (const json& each : group)
            names += (names.empty() ? "" : ", ") + each.get<std::string>();
        verdict.doubts.push_back(
            "The variants " + names +
            " have the same results to the last digit: what tells them apart "
            "has no part in the results' numbers, which is no sign that it does not matter.");
    }
}

/// Variants without a runout: that of a dam which may stand is none, that of one which failed is
/// not known.
void add_what_was_not_let_go(const Run& run, Verdict& verdict) {
    for (const bool stood : {true, false}) {
        std::vector<std::string> names;
        std::string reason;
        for (const json& each : run.without_transfer) {
            if (each.value("stood", false) != stood) continue;
            names.push_back(each.value("variant", ""));
            if (reason.empty()) reason = each.value("reason", "");
        }
        if (names.empty()) continue;
        const std::string of = names.front().empty() ? ""
                               : names.size() == 1   ? " of " + names.front()
                                                     : " of " + std::to_string(names.size()) +
                                                         " variants (" + names.front() + ", ...)";
        std::string text =
            "Nothing was transferred" + of + ", so that there is no runout: " + reason;
        text += stood ? ". Perhaps the dam stands there; then nothing runs out."
                      : ". That is no sign that the dam stands.";
        (stood ? verdict.notes : verdict.doubts).push_back(text);
    }
}

/// Of a run whose state is not known it is taken for granted.
bool is_over(const Run& run) {
    return run.state != "queued" && run.state != "running" && run.state != "budget_exhausted";
}

/// One word for all of it, the worst first.
std::string word_for(const Run& run, const Verdict& verdict) {
    const auto any = [&](auto test) { return std::ranges::any_of(run.phases, test); };
    if (any([](const PhaseFolder& each) { return !each.result.is_object(); }))
        return is_over(run) ? "broken down in part" : "not finished";
    if (any([](const PhaseFolder& each) {
            const auto flags = flags_of(each);
            return flags && fault::is_questionable(*flags);
        }))
        return "questionable";
    if (!verdict.doubts.empty()) return "not known";
    return verdict.notes.empty() ? "nothing found against it" : "usable, with the remarks below";
}

}  // namespace

std::optional<std::vector<Flag>> flags_of(const PhaseFolder& phase) {
    if (!phase.result.is_object() || !phase.result.contains("flags")) return {};
    std::vector<Flag> flags;
    for (const json& each : phase.result.at("flags")) {
        const bool doubt = each.at("severity") == name_of(Severity::questionable);
        flags.push_back({each.at("code"), doubt ? Severity::questionable : Severity::warning,
                         each.at("message"), each.value("pointer", "")});
    }
    return flags;
}

bool still_moves(const PhaseFolder& mpm) {
    if (!mpm.result.is_object()) return false;
    if (mpm.result.value("at_rest", json()) == json(false)) return true;
    const auto flags = flags_of(mpm);
    return flags && std::ranges::find(*flags, moving, &Flag::code) != flags->end();
}

bool any_moves(const std::vector<const PhaseFolder*>& runouts) {
    return std::ranges::any_of(runouts, [](const PhaseFolder* each) { return still_moves(*each); });
}

Certainty certainty_of(const PhaseFolder& mpm) {
    if (still_moves(mpm)) return Certainty::at_least;
    const auto flags = flags_of(mpm);
    if (!flags) return Certainty::unknown;
    return fault::is_questionable(*flags) ? Certainty::doubtful : Certainty::certain;
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
    const auto flags = flags_of(phase);
    std::string text;
    if (is_entangled(phase)) {
        text = entangled_where(phase);
        if (const std::string kind = kind_of(phase); !kind.empty()) text += ", " + kind;
    }
    const auto add = [&](const std::string& more) { text += (text.empty() ? "" : "; ") + more; };
    if (!flags) {
        if (phase.phase == phases::mpm.program && still_moves(phase)) add("still moving");
        add("carries no flags: not known");
        return text;
    }
    if (fault::is_questionable(*flags)) {
        add("questionable: " + listed(*flags, Severity::questionable));
    } else if (text.empty()) {
        text = "well";
    }
    std::vector<Flag> others = *flags;  // the end itself has been told
    std::erase_if(others, [](const Flag& flag) { return flag.code.starts_with("entangled"); });
    if (const std::string warnings = listed(others, Severity::warning); !warnings.empty()) {
        add("warnings: " + warnings);
    }
    return text;
}

std::string how_they_ended(const std::vector<const PhaseFolder*>& runouts) {
    if (runouts.empty()) return "none";
    std::vector<Flag> doubts;
    std::size_t questionable = 0, unknown = 0, moved = 0;
    for (const PhaseFolder* each : runouts) {
        if (!each->fault.empty()) return each->fault;
        const auto flags = flags_of(*each);
        if (!flags) {
            ++unknown;
            if (still_moves(*each)) ++moved;
        } else if (fault::is_questionable(*flags)) {
            ++questionable;
            doubts.insert(doubts.end(), flags->begin(), flags->end());
        }
    }
    const std::string all = " of " + std::to_string(runouts.size());
    std::string text;
    const auto add = [&](const std::string& more) { text += (text.empty() ? "" : "; ") + more; };
    if (questionable > 0) {
        add(std::to_string(questionable) + all +
            " questionable: " + listed(doubts, Severity::questionable));
    }
    if (moved > 0) add(std::to_string(moved) + all + " still moving");
    if (unknown > 0) add(std::to_string(unknown) + all + " without flags: not known");
    return text.empty() ? "well" : text;
}

Verdict verdict_of(const Run& run) {
    Verdict verdict;
    if (!is_over(run))
        verdict.doubts.push_back("The run was " + run.state +
                                 " when it was exported: what follows is not all of it.");
    std::set<std::string> told;  // entanglements, which are told as an end
    for (const PhaseFolder* fem : phases_named(run, phases::fem.program)) {
        if (const std::string end = entanglement_of(*fem); !end.empty()) {
            const std::string of = fem->variant.empty() ? "" : capital(fem->variant) + ": ";
            (is_corner(*fem) ? verdict.doubts : verdict.notes).push_back(of + end);
            told.insert({"entangled", "entangled_corner"});
        }
    }
    for (const Finding& each : without_echoes(run, findings_of(run))) {
        if (told.contains(each.flag.code)) continue;
        (is_doubt(each.flag) ? verdict.doubts : verdict.notes).push_back(sentence_of(run, each));
    }
    add_what_is_not_known(run, verdict);
    add_what_was_not_let_go(run, verdict);
    add_what_changes_nothing(run, verdict);
    verdict.word = word_for(run, verdict);
    if (verdict.doubts.empty() && verdict.notes.empty()) {
        verdict.notes.emplace_back("No phase of this run raised a flag.");
    }
    return verdict;
}

Table flag_table(const Run& run) {
    Table table{"flags",
                "Flags",
                {"run", "t_T [s]", "variant", "flag", "severity", "what", "entry of the scene"},
                {},
                "questionable: a number of that result is a bound, is wrong or cannot be trusted. "
                "warning: it holds, with less certainty than it looks."};
    for (const PhaseFolder& phase : run.phases) {
        for (const Flag& flag : flags_of(phase).value_or(std::vector<Flag>{})) {
            table.rows.push_back(
                {phase.label, phase.transfer_time ? short_number(*phase.transfer_time) : "-",
                 phase.variant.empty() ? "all" : phase.variant, worded(flag.code),
                 name_of(flag.severity), flag.message, flag.pointer.empty() ? "-" : flag.pointer});
        }
    }
    return table;
}

}  // namespace breach::report
