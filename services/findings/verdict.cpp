// From facts to "can it be used?". The store fills the facts for runs, so the verdict needs no
// files. Each fact that speaks against use gives a reason; the worst decides, and all are listed.
#include "services/findings/verdict.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "core/phases/phases.hpp"
#include "core/words/number.hpp"
#include "core/words/words.hpp"
#include "services/findings/flags.hpp"

namespace breach::findings {

using fault::Severity;
using nlohmann::json;

static constexpr auto words_of(Usable) {
    using enum Usable;
    return words::in_order<Usable>({{yes, "yes"},
                                    {with_remarks, "with_remarks"},
                                    {not_finished, "not_finished"},
                                    {in_part, "in_part"},
                                    {questionable, "questionable"},
                                    {no, "no"}});
}

namespace {

/// The same words as run_summaries and sweep_state of the store.
bool is_over(const std::string& state) {
    static const std::set<std::string> open{"queued", "running", "planning", "refining"};
    return !open.contains(state);
}

/// Flags in words, for lines that count them.
// Each follows a count and its results: "3 of 8 runouts still moving: lower bounds".
constexpr std::array<std::pair<const char*, const char*>, 8> briefs{{
    {"still_moving", "still moving: lower bounds"},
    {"numerical_share", "with much energy made or lost by the numerics"},
    {"volume_ratio", "that did not keep the volume"},
    {"overlap", "with soil lying in soil"},
    {"liquefied_gap", "with walls of unliquefied soil too thin for the cells"},
    {"coarse_cells", "on cells too coarse"},
    {"coarse_elements", "on elements too coarse"},
    {"entangled_corner", "ended by one bad corner of the mesh"},
}};

std::string brief_of(const std::string& code) {
    for (const auto& [known, words] : briefs)
        if (code == known) return words;
    return "flagged " + code;
}

std::string results_of(const std::string& phase) {
    const phases::Phase* known = phases::named(phase);
    return known ? known->results : "results of " + phase;
}

/// "12 of 51 runouts", "the FEM".
/// A single analysis has an article ("the FEM"), never "1 of 1".
std::string whose(const std::string& phase, std::int64_t count, std::int64_t all) {
    const phases::Phase* known = phases::named(phase);
    if (all == 1) return known ? known->one : phase;
    return std::to_string(count) + " of " + std::to_string(all) + " " +
           (known ? known->analyses : phase);
}

std::string capital(std::string text) {
    if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] += 'A' - 'a';
    return text;
}

std::string ended(const std::string& text) { return text + (text.ends_with('.') ? "" : "."); }

/// An implausible entry makes the result unusable; with other warnings the number can be used.
Usable usable_with(const fault::Flag& flag) {
    if (flag.code == "implausible") return Usable::no;
    return flag.severity == Severity::questionable ? Usable::questionable : Usable::with_remarks;
}

/// The same flag of several phases with the same message is one reason.
void add_flags(std::vector<Raised> raised, std::vector<Reason>& reasons) {
    const auto place = [](const Raised& each) {
        return std::ranges::find(phases::all, each.phase, &phases::Phase::program);
    };
    // In the order of the chain, so that the phase where a fault begins comes first.
    std::ranges::stable_sort(raised, {}, place);
    std::vector<bool> told(raised.size(), false);
    for (std::size_t i = 0; i < raised.size(); ++i) {
        if (told[i]) continue;
        const Raised* most = &raised[i];
        std::string of;
        for (std::size_t k = i; k < raised.size(); ++k) {
            const Raised& other = raised[k];
            const bool same = other.flag.code == raised[i].flag.code &&
                              other.flag.severity == raised[i].flag.severity &&
                              other.flag.message == raised[i].flag.message;
            if (!same) continue;
            told[k] = true;
            of += (of.empty() ? "" : ", ") + whose(other.phase, other.results, other.of_results);
            // The phase with most of such results gives the short line its numbers.
            if (other.results > most->results) most = &other;
        }
        std::string text =
            capital(worded(most->flag.code)) + ", " + of + ": " + raised[i].flag.message;
        if (raised[i].results > 1 && !raised[i].first.empty())
            text += " (" + raised[i].first + ", the first of them)";
        reasons.push_back({usable_with(most->flag), most->flag.code,
                           std::to_string(most->results) + " of " +
                               std::to_string(most->of_results) + " " + results_of(most->phase) +
                               " " + brief_of(most->flag.code),
                           ended(text), most->flag.pointer, most->results});
    }
}

/// Warnings of the submission that no result repeats. Only a check of the whole scene finds them: a
/// phase sees its own entries. Of a variant: "variant "wet": " and the message.
void add_submitted(const Facts& facts, std::vector<Reason>& reasons) {
    for (const fault::Flag& each : facts.submitted) {
        const bool repeated = std::ranges::any_of(facts.raised, [&](const Raised& raised) {
            return raised.flag.code == each.code && each.message.ends_with(raised.flag.message);
        });
        if (repeated) continue;
        reasons.push_back({usable_with(each), each.code, brief_of(each.code) + " at submission",
                           capital(worded(each.code)) + ", at submission" +
                               (each.pointer.empty() ? "" : " (" + each.pointer + ")") + ": " +
                               ended(each.message),
                           each.pointer});
    }
}

/// Unusable only where every analysis fails: of several variants, one that does not stand may be
/// what the study is about.
Reason reason_of(const Unstable& unstable) {
    const bool all = unstable.analyses == unstable.of_analyses;
    const std::string of = unstable.of_analyses == 1 ? ""
                           : all ? ", all " + std::to_string(unstable.analyses) + " variants"
                                 : ", " + std::to_string(unstable.analyses) + " of " +
                                       std::to_string(unstable.of_analyses) + " variants";
    const std::string factor = "factor of safety " + words::text_of(unstable.least, 3) +
                               (unstable.variant.empty() ? "" : " (" + unstable.variant + ")");
    return {
        all ? Usable::no : Usable::questionable,
        "does_not_stand",
        "does not stand as built" + of + ": " + factor,
        "The section does not stand as built" + of + ": " + factor +
            " before any layer liquefies. Check strengths, units and water; of a section that is "
            "known to have failed, say so: \"known_failure\": true in the study.",
        "/scene/lem",
        unstable.analyses};
}

/// An early transfer leaves soil unliquefied that would have flowed: the runout errs on the unsafe
/// side.
Reason reason_of(const Early& early) {
    const bool all = early.transfers == early.of_transfers;
    const std::string of = whose(phases::transfer.program, early.transfers, early.of_transfers);
    return {all ? Usable::no : Usable::questionable,
            "early_transfer",
            of + " before liquefaction had ended",
            capital(of) +
                " came before liquefaction had ended: t_T = " + words::text_of(early.first) +
                " s, but the liquefied zone reached most of its depth at " +
                words::text_of(early.liquefied_at) +
                " s only. The runout is probably too short (unsafe). Transfer later.",
            "/transfer_times",
            early.transfers};
}

/// Variants without a transfer. The dam may be stable only where its FEM ended without a failure.
void add_without_transfer(const Facts& facts, std::vector<Reason>& reasons) {
    std::map<std::pair<bool, std::string>, std::vector<const NoTransfer*>> alike;
    for (const NoTransfer& each : facts.without_transfer)
        alike[{each.stood, each.pointer}].push_back(&each);
    for (const auto& [kind, variants] : alike) {
        const auto& [stood, pointer] = kind;
        std::vector<std::string> names;
        for (const NoTransfer* each : variants) names.push_back(each->variant);
        // Reasons with other numbers belong to their variants only.
        const std::string& first = variants.front()->reason;
        const bool same = std::ranges::all_of(
            variants, [&](const NoTransfer* each) { return each->reason == first; });
        const std::string why = (same ? ": " : "; of " + names.front() + ": ") + first;
        const std::string of = names.front().empty() ? ""
                               : names.size() == 1   ? " from " + names.front()
                               : same ? " from " + std::to_string(names.size()) + " variants (" +
                                            names.front() + ", ...)"
                                      : " from " + std::to_string(names.size()) + " variants";
        reasons.push_back({facts.has_runout ? Usable::questionable : Usable::no, "no_transfer",
                           "no transfer" + of + why,
                           "No transfer" + of + ", so there is no runout" + why +
                               (stood ? ". The dam may stand; then nothing runs out."
                                      : ". This does not mean that the dam is stable."),
                           pointer, static_cast<std::int64_t>(names.size())});
    }
}

/// The same gap is weighed by the run's state: a run that goes on may still fill it.
void add_broken(const Facts& facts, std::vector<Reason>& reasons) {
    const Usable worth = is_over(facts.state) ? Usable::in_part : Usable::not_finished;
    for (const Broken& each : facts.broken)
        reasons.push_back({worth,
                           "no_result",
                           "",
                           capital(whose(each.phase, each.results, each.of_results)) +
                               " left no result: " + ended(each.why),
                           {},
                           each.results});
}

/// A remark only: the numbers are right, but a reader would expect the entries to matter.
void add_same_results(const std::vector<std::vector<std::string>>& groups,
                      std::vector<Reason>& reasons) {
    for (const auto& group : groups) {
        std::string names;
        for (const std::string& each : group) names += (names.empty() ? "" : ", ") + each;
        reasons.push_back({Usable::with_remarks, "same_results", "the same results: " + names,
                           "The variants " + names +
                               " have identical results: the entries that differ had no effect."});
    }
}

}  // namespace

