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

json facts_of(const Bent& bent, const Slices& slices) {
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
               {"frictionless_mass", bent.frictionless_mass},
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
    return facts_of(*found, slices);
}

json optimised_polyline(const scene::Scene& scene, const Model& model,
                        const std::vector<Start>& starts) {
    const auto found = optimise(model, room_of(*scene.lem, model.strata), starts);
    if (!found) return nullptr;
    Slices slices = make_slices(model.strata, model.slices);
    json facts = facts_of(*analyse(model, found->best.surface, slices), slices);
    // For comparison: what the descent gained over the circle by the same method.
    if (std::isfinite(found->start)) facts["start_factor_of_safety"] = found->start;
    facts["surfaces_analysed"] = found->analysed;
    if (std::isfinite(found->error)) facts["search_error"] = found->error;
    return facts;
}

bool kinks_without_friction(const json& polyline) {
    return kinked_without_friction(polyline.at("frictionless_share"),
                                   polyline.at("frictionless_mass")) >= 0.0;
}

}  // namespace breach::lem
