#include "lem_tool/non_circular.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "lem_tool/optimise.hpp"

namespace breach::lem {

using nlohmann::json;

namespace {

/// Tolerance for ends of a given surface off the ground, over the model's height.
constexpr double loose_end = 2e-3;

json point_of(const scene::Vec2& p) { return json::array({p.x(), p.y()}); }

/// Share of the mass's area without friction.
double frictionless_mass(const Model& model, const Slices& slices) {
    double all = 0.0;
    double without = 0.0;
    for (std::size_t i = 0; i < slices.count; ++i) {
        const double x = slices.left[i] + 0.5 * slices.width[i];
        const Strip& strip = model.strata.strips[strip_at(model.strata, x)];
        for (std::size_t k = strip.first; k < strip.last; ++k) {
            const Layer& layer = model.strata.layers[k];
            const double top = layer.top.at(x);
            // Layers are ordered from the ground down: the rest is below the surface.
            if (top <= slices.base[i]) break;
            const double bottom =
                k + 1 < strip.last ? std::max(slices.base[i], model.strata.layers[k + 1].top.at(x))
                                   : slices.base[i];
            const Soil& soil = model.soils[layer.region];
            all += slices.width[i] * (top - bottom);
            if (soil.tan_phi > 0.0) continue;
            const double wet =
                soil.above_water && soil.line
                    ? std::min(top, model.strata.pressures[strip.pressures + *soil.line].top.at(x))
                    : top;
            without += slices.width[i] * std::max(0.0, wet - bottom);
        }
    }
    return without / all;
}

/// Expects the surface's slices in `slices`.
json facts_of(const Model& model, const Bent& bent, const Slices& slices) {
    const std::vector<scene::Vec2>& points = bent.surface.points;
    const bool falls_right = points.front().y() > points.back().y();
    const auto lowest = std::ranges::min_element(points, {}, [](const auto& p) { return p.y(); });
    json facts{{"factor_of_safety", bent.spencer.factor_of_safety},
               {"method", "spencer"},
               {"interslice_inclination", bent.spencer.theta},
               {"least_m_alpha", bent.spencer.m_alpha},
               {"sliding_depth", bent.depth},
               {"entry", point_of(falls_right ? points.front() : points.back())},
               {"exit", point_of(falls_right ? points.back() : points.front())},
               {"lowest_point", point_of(*lowest)},
               {"slices", slices.count},
               {"frictionless_share", bent.frictionless},
               {"frictionless_mass", frictionless_mass(model, slices)},
               {"points", json::array()}};
    for (const scene::Vec2& p : points) facts["points"].push_back(point_of(p));
    return facts;
}

[[noreturn]] void refuse(const scene::Scene& scene, const std::string& what,
                         const std::string& remedy) {
    throw fault::BadInput(scene.name, {{"/lem/non_circular/given", what, remedy}});
}

double height_of(const Strata& strata) {
    double low = strata.ground(strata.strips.front()).at(strata.left());
    double high = low;
    for (const Strip& strip : strata.strips) {
        for (const double x : {strip.from, strip.to}) {
            low = std::min(low, strip.bottom.at(x));
            high = std::max(high, strata.ground(strip).at(x));
        }
    }
    return high - low;
}

/// The given surface with its ends moved onto the ground.
Polyline placed(const scene::Scene& scene, const Strata& strata) {
    Polyline polyline{scene.lem->non_circular->given, CrackAt::none};
    std::vector<scene::Vec2>& points = polyline.points;
    if (points.front().x() < strata.left() || points.back().x() > strata.right())
        refuse(scene, "reaches beyond the section", "end it on the section's ground");
    const bool upper_left = points.front().y() > points.back().y();
    if (strata.crack.reach != Crack::Reach::none)
        polyline.crack = upper_left ? CrackAt::left : CrackAt::right;
    const auto place = [&](scene::Vec2& p, SurfaceEnd end) {
        const double level = end_level(strata, p.x(), end);
        // Ends from a drawing or another program are rounded; farther off, another surface was
        // meant.
        if (std::abs(p.y() - level) > loose_end * height_of(strata)) {
            std::ostringstream words;
            words << "ends at (" << p.x() << ", " << p.y()
                  << "), where a surface would end at y = " << level;
            refuse(scene, words.str(),
                   "end it on the ground, its upper end at the foot of the tension crack if there "
                   "is one");
        }
        p.y() = level;
    };
    place(points.front(), upper_left ? SurfaceEnd::upper : SurfaceEnd::lower);
    place(points.back(), upper_left ? SurfaceEnd::lower : SurfaceEnd::upper);
    return polyline;
}

}  // namespace

json given_polyline(const scene::Scene& scene, const Model& model) {
    Slices slices = make_slices(model.strata, model.slices);
    const auto found = analyse(model, placed(scene, model.strata), slices);
    if (!found)
        refuse(scene,
               "has no factor of safety by Spencer's method: it leaves the soil, passes a region "
               "that cannot fail, or no inclination of the interslice forces balances it",
               "give a surface within soil that can fail, without pieces steeper than the slide "
               "can follow");
    return facts_of(model, *found, slices);
}

json optimised_polyline(const scene::Scene& scene, const Model& model,
                        const std::vector<Start>& starts) {
    const auto found = optimise(model, room_of(*scene.lem, model.strata), starts);
    if (!found) return nullptr;
    Slices slices = make_slices(model.strata, model.slices);
    json facts = facts_of(model, *analyse(model, found->best.surface, slices), slices);
    // For comparison: what the descent gained over the circle by the same method.
    const auto if_known = [](double value) { return std::isfinite(value) ? json(value) : json(); };
    facts["start_factor_of_safety"] = if_known(found->start);
    facts["surfaces_analysed"] = found->analysed;
    facts["search_error"] = if_known(found->error);
    return facts;
}

bool kinks_without_friction(const json& polyline) {
    constexpr double most_of_base = 0.5;
    constexpr double thin_layer = 0.1;  // over the mass: the soil above the layer deforms at kinks
    return polyline.at("frictionless_share") >= most_of_base &&
           polyline.at("frictionless_mass") >= thin_layer;
}

}  // namespace breach::lem