const char* name_of(Usable usable) { return words::name_of(usable).data(); }

const char* phrase_of(Usable usable) {
    switch (usable) {
        case Usable::yes:
            return "usable";
        case Usable::with_remarks:
            return "usable, with remarks";
        case Usable::not_finished:
            return "not finished";
        case Usable::in_part:
            return "in part without results";
        case Usable::questionable:
            return "questionable";
        case Usable::no:
            return "not usable";
    }
    return "";
}

Verdict verdict_of(const Facts& facts) {
    Verdict verdict;
    std::vector<Reason>& reasons = verdict.reasons;
    if (!is_over(facts.state))
        reasons.push_back({Usable::not_finished, "not_finished", "",
                           "The run is " + facts.state + ": this is not all of it."});
    // The order of these calls is of no account: reasons are sorted below.
    if (facts.unstable) reasons.push_back(reason_of(*facts.unstable));
    add_without_transfer(facts, reasons);
    if (facts.early) reasons.push_back(reason_of(*facts.early));
    add_broken(facts, reasons);
    add_flags(facts.raised, reasons);
    add_submitted(facts, reasons);
    add_same_results(facts.same_results, reasons);
    // By code within one weight, so that two calls list the same order.
    std::ranges::stable_sort(reasons, [](const Reason& a, const Reason& b) {
        return a.usable != b.usable ? a.usable > b.usable : a.code < b.code;
    });
    if (!reasons.empty()) verdict.usable = reasons.front().usable;
    return verdict;
}

std::string line_of(const Verdict& verdict) {
    std::string line;
    for (const Reason& each : verdict.reasons)
        // Remarks leave a run usable, so they are no reason for this line.
        if (each.usable > Usable::with_remarks && !each.brief.empty())
            line += (line.empty() ? "" : "; ") + each.brief;
    return line;
}

json as_json(const Verdict& verdict) {
    json reasons = json::array();
    for (const Reason& each : verdict.reasons)
        reasons.push_back({{"usable", name_of(each.usable)},
                           {"code", each.code},
                           {"brief", each.brief},
                           {"text", each.text},
                           {"pointer", each.pointer},
                           {"count", each.count}});
    return {{"usable", name_of(verdict.usable)},
            {"words", phrase_of(verdict.usable)},
            {"reasons", std::move(reasons)}};
}

}  // namespace breach::findings
