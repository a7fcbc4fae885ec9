// Besides the numbers, the reasons in words: why a circle is refused, why a search found nothing,
// why Spencer's method has no answer on a surface.
#include "lem_tool/facts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/words/number.hpp"
#include "lem_tool/slip_circle.hpp"
#include "lem_tool/spencer.hpp"

namespace breach::lem {

using nlohmann::json;

namespace {

json point(double x, double y) { return json::array({x, y}); }

/// Lowest point of the base; on a level floor, its left end.
scene::Vec2 lowest_point(const Strata& strata, const Surface& surface, const Slices& slices) {
    const double bottom = std::clamp(surface.circle.center.x(), surface.left, surface.right);
    scene::Vec2 lowest(bottom, base_level(strata, surface, bottom));
    for (std::size_t i = 0; i <= slices.count; ++i) {
        const double x = i < slices.count ? slices.left[i] : surface.right;
        const double y = base_level(strata, surface, x);
        if (y < lowest.y()) lowest = {x, y};
    }
    return lowest;
}

std::string because(Cut cut) {
    switch (cut) {
        case Cut::above_ground:
            return "comes out of the ground between its ends";
        case Cut::leaves_model:
            return "leaves the model";
        case Cut::closed_region:
            return "passes through a linear elastic region, which cannot fail";
        case Cut::overhangs:
            return "meets the ground above its centre and would lean back over the mass";
        case Cut::done:
            break;
    }
    return "cuts nothing off";
}

/// A small m_alpha is flagged, not refused: the user gave this circle.
bool is_answer(const Bishop& result) {
    return result.balance == Balance::found || result.balance == Balance::small_m_alpha;
}

std::string because(const Unbalanced& mass) {
    if (mass.force_factor == 0.0) return "level interslice forces balance the mass at no factor";
    std::string text = words::formatted(
        "no one inclination of the interslice forces balances the mass: at best (%.3g rad, "
        "forces in balance at F = %.4g) %.2g %% of the driving moment is left over",
        mass.theta, mass.force_factor, 100.0 * std::abs(mass.moment_left));
    if (mass.without_friction)
        text +=
            "; without friction the moments alone give factor_of_safety, for interslice forces of "
            "any inclinations";
    return text;
}

/// Remedy for a search without surfaces, by the most frequent reason.
std::string remedy_of(const scene::Lem& scene, const Model& model, const Tally& tally) {
    const scene::SlipSearch& search = *scene.search;
    if (tally.too_shallow > tally.not_a_surface) return "give a smaller minimum_depth";
    const Strata& strata = model.strata;
    const bool no_way_out = std::ranges::all_of(search.exit, [&](double x) {
        const Strip& strip = strata.strips[strip_at(strata, x)];
        return std::max(strip.bottom.at(x), strip.floor.at(x)) >= strata.ground(strip).at(x);
    });
    if (no_way_out && (search.lowest_level || !scene.floor.empty()))
        return "lower lowest_level or /lem/floor: it lies above the ground at both ends of exit";
    return "put entry on the upper and exit on the lower side of the slope, within the model";
}

}  // namespace

json facts_of(const Model& model, const Critical& critical, Slices& slices) {
    const Surface& s = critical.surface;
    cut(model.strata, model.soils, s, model.slices, slices);
    const scene::Vec2 center = s.circle.center;
    const Slide slide = slide_of(slices);
    const double left = base_level(model.strata, s, s.left);
    const double right = base_level(model.strata, s, s.right);
    const bool falls_right = slide == Slide::to_right;
    const scene::Vec2 lowest = lowest_point(model.strata, s, slices);
    json facts{{"factor_of_safety", critical.bishop.factor_of_safety},
               {"method", "bishop_simplified"},
               {"circle", {{"center", point(center.x(), center.y())}, {"radius", s.circle.radius}}},
               {"entry", falls_right ? point(s.left, left) : point(s.right, right)},
               {"exit", falls_right ? point(s.right, right) : point(s.left, left)},
               {"lowest_point", point(lowest.x(), lowest.y())},
               {"sliding_depth", slices.depth},
               {"least_m_alpha", critical.bishop.m_alpha},
               {"iterations", critical.bishop.iterations},
               {"slices", slices.count},
               {"ordinary", nullptr},
               {"spencer", nullptr},
               {"spencer_reason", ""}};
    if (const auto F = ordinary(slices, s.circle, slide, model.k_h)) {
        facts["ordinary"] = {{"factor_of_safety", F->factor_of_safety},
                             {"conventional", F->conventional}};
    }
    const auto rigorous = spencer(slices, s.circle, slide, model.k_h);
    if (const auto* balanced = std::get_if<Spencer>(&rigorous)) {
        facts["spencer"] = {{"factor_of_safety", balanced->factor_of_safety},
                            {"interslice_inclination", balanced->theta},
                            {"least_m_alpha", balanced->m_alpha}};
    } else {
        facts["spencer_reason"] = because(std::get<Unbalanced>(rigorous));
    }
    return facts;
}

json facts_of(const Tally& tally) {
    return {{"analysed", tally.analysed},
            {"outside_soil", tally.not_a_surface},
            {"too_shallow", tally.too_shallow},
            {"without_answer", tally.no_answer}};
}

Critical analyse_circle(const scene::Scene& scene, const Model& model, Slices& slices) {
    std::optional<Critical> best;
    std::string why = because(Cut::done);
    for (const Surface& surface : masses_of(model.strata, *scene::lem_of(scene).circle)) {
        const Cut verdict = cut(model.strata, model.soils, surface, model.slices, slices);
        if (verdict != Cut::done) {
            why = because(verdict);
            continue;
        }
        const Bishop result = bishop(slices, slide_of(slices), model.k_h);
        if (!is_answer(result)) {
            why = result.balance == Balance::no_driving_moment
                      ? "cuts off a mass that its weight does not drive"
                      : "has a factor of safety on which the iteration does not settle";
            continue;
        }
        if (!best || result.factor_of_safety < best->bishop.factor_of_safety) {
            best = Critical{surface, result};
        }
    }
    if (!best) {
        throw fault::BadInput(
            scene.name, {{"/lem/circle", why,
                          "give a circle whose lower arc cuts a mass off the slope, or a search"}});
    }
    return *best;
}

void refuse_search(const scene::Scene& scene, const Model& model, const Tally& tally) {
    throw fault::BadInput(
        scene.name,
        {{"/lem/search",
          "finds no surface: " + std::to_string(tally.not_a_surface) + " leave the soil, " +
              std::to_string(tally.too_shallow) + " are shallower than minimum_depth, " +
              std::to_string(tally.no_answer) + " have no factor of safety",
          remedy_of(scene::lem_of(scene), model, tally)}});
}

}  // namespace breach::lem
