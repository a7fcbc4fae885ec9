// Flags about what the search could not see. They compare Bishop's factors, as the search does, and
// name the entry to change with a value that can be pasted.
#include "lem_tool/bounds.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <limits>

#include "core/words/number.hpp"
#include "core/words/remedy.hpp"

namespace breach::lem {

using nlohmann::json;

namespace {

/// Relative rise of the factor below which a bound has no effect.
constexpr double telling_rise = 0.01;

using words::formatted;

constexpr const char* raises_factor = "bound_raises_factor";

/// A bound: the scene without it, and its message.
struct Bound {
    std::string pointer;
    std::string what;
    std::string remedy;
    fault::Severity where_it_hides_failure;
    void (*lift)(const Strata&, scene::Lem&);
};

/// Allows ends anywhere on the slope's upper and lower half.
void widen(const Strata& strata, scene::Lem& lem) {
    scene::SlipSearch& search = *lem.search;
    const bool to_right = search.entry[0] + search.entry[1] < search.exit[0] + search.exit[1];
    auto& left = to_right ? search.entry : search.exit;
    auto& right = to_right ? search.exit : search.entry;
    const double middle = 0.5 * (left[1] + right[0]);
    left = {std::min(left[0], strata.left()), std::max(left[1], middle)};
    right = {std::min(right[0], middle), std::max(right[1], strata.right())};
}

std::vector<Bound> bounds_of(const Strata& strata, const scene::Lem& lem) {
    using fault::Severity;
    std::vector<Bound> bounds;
    const scene::SlipSearch& search = *lem.search;
    if (!lem.floor.empty())
        bounds.push_back({"/lem/floor", "below the floor",
                          "If that soil is rock, give it the law linear_elastic; otherwise delete "
                          "/lem/floor",
                          Severity::questionable,
                          [](const Strata&, scene::Lem& each) { each.floor.clear(); }});
    if (search.lowest_level)
        bounds.push_back({"/lem/search/lowest_level",
                          formatted("below the lowest level, %.4g m", *search.lowest_level),
                          "If that soil is rock, give it the law linear_elastic; otherwise delete "
                          "lowest_level",
                          Severity::questionable, [](const Strata&, scene::Lem& each) {
                              each.search->lowest_level.reset();
                          }});
    // A warning even where it hides F < 1: shallow slips are left out on purpose.
    if (search.minimum_depth > 0.0)
        bounds.push_back({"/lem/search/minimum_depth",
                          formatted("shallower than minimum_depth, %.3g m", search.minimum_depth),
                          "If such slips do harm, " + words::set("/lem/search/minimum_depth", 0.0),
                          Severity::warning, [](const Strata&, scene::Lem& each) {
                              each.search->minimum_depth = 0.0;
                          }});
    scene::Lem wide = lem;
    widen(strata, wide);
    if (search.entry != wide.search->entry || search.exit != wide.search->exit)
        bounds.push_back({"/lem/search/entry", "outside the ranges of entry and exit",
                          words::set("/lem/search/entry", wide.search->entry) + " " +
                              words::set("/lem/search/exit", wide.search->exit),
                          Severity::questionable, widen});
    return bounds;
}

/// The model with other bounds and the same soils.
Model model_of(const scene::Scene& scene, const State& state) {
    Model model = state.model;
    // Soils stay those of the state, liquefied or not; only the geometry depends on the bounds.
    model.strata = make_strata(scene);
    return model;
}

double coarse_factor(const scene::Scene& scene, const State& state, int threads) {
    Model model = model_of(scene, state);
    model.strata.crack.share = state.families.circles.model.strata.crack.share;
    scene::SlipSearch ranges = *scene.lem->search;
    // A coarse grid finds a factor that is too high, never one too low: what it flags is there.
    for (int* points : {&ranges.entry_points, &ranges.exit_points, &ranges.depths})
        *points = std::max(4, *points * 2 / 3);  // a third of the search's grid
    const SearchResult found = search(model, ranges, threads, Effort::coarse);
    return found.critical ? found.critical->bishop.factor_of_safety
                          : std::numeric_limits<double>::infinity();
}

/// Flags a critical surface that ends at the limit of a range.
std::vector<fault::Flag> flags_of_edges(const Strata& strata, const scene::Lem& lem,
                                        const State& state) {
    std::vector<fault::Flag> flags;
    scene::Lem wide = lem;
    widen(strata, wide);
    const double width = strata.right() - strata.left();
    const auto look = [&](const std::array<double, 2>& range, const std::array<double, 2>& wider,
                          const std::string& end) {
        const double x = state.answer.at(end)[0];
        for (const double edge : range) {
            const bool ground_ends = edge <= strata.left() || edge >= strata.right();
            // At the end of the section there is no wider range, and a range of one point was
            // meant.
            if (ground_ends || range[0] == range[1] || std::abs(x - edge) > 1e-3 * width) continue;
            flags.push_back(
                {"range_edge", fault::Severity::warning,
                 "the critical surface" + state.name + " ends at the edge of this range, x = " +
                     formatted("%.4g m", edge) + ": a lower factor of safety may lie beyond" +
                     (state.name.empty() ? "" : ", and another critical_depth") +
                     (wider == range ? "" : "; " + words::set("/lem/search/" + end, wider)),
                 "/lem/search/" + end});
        }
    };
    look(lem.search->entry, wide.search->entry, "entry");
    look(lem.search->exit, wide.search->exit, "exit");
    return flags;
}

fault::Flag flag_of(const Bound& bound, const State& state, double without) {
    const double own = state.families.least().factor();
    const bool hides_failure = own >= 1.0 && without < 1.0;
    return {raises_factor, hides_failure ? bound.where_it_hides_failure : fault::Severity::warning,
            formatted(
                "Bishop's factor of safety%s is %.3f; without this bound it is %.3f, on a surface "
                "%s. ",
                state.name.c_str(), own, without, bound.what.c_str()) +
                bound.remedy,
            bound.pointer};
}

/// Removes the bounds not flagged so far: all at once on a coarse grid, then one by one if that
/// lowers the factor.
std::vector<fault::Flag> flags_of_bounds(const scene::Scene& scene, const State& state, int threads,
                                         const std::vector<fault::Flag>& told) {
    const Strata& strata = state.model.strata;
    const double telling_factor = state.families.least().factor() * (1.0 - telling_rise);
    std::vector<Bound> bounds = bounds_of(strata, *scene.lem);
    std::erase_if(bounds, [&](const Bound& bound) {
        return std::ranges::any_of(told, [&](const fault::Flag& each) {
            return each.code == raises_factor && each.pointer == bound.pointer;
        });
    });
    scene::Scene free = scene;
    for (const Bound& each : bounds) each.lift(strata, *free.lem);
    std::vector<fault::Flag> flags;
    // The usual case: one coarse search instead of one per bound.
    if (coarse_factor(free, state, threads) >= telling_factor) return flags;
    for (const Bound& each : bounds) {
        scene::Scene lifted = scene;
        each.lift(strata, *lifted.lem);
        if (coarse_factor(lifted, state, threads) >= telling_factor) continue;
        const double without =
            search_families(lifted, model_of(lifted, state), *lifted.lem->search, threads)
                .least()
                .factor();
        if (without < telling_factor) flags.push_back(flag_of(each, state, without));
    }
    return flags;
}

std::vector<fault::Flag> flags_of_upstream_end(const Strata& strata, const State& state) {
    const double entry = state.answer.at("entry")[0];
    const json& exit = state.answer.at("exit");
    const bool falls_right = entry < exit[0];
    // The slope's height, from the highest ground to the surface's exit, is the measure of
    // distance.
    double crest = -std::numeric_limits<double>::infinity();
    for (const Strip& strip : strata.strips)
        for (const double x : {strip.from, strip.to})
            crest = std::max(crest, strata.ground(strip).at(x));
    const double height = crest - exit[1].get<double>();
    const double end = falls_right ? strata.left() : strata.right();
    const double distance = std::abs(entry - end);
    if (distance >= height) return {};
    return {
        {"upstream_wall", fault::Severity::warning,
         formatted(
             "the critical surface%s begins %.3g m from the section's upstream end, x = %.4g m, "
             "less than the slope's height, %.3g m: surfaces that begin farther upstream are not "
             "searched. Extend the section to x = %.4g m at least",
             state.name.c_str(), distance, end, height,
             end + (falls_right ? -1.0 : 1.0) * (2.0 * height - distance)),
         "/section/regions"}};
}

std::vector<fault::Flag> flags_of_crack(const scene::Lem& lem, const State& state) {
    const json facts = state.answer.at("bishop").value("tension_crack", json());
    if (facts.is_null()) return {};
    const Searched& circles = state.families.circles;
    const Strata& strata = circles.model.strata;
    const json& entry = state.answer.at("bishop").at("entry");
    const double x = entry[0];
    const double ground =
        std::max(ground_level(strata, x, From::left), ground_level(strata, x, From::right));
    const double given = lem.tension_crack->depth.value_or(
        std::max(0.0, ground - lem.tension_crack->level.value_or(ground)));
    const double zone = facts.at("tension_zone");
    const double taken = facts.at("share").get<double>() * given;
    const double whole = circles.factor_with_whole_crack;
    if (whole <= circles.factor() * (1.0 + telling_rise)) return {};
    const auto with_crack = [&](double depth) {
        return lem.tension_crack->depth
                   ? words::set("/lem/tension_crack/depth", words::rounded_down(depth))
                   : words::set("/lem/tension_crack/level", ground - depth);
    };
    const std::string remedy =
        taken > 0.01 * given ? with_crack(taken) : std::string("Delete /lem/tension_crack");
    const std::string at_whole = std::isfinite(whole) ? formatted("it would be %.3f", whole)
                                                      : std::string("there is no surface");
    return {
        {"deep_crack", fault::Severity::warning,
         formatted("the tension crack%s is %.3g m deep, and soil as at the surface's upper end "
                   "stands open to %.3g m, 2 c / gamma tan(45 + phi / 2). Soil below that presses "
                   "on the mass, which a deeper crack leaves out: the surface ends %.3g m deep in "
                   "the crack, where Bishop's factor is least, %.3f; at the whole depth %s. %s, or "
                   "give the soil its cohesion",
                   state.name.c_str(), given, zone, taken, circles.factor(), at_whole.c_str(),
                   remedy.c_str()),
         "/lem/tension_crack"}};
}

/// Without a crack, cohesion holds a crest that is in tension.
std::vector<fault::Flag> flags_of_tension(const scene::Scene& scene, const State& state,
                                          int threads) {
    const Searched& least = state.families.least();
    const double zone = tension_zone(least.model, least.found.critical->surface);
    if (scene.lem->tension_crack || !(zone > 0.0) || !std::isfinite(zone)) return {};
    constexpr double telling_fall = 0.03;  // less is usual in cohesive soil
    const double telling_factor = least.factor() * (1.0 - telling_fall);
    const double depth = words::rounded_down(zone);
    scene::Scene cracked = scene;
    cracked.lem->tension_crack.emplace().depth = depth;
    if (coarse_factor(cracked, state, threads) >= telling_factor) return {};
    const double with =
        search_families(cracked, model_of(cracked, state), *cracked.lem->search, threads)
            .least()
            .factor();
    if (with >= telling_factor) return {};
    return {{"no_tension_crack", fault::Severity::warning,
             formatted("Bishop's factor of safety%s is %.3f with tension at the crest; with a "
                       "crack to %.3g m, 2 c / gamma tan(45 + phi / 2), it is %.3f. %s",
                       state.name.c_str(), least.factor(), depth, with,
                       words::set("/lem/tension_crack/depth", depth).c_str()),
             "/lem/tension_crack"}};
}

}  // namespace

void add_flags_of_state(const scene::Scene& scene, const State& state, int threads,
                        std::vector<fault::Flag>& flags) {
    const auto add = [&](std::vector<fault::Flag> more) {
        std::ranges::move(more, std::back_inserter(flags));
    };
    add(flags_of_answer(state.answer, *scene.lem));
    add(flags_of_crack(*scene.lem, state));
    if (scene.lem->search) {
        if (state.name.empty()) add(flags_of_weak_layer(scene, state.families, state.answer));
        add(flags_of_edges(state.model.strata, *scene.lem, state));
        add(flags_of_bounds(scene, state, threads, flags));
        if (state.name.empty()) add(flags_of_tension(scene, state, threads));
    }
    add(flags_of_upstream_end(state.model.strata, state));
}

}  // namespace breach::lem
