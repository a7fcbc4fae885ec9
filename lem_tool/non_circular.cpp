#include "lem_tool/non_circular.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "lem_tool/optimise.hpp"

namespace breach::lem {

using nlohmann::json;

namespace {

/// Ends of a given surface may be so far off the ground, of the model's height: drawings are.
constexpr double loose_end = 2e-3;

/// By less an optimised surface may always be lower than its circle.
constexpr double telling_fall = 0.03;

json facts_of(const Bent& bent) {
    json points = json::array();
    for (const scene::Vec2& p : bent.surface.points) points.push_back({p.x(), p.y()});
    return {{"factor_of_safety", bent.spencer.factor_of_safety},
            {"method", "spencer"},
            {"interslice_inclination", bent.spencer.theta},
            {"least_m_alpha", bent.spencer.m_alpha},
            {"sliding_depth", bent.depth},
            {"frictionless_share", bent.frictionless},
            {"points", points}};
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

/// The given surface with its ends put where they belong.
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
    return facts_of(*found);
}

json optimised_polyline(const scene::Scene& scene, const Model& model, const Surface& circle) {
    const auto found = optimise(model, room_of(*scene.lem, model.strata), circle);
    if (!found) return nullptr;
    json facts = facts_of(found->best);
    facts["start_factor_of_safety"] = found->start;
    facts["surfaces_analysed"] = found->analysed;
    return facts;
}

std::vector<fault::Flag> flags_of_polyline(const json& optimised) {
    if (optimised.is_null() || optimised.at("frictionless_share") < 0.5) return {};
    const double F = optimised.at("factor_of_safety");
    const double start = optimised.at("start_factor_of_safety");
    if (F > start * (1.0 - telling_fall)) return {};
    std::ostringstream words;
    words.precision(3);
    words << "the optimised surface has a factor of safety of " << F << ", its circle " << start
          << ": most of its base is without friction, where a kinked mass shears within itself and "
             "Spencer's method does not see the strength that this takes; believe the circle";
    return {{"kinked_without_friction", fault::Severity::warning, words.str(),
             "/lem/non_circular/vertices"}};
}

}  // namespace breach::lem
