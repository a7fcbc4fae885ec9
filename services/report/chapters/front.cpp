// The first page: the question, the results with their uncertainty, and the limits. All numbers
// come from the phases' result.json.
#include <algorithm>
#include <map>

#include "core/phases/phases.hpp"
#include "services/findings/headline.hpp"
#include "services/report/chapters/chapters.hpp"
#include "services/report/read/samples.hpp"
#include "services/report/read/verdict.hpp"

namespace breach::report {

using nlohmann::json;
using namespace nlohmann::literals;

namespace {

constexpr std::size_t most_gauges = 4;  // limit of the page
constexpr int digits = 3;               // of results

std::string joined(const std::vector<std::string>& words, const std::string& between = ", ") {
    std::string text;
    for (const std::string& each : words) text += (text.empty() ? "" : between) + each;
    return text;
}

// ---------------------------------------------------------------- what was asked

std::string motion_of(const json& scene) {
    const json motion = scene.value("/fem/motion"_json_pointer, json());
    if (!motion.is_object()) return "under its own weight";
    std::string text =
        "shaken by " +
        std::filesystem::path(motion.at("file").get<std::string>()).filename().string();
    if (motion.contains("scale_to_pga_g"))
        text += " scaled to " + rounded(motion.at("scale_to_pga_g"), 4) + " g";
    return text;
}

std::string seconds_of_stages(const json& scene) {
    double sum = 0.0;
    for (const json& stage : scene.value("/fem/stages"_json_pointer, json::array()))
        sum += stage.value("duration", 0.0);
    return rounded(sum, 4) + " s";
}

std::string transfers_of(const Run& run) {
    std::vector<std::string> times, triggers;
    for (const PhaseFolder* each : phases_named(run, phases::transfer.program)) {
        if (!each->transfer_time) continue;
        const std::string time = short_number(*each->transfer_time);
        if (std::ranges::find(times, time) == times.end()) times.push_back(time);
    }
    if (run.study.is_object())
        for (const json& each : run.study.value("triggers", json::array()))
            triggers.push_back(each.value("name", each.value("kind", "")));
    constexpr std::size_t most = 12;
    const std::string when = times.size() <= most
                                 ? joined(times) + " s"
                                 : std::to_string(times.size()) + " times from " + times.front() +
                                       " to " + times.back() + " s";
    return (times.empty() ? "none" : when) +
           (triggers.empty() ? "" : " (triggers: " + joined(triggers) + ")");
}

/// A study may contain the FEM alone.
bool asks_for_runouts(const Run& run) {
    const bool waits = run.study.is_object() && !run.study.value("triggers", json::array()).empty();
    return waits || phase_named(run, phases::mpm.program);
}

std::string question_of(const Run& run, const json& scene) {
    const bool fem = phase_named(run, phases::fem.program);
    if (fem && !asks_for_runouts(run))
        return "Whether and when does the section fail, " + motion_of(scene) +
               "? Finite elements for " + seconds_of_stages(scene) + "; nothing is transferred.";
    if (fem)
        return "How far does the soil run out that fails, " + motion_of(scene) +
               "? Finite elements for " + seconds_of_stages(scene) +
               "; their state becomes material points at t_T = " + transfers_of(run) + ".";
    if (phase_named(run, phases::mpm.program))
        return "How far does the soil run out from the given section, with the strengths "
               "of the scene? A static scene: no earthquake, no finite elements; material points "
               "fill the section, with the stress \"" +
               scene.value("/mpm/fill_stress"_json_pointer, "none") + "\" at the start.";
    return "Does the section stand? Limit equilibrium alone, no runout.";
}

std::vector<std::string> asked_of(const Run& run, const json& scene) {
    std::vector<std::string> asked{question_of(run, scene)};
    if (phase_named(run, phases::lem.program) && phase_named(run, phases::mpm.program))
        asked.emplace_back("Its factor of safety beside it, by limit equilibrium.");
    if (!run.study.is_object()) return asked;
    std::vector<std::string> names;
    for (const json& each : run.study.value("variants", json::array()))
        if (each.value("made_by", "").empty()) names.push_back(each.at("name"));
    constexpr std::size_t most = 12;
    if (is_back_analysis(run)) {
        const json& inverse = run.uncertainty.at("inverse");
        asked.push_back("Which " + inverse.at("vary").get<std::string>() + " gives a " +
                        inverse.at("quantity").get<std::string>() + " of " +
                        rounded(inverse.at("target").get<double>(), 4) + " " +
                        inverse.at("unit").get<std::string>() + "? Back-analysis over " +
                        std::to_string(inverse.at("steps").size()) + " values.");
    } else if (has_samples(run))
        asked.push_back("How sure is that? " + run.uncertainty.at("samples").at("planned").dump() +
                        " samples of " + std::to_string(run.uncertainty.at("parameters").size()) +
                        " uncertain parameters.");
    if (names.size() > 1)
        asked.push_back(std::to_string(names.size()) + " variants" +
                        (names.size() <= most ? ": " + joined(names) : "") +
                        ". The chapter of variants lists their changes.");
    if (const int draws = run.study.value("draws", 1); draws > 1)
        asked.push_back(
            "Each on " + std::to_string(draws) + " lattices of material points" +
            (run.study.value("draws_of", "") == "fem" ? ", after a FEM of its own each." : "."));
    std::vector<std::string> changes;
    for (const json& each : run.study.value("overrides", json::array())) changes.push_back(each);
    if (!changes.empty())
        asked.push_back("The study changes the scene throughout: " + joined(changes, "; ") + ".");
    return asked;
}

// ---------------------------------------------------------------- what comes out

std::string counted(std::size_t count, std::size_t all) {
    return " (" + std::to_string(count) + " of " + std::to_string(all) + ")";
}

/// "3 to 12.5 (8 of 9)": least and largest value over the phases that have it. grows: the largest
/// is a lower bound while any soil moves, because another runout may exceed it.
std::string range_of(const std::vector<const PhaseFolder*>& phases, const std::string& pointer,
                     bool grows) {
    const PhaseFolder *least = nullptr, *largest = nullptr;
    std::size_t count = 0;
    const json::json_pointer at(pointer);
    for (const PhaseFolder* each : phases) {
        if (!each->result.is_object() || !each->result.contains(at) ||
            !each->result.at(at).is_number())
            continue;
        ++count;
        const auto value = [&](const PhaseFolder* one) { return one->result.at(at).get<double>(); };
        if (!least || value(each) < value(least)) least = each;
        if (!largest || value(each) > value(largest)) largest = each;
    }
    if (count == 0) return "-" + counted(0, phases.size());
    const auto text = [&](const PhaseFolder* one, bool bound) {
        return (grows && bound ? at_least : "") + rounded(one->result.at(at).get<double>(), digits);
    };
    const bool moves = any_moves(phases);
    const std::string all = counted(count, phases.size());
    if (count == 1) return text(least, moves) + all;
    return text(least, still_moves(*least)) + " to " + text(largest, moves) + all;
}

std::string brief_fact(const PhaseFolder& phase, const std::string& pointer) {
    const json::json_pointer at(pointer);
    if (!phase.result.contains(at) || !phase.result.at(at).is_number()) return "-";
    return rounded(phase.result.at(at).get<double>(), digits);
}

/// Error of the number, if known, and cautions about its result.
std::string worth_of(const PhaseFolder& mpm) {
    std::string text =
        mpm.runout_error
            ? "\u00b1 " + rounded(*mpm.runout_error, 2) + " m: " + mpm.runout_error_from
            : "numerical error not quantified (run an accuracy study, or set \"draws\")";
    if (const std::string end = how_it_ended(mpm); end != "well") text += "; " + end;
    return text;
}

std::string rest_of(const PhaseFolder& mpm) {
    const json rests = mpm.result.value("at_rest", json());
    if (!rests.is_boolean()) return "not known";
    const std::string end = " " + brief_fact(mpm, "/end_time") + " s";
    return rests.get<bool>() ? "yes, after" + end : "no: cut off at" + end;
}

/// With repeats: the largest of the means.
void add_mean(const Run& run, Table& table) {
    const json* largest = nullptr;
    for (const json& each : run.means)
        if (each.at("runout").is_number() &&
            (!largest || each.at("runout").get<double>() > largest->at("runout").get<double>()))
            largest = &each;
    if (!largest) return;
    const json error = largest->value("runout_error", json());
    const std::string variant = largest->at("variant");
    const bool moves = any_moves(draws_of(run, *largest));
    const std::string caution =
        largest->value("missing_draws", "") + largest->value("questionable_draws", "");
    table.rows.push_back(
        {"Runout, mean of " + rounded(largest->at("draws_done").get<double>(), 4) + " repeats" +
             (variant.empty() ? "" : ", " + variant) + " [m]",
         (moves ? at_least : "") + rounded(largest->at("runout").get<double>(), digits), "-",
         (error.is_number() ? "\u00b1 " + rounded(error.get<double>(), 2) + " m (nine of ten)"
                            : std::string("numerical error not quantified")) +
             (caution.empty() ? "" : "; not whole or questionable: " + caution)});
}

/// Arrival, depth and velocity of the governing runout at each gauge.
Table gauges_of(const Run& run) {
    const PhaseFolder* shown = farthest_runout(run);
    if (!shown) return {};
    Table table{
        "front_gauges",
        "At the gauges",
        {"quantity"},
        {{"arrival [s]"}, {"largest depth [m]"}, {"largest velocity [m/s]"}},
        "Of the governing case. Arrival: time since the soil began to move; -: the flow did "
        "not arrive."};
    const json gauges = shown->scene.value("/mpm/gauges"_json_pointer, json::array());
    for (const json& gauge : gauges) {
        const std::string name = gauge.at("name"), at = "/gauges/" + name;
        if (table.columns.size() > most_gauges || !shown->result.contains(json::json_pointer(at)))
            continue;
        table.columns.push_back(name + ", x = " + short_number(gauge.at("x")) + " m");
        table.rows[0].push_back(brief_fact(*shown, at + "/arrival_time"));
        table.rows[1].push_back(bounded(*shown, brief_fact(*shown, at + "/largest_depth")));
        table.rows[2].push_back(bounded(*shown, brief_fact(*shown, at + "/largest_velocity")));
    }
    return table.columns.size() > 1 ? table : Table{};
}

void add_runouts(const Run& run, Table& table) {
    const auto asked = phases_named(run, phases::mpm.program);
    if (!run.without_transfer.empty())
        table.rows.push_back({"Variants without a transfer", "-",
                              std::to_string(run.without_transfer.size()),
                              run.without_transfer.front().value("reason", "")});
    if (asked.empty()) return;
    const PhaseFolder* farthest = farthest_runout(run);
    if (!farthest) {
        table.rows.push_back({"Runout [m]", "no result", "0 of " + std::to_string(asked.size()),
                              asked.front()->fault});
        return;
    }
    const PhaseFolder& shown = *farthest;
    add_mean(run, table);
    table.rows.push_back({"Runout: 99 % of the mobile soil, from the toe [m]",
                          bounded(shown, rounded(runout_of(&shown), digits)),
                          range_of(asked, "/runout", true), worth_of(shown)});
    table.rows.push_back({"Of what passed the toe, 99 % [m]",
                          bounded(shown, brief_fact(shown, "/runout_beyond_toe")),
                          range_of(asked, "/runout_beyond_toe", true),
                          runout_of(&shown) > 0.0 ? "" : "99 % of the soil stays before the toe"});
    table.rows.push_back({"Deposit beyond the toe [m3 per m of width]",
                          bounded(shown, brief_fact(shown, "/area_beyond_toe")),
                          range_of(asked, "/area_beyond_toe", true), ""});
    const auto at_rest = std::ranges::count_if(asked, [](const PhaseFolder* each) {
        return each->result.is_object() && each->result.value("at_rest", json()) == json(true);
    });
    table.rows.push_back({"At rest", rest_of(shown),
                          std::to_string(at_rest) + " of " + std::to_string(asked.size()),
                          still_moves(shown) ? "distances and volumes are lower bounds" : ""});
    table.caption = "Governing case: the largest runout of all (" + of_transfer(shown) +
                    (any_moves(asked) && !still_moves(shown)
                         ? "), unless one whose soil still moved would have gone farther. "
                         : "). ") +
                    "In the whole run: least to largest, and how many have a result. "
                    "\u2265: a lower bound, the soil still moved.";
}

/// The factor of safety of an analysis' last stage; nothing: no stages.
std::optional<double> liquefied_factor(const PhaseFolder& lem) {
    if (!lem.result.is_object()) return {};
    const json stages = lem.result.value("stages", json::array());
    const json factor = stages.empty() ? json() : stages.back().value("factor_of_safety", json());
    if (!factor.is_number()) return {};
    return factor.get<double>();
}

/// Nothing: no analysis has stages.
std::optional<std::vector<std::string>> liquefied_row(const std::vector<const PhaseFolder*>& all,
                                                      const PhaseFolder& governing) {
    std::multimap<double, const PhaseFolder*> factors;
    for (const PhaseFolder* each : all)
        if (const auto factor = liquefied_factor(*each)) factors.emplace(*factor, each);
    if (factors.empty()) return {};
    const auto& [least, of] = *factors.begin();
    const std::string largest =
        factors.size() > 1 ? " to " + rounded(factors.rbegin()->first, digits) : "";
    const auto governs = liquefied_factor(governing);
    std::string remark = "residual strengths";
    if (of != &governing) remark += "; " + rounded(least, digits) + " in " + of->variant;
    return std::vector<std::string>{
        "Factor of safety with every layer liquefied that may",
        governs ? rounded(*governs, digits) : "-",
        rounded(least, digits) + largest + counted(factors.size(), all.size()), remark};
}

/// The analysis of the variant that runs farthest, or the one shared by all; without a runout the
/// one with the least factor.
const PhaseFolder* governing_stability(const Run& run, const std::vector<const PhaseFolder*>& all) {
    if (const PhaseFolder* farthest = farthest_runout(run))
        for (const std::string& variant : {farthest->variant, std::string()})
            for (const PhaseFolder* each : all)
                if (each->variant == variant && each->result.is_object() &&
                    each->result.contains("factor_of_safety"))
                    return each;
    return least_factor(run);
}

void add_factors(const Run& run, Table& table) {
    const auto all = phases_named(run, phases::lem.program);
    if (all.empty()) return;
    const PhaseFolder* least = governing_stability(run, all);
    if (!least) {
        table.rows.push_back({"Factor of safety", "no result", "0 of " + std::to_string(all.size()),
                              all.front()->fault});
        return;
    }
    std::string worth = "least of all surfaces";
    for (const auto& [name, fact] : {std::pair{"Bishop", "/bishop/factor_of_safety"},
                                     std::pair{"Spencer", "/bishop/spencer/factor_of_safety"}})
        if (const std::string factor = brief_fact(*least, fact); factor != "-")
            worth += std::string("; ") + name + " " + factor;
    if (const PhaseFolder* other = least_factor(run); other != least)
        worth += "; " + brief_fact(*other, "/factor_of_safety") + " in " + other->variant;
    if (const std::string end = how_it_ended(*least); end != "well") worth += "; " + end;
    auto liquefied = liquefied_row(all, *least);
    table.rows.push_back(
        {liquefied ? "Factor of safety before any layer liquefies" : "Factor of safety",
         brief_fact(*least, "/factor_of_safety"), range_of(all, "/factor_of_safety", false),
         worth});
    if (liquefied) table.rows.push_back(std::move(*liquefied));
    if (!least->result.contains("critical_depth")) return;
    table.rows.push_back(
        {"Liquefied depth at which the factor of safety falls to 1 [m]",
         brief_fact(*least, "/depth_at_fs_1"), range_of(all, "/depth_at_fs_1", false),
         brief_fact(*least, "/depth_at_fs_1") == "-" ? "stable with every layer liquefied" : ""});
    table.rows.push_back({"Depth of the critical surface (critical_depth of triggers) [m]",
                          brief_fact(*least, "/critical_depth"),
                          range_of(all, "/critical_depth", false),
                          "lowest point of the stage with the least factor of safety"});
}

/// Summarises many FEMs in one row, as in samples that change the FEM.
void add_fems(const Run& run, Table& table) {
    constexpr std::size_t most_fems = 6;
    const auto fems = phases_named(run, phases::fem.program);
    if (fems.size() > most_fems) {
        std::string worth =
            "largest displacement " + range_of(fems, "/largest_displacement", false) + " m";
        std::vector<const PhaseFolder*> odd;
        for (const PhaseFolder* each : fems)
            if (how_it_ended(*each) != "well") odd.push_back(each);
        if (!odd.empty())
            worth += "; " + std::to_string(odd.size()) + " not simply well, the first (" +
                     odd.front()->variant + "): " + how_it_ended(*odd.front());
        table.rows.push_back(
            {"Finite elements end [s], " + std::to_string(fems.size()) + " of them", "-",
             range_of(fems, "/end_time", false), worth});
        return;
    }
    for (const PhaseFolder* each : fems) {
        const std::string of = each->variant.empty() ? "" : " (" + each->variant + ")";
        const std::string end = how_it_ended(*each);
        table.rows.push_back(
            {"Finite elements end" + of,
             each->result.is_object() ? brief_fact(*each, "/end_time") + " s" : "no result", "-",
             end == "well"
                 ? "largest displacement " + brief_fact(*each, "/largest_displacement") + " m"
                 : end});
    }
}

// ---------------------------------------------------------------- limits

/// Changes after the transfer that the runouts leave out; variants may differ.
std::string limit_at_transfer(const Run& run) {
    const std::string nothing = "Nothing liquefies after the transfer";
    if (!is_shaken(run)) return nothing + ".";
    const auto runouts = phases_named(run, phases::mpm.program);
    const auto shaken = std::ranges::count_if(runouts, [](const PhaseFolder* each) {
        return each->scene.value("/mpm/shaking"_json_pointer, "off") == "on";
    });
    if (shaken == 0) return nothing + ", and the shaking ends with it.";
    if (static_cast<std::size_t>(shaken) == runouts.size())
        return nothing + "; the ground shakes on.";
    return nothing + "; the ground shakes on in " + std::to_string(shaken) + " of " +
           std::to_string(runouts.size()) +
           " runouts (/mpm/shaking), in the others the shaking "
           "ends with the transfer.";
}

std::vector<std::string> limits_of(const Run& run) {
    std::vector<std::string> limits;
    if (asks_for_runouts(run) && !has_samples(run))
        limits.emplace_back(
            "No uncertainty was computed: strengths, viscosity and motion are taken as the scene "
            "says "
            "them, as if they were known. A study with \"uncertainty\" gives percentiles.");
    limits.emplace_back(
        "Plane strain: all results are per metre of width. A breach of finite width spreads and "
        "drains otherwise.");
    if (!phase_named(run, phases::fem.program) && !phase_named(run, phases::mpm.program))
        limits.emplace_back(
            "Limit equilibrium: no deformation, and no surface but those that were searched.");
    if (!asks_for_runouts(run)) return limits;
    limits.emplace_back("No mixing with water: nothing is diluted, and no free water flows along.");
    limits.emplace_back(
        "Total stress in the runout: strength is that at the transfer, reduced "
        "by softening; no pore pressure builds up or drains.");
    if (!phase_named(run, phases::fem.program))
        limits.emplace_back("Static: whether and when the section fails is not asked.");
    else
        limits.push_back(limit_at_transfer(run));
    return limits;
}

/// "2026-11-22T13:15:02.123Z" -> "2026-11-22 13:15 UTC"
std::string moment_of(const std::string& time) {
    return time.size() < 16 ? time : time.substr(0, 10) + " " + time.substr(11, 5) + " UTC";
}

/// "Run 01, flow-slope; scene flow_slope; breachline 0.9.0; finished 2026-11-22 13:15 UTC."
std::string identity_of(const Run& run) {
    std::string text = "Scene " + run.scene.at("name").get<std::string>();
    if (!run.id.empty()) text = "Run " + run.id + ", " + run.name + ". " + text;
    for (const PhaseFolder& each : run.phases) {
        if (!each.result.is_object()) continue;
        const std::string version =
            each.result.value("/provenance/version"_json_pointer, json()).is_string()
                ? each.result.at("/provenance/version"_json_pointer).get<std::string>()
                : "";
        if (version.empty()) continue;
        text += ", computed by Breachline " + version;
        break;
    }
    if (!run.finished.empty()) text += ", finished " + moment_of(run.finished);
    return text + ".";
}

/// "; governing case: t_T = 13 s, soft"; empty without variants and transfer times.
std::string named(const PhaseFolder& phase) {
    const bool one = phase.variant.empty() && !phase.transfer_time;
    return one ? "" : "; governing case: " + of_transfer(phase);
}

/// "Flows ≥ 37.3 m beyond the toe; FS 0.912 as built; governing case: t_T = 13 s, soft; 1 of 2
/// runouts without a result."
std::string headline_of(const Run& run) {
    findings::HeadlineFacts facts{
        .stood_in_fem =
            !phase_named(run, phases::mpm.program) && !run.without_transfer.empty() &&
            std::ranges::all_of(run.without_transfer,
                                [](const json& each) { return each.value("stood", false); }),
        .lem_alone = std::ranges::all_of(
            run.phases, [](const PhaseFolder& each) { return each.phase == phases::lem.program; })};
    const PhaseFolder* farthest = farthest_runout(run);
    const auto asked = phases_named(run, phases::mpm.program);
    const auto missing = std::ranges::count_if(
        asked, [](const PhaseFolder* each) { return !each->result.is_object(); });
    if (farthest && (facts.soil = findings::soil_of(farthest->result))) {
        facts.soil->error = farthest->runout_error;
        if (has_samples(run))
            facts.soil->worst_of = static_cast<std::int64_t>(asked.size()) - missing;
    }
    const PhaseFolder* least = least_factor(run);
    if (least) {
        facts.factor_of_safety = least->result.at("factor_of_safety").get<double>();
        facts.factor_of_safety_liquefied = liquefied_factor(*least);
    }
    std::string text = findings::headline_of(facts).text;
    if (const PhaseFolder* governs = farthest ? farthest : least) text += named(*governs);
    if (farthest && missing > 0)
        text += "; " + std::to_string(missing) + " of " + std::to_string(asked.size()) +
                " runouts without a result";
    if (text.empty()) return text;
    text[0] = static_cast<char>(std::toupper(text[0]));
    return text + ".";
}

}  // namespace

Front front_of(const Run& run) {
    const json& scene = run.scene;
    Table found{"found",
                "What comes out",
                {"quantity", "governing case", "in the whole run", "remark"},
                {}};
    if (auto sampled = sampled_answer(run)) found.rows.push_back(std::move(*sampled));
    add_runouts(run, found);
    add_factors(run, found);
    add_fems(run, found);
    const json about =
        run.study.is_object() ? run.study.value("report", json::object()) : json::object();
    Front front{.of = identity_of(run),
                .headline = headline_of(run),
                .asked = asked_of(run, scene),
                .found = std::move(found),
                .gauges = gauges_of(run),
                .limits = limits_of(run),
                .author = about.value("author", ""),
                .reviewer = about.value("reviewer", "")};
    if (Figure overview = overview_of(run); !overview.chart.series.empty())
        front.pictures.push_back(std::move(overview));
    for (const char* each : {"site", "client", "author", "reviewer", "revision"})
        if (about.contains(each)) front.people.emplace_back(each, about.at(each));
    return front;
}

}  // namespace breach::report
