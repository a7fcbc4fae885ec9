// Compares strength profiles with each other, with strengths given for single phases, and with the
// ranges of their relations.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/check/region_strengths.hpp"
#include "core/check/section.hpp"
#include "core/check/subjects.hpp"
#include "core/words/number.hpp"

namespace breach::check {

namespace {

using materials::Place;

/// Relative difference of mean shear strengths that counts as equal [-].
constexpr double same = 0.05;
constexpr double least_difference = 100.0;  // Pa

/// A residual strength of the LEM and the range of the runout's, which softens: factor by which
/// its upper end, and its lower end, may differ where the other end agrees.
constexpr double same_residual = 1.5, softened_residual = 2.5;

std::string kilopascals(double stress) { return text(std::round(stress / 100.0) / 10.0) + " kPa"; }

/// Mean shear strengths of two entries, over the places where both are defined; none if one is
/// drained and the other undrained.
struct Means {
    Shear a{0.0, 0.0, true}, b{0.0, 0.0, true};
};
std::optional<Means> means_of(const View& a, const View& b, const std::vector<Place>& places) {
    Means means;
    double n = 0.0;
    for (const Place& place : places) {
        const auto one = a.at(place);
        const auto other = b.at(place);
        if (!one || !other || one->undrained != other->undrained) continue;
        means.a.low += one->low, means.a.high += one->high;
        means.b.low += other->low, means.b.high += other->high;
        ++n;
    }
    if (n == 0.0) return std::nullopt;
    for (double* sum : {&means.a.low, &means.a.high, &means.b.low, &means.b.high}) *sum /= n;
    return means;
}

/// Whether a single residual strength lies within a range, but far from both of its ends.
bool is_far_from_ends(const Shear& given, const Shear& range) {
    if (given.low != given.high || range.low == range.high) return false;
    const auto near = [&](double end, double factor) {
        return end <= same_residual * given.high && given.high <= factor * end;
    };
    return !near(range.low, same_residual) &&
           !(near(range.high, same_residual) && near(range.low, softened_residual));
}

bool differ(const Shear& a, const Shear& b) {
    const auto below = [](double high, double low) {
        return high < (1.0 - same) * low && low - high > least_difference;
    };
    return below(a.high, b.low) || below(b.high, a.low);
}

std::string kilopascals(const Shear& shear) {
    const std::string high = kilopascals(shear.high), low = kilopascals(shear.low);
    return low == high ? high : high + ", falling to " + low;
}

enum class Which { peak, residual };

void compare(const std::vector<View>& views, const std::string& region, Which which,
             const std::vector<Place>& places, Problems& problems) {
    const bool residual = which == Which::residual;
    for (std::size_t i = 0; i < views.size(); ++i) {
        for (std::size_t j = i + 1; j < views.size(); ++j) {
            if (views[i].pointer == views[j].pointer) continue;
            const auto means = means_of(views[i], views[j], places);
            if (!means) continue;
            const auto& [a, b] = *means;
            if (!differ(a, b) && !(residual && (is_far_from_ends(a, b) || is_far_from_ends(b, a))))
                continue;
            warn(problems, "strengths_differ", views[i].pointer,
                 "\"" + region + "\" has two " + (residual ? "residual" : "peak") +
                     " strengths, averaged over it: " + kilopascals(a) + " here (" +
                     views[i].phase + ") and " + kilopascals(b) + " by " + views[j].pointer + " (" +
                     views[j].phase +
                     "): the stronger phase fails too late or flows too short; write it once, in "
                     "its material's \"strength\", and leave the others out, or make them equal");
            return;
        }
    }
}

void check_relation(const materials::BySounding& by, const std::string& pointer,
                    double largest_stress, Problems& problems) {
    const materials::RelationFacts& facts = materials::facts_of(by.relation);
    const std::string range = std::string(facts.name) + " is for " + facts.sounding + " from " +
                              text(facts.range[0]) + " to " + text(facts.range[1]) +
                              " and sigma'_v0 up to " + kilopascals(facts.largest_stress);
    const auto outside = [&](const std::array<double, 2>& point) {
        return point[1] < facts.range[0] || point[1] > facts.range[1];
    };
    const auto& points = by.sounding.points;
    if (const auto found = std::ranges::find_if(points, outside); found != points.end())
        warn(problems, "outside_relation", pointer,
             "the sounding's " + text((*found)[1]) + " is outside the relation's range (" + range +
                 "): the value at the range's end is used");
    if (largest_stress > facts.largest_stress)
        warn(problems, "outside_relation", pointer,
             "sigma'_v0 reaches " + kilopascals(largest_stress) + " in this soil (" + range +
                 "): the relation is extrapolated there");
}

/// Refuses a residual strength above the peak.
void check_fall(const scene::Material& soil, const std::vector<Place>& places, Problems& problems) {
    double peak = 0.0;
    double residual = 0.0;
    for (const Place& place : places) {
        peak += shear_of(strength_at(soil.strength->peak, place), place).high;
        residual += shear_of(strength_at(*soil.strength->residual, place), place).high;
    }
    if (residual <= peak * (1.0 + 1e-9)) return;
    const auto n = static_cast<double>(places.size());
    refuse(problems, at_material(soil, "/strength/residual"),
           "is above the peak: " + kilopascals(residual / n) + " against " + kilopascals(peak / n) +
               ", averaged over its soil",
           "soil softens, it does not harden: lower the residual, or raise the peak");
}

/// Mean shear strength over the places where it is defined [Pa]; none if there is none.
std::optional<double> mean_of(const View& view, const std::vector<Place>& places) {
    double sum = 0.0, n = 0.0;
    for (const Place& place : places)
        if (const auto shear = view.at(place)) sum += shear->high, ++n;
    return n > 0.0 ? std::optional(sum / n) : std::nullopt;
}

/// Warns of residual strengths of single phases above the region's peak.
void warn_about_residuals(const RegionStrengths& region, const std::vector<Place>& places,
                          Problems& problems) {
    const std::vector<View> peaks = region.peaks();
    if (peaks.empty()) return;
    const auto peak = mean_of(peaks.front(), places);
    for (const View& residual : region.residuals()) {
        const auto left = mean_of(residual, places);
        if (!peak || !left || *left <= *peak * (1.0 + same) || *left - *peak < least_difference)
            continue;
        if (residual.phase == "profile") continue;  // reported by check_fall
        warn(problems, "implausible", residual.pointer,
             "the residual strength of \"" + region.name() +
                 "\" is above its peak: " + kilopascals(*left) + " against " + kilopascals(*peak) +
                 " by " + peaks.front().pointer +
                 ", averaged over it. Soil that has failed is no stronger than before: lower the "
                 "residual strength, or raise the peak");
    }
}

/// Warns of a cohesion that looks like a friction angle, or the reverse.
void warn_about_swapped(const scene::Material& soil, Problems& problems) {
    const auto look = [&](double c_Pa, double phi_rad, const char* entry) {
        const double c = c_Pa / 1e3, phi = phi_rad * 180.0 / std::numbers::pi;
        if (c < 20.0 || c > 45.0 || phi < 1.0 || phi > 12.0) return;
        const std::string angle = words::text_of(phi, 3), cohesion = words::text_of(c, 3);
        warn(problems, "implausible", at_material(soil, entry),
             "c_kPa " + cohesion + " and phi_deg " + angle +
                 " look swapped: write \"c_kPa\": " + angle + ", \"phi_deg\": " + cohesion);
    };
    if (const auto own = materials::limit_strength(soil.law))
        look(own->c, std::atan(own->tan_phi), "/law/phi_deg");
    if (const auto& own = soil.limit_strength) look(own->c, own->phi, "/limit_strength/phi_deg");
}

/// The FEM uses one strength per material.
void check_fem(const scene::Scene& scene, Problems& problems) {
    for (std::size_t r = 0; r < scene.section.regions.size(); ++r) {
        const scene::Material& soil = scene.material_of(r);
        if (!materials::has_strength_of_points(soil.law)) continue;
        const bool uniform =
            materials::is_uniform(soil.strength->peak) &&
            (!soil.strength->softening || materials::is_uniform(*soil.strength->residual));
        if (uniform) continue;
        refuse(problems, at_material(soil, "/law"),
               "leaves its strength to a profile that differs from place to place, and the FEM "
               "computes \"" +
                   scene.section.regions[r].name + "\" with one strength",
               "give the FEM's material a law of its own and map it in /transfer/mapping to this "
               "one; both may have the profile (\"strength\": {\"like\": ...})");
    }
}

}  // namespace

void check_strengths(const scene::Scene& scene, Problems& problems) {
    if (!is_whole(scene)) return;
    const scene::Ground ground(scene);
    std::vector<std::vector<Place>> places_of(scene.materials.size());
    for (std::size_t r = 0; r < scene.section.regions.size(); ++r) {
        std::vector<Place> places;
        for (const Vec2& each : spread_over(scene.section.regions[r].polygon))
            places.push_back(ground.at(each, r));
        if (places.empty()) continue;
        const RegionStrengths region(scene, ground, r);
        compare(region.peaks(), region.name(), Which::peak, places, problems);
        compare(region.residuals(), region.name(), Which::residual, places, problems);
        warn_about_residuals(region, places, problems);
        for (const scene::Soil& soil : scene::soils_of(scene))
            if (soil.region == r && soil.material < scene.materials.size()) {
                auto& all = places_of[soil.material];
                all.insert(all.end(), places.begin(), places.end());
            }
        auto& all = places_of[scene.section.regions[r].material];
        all.insert(all.end(), places.begin(), places.end());
    }
    for (std::size_t m = 0; m < scene.materials.size(); ++m) {
        const scene::Material& soil = scene.materials[m];
        if (!places_of[m].empty()) warn_about_swapped(soil, problems);
        if (!soil.strength || !soil.strength->residual || places_of[m].empty()) continue;
        const double largest =
            std::ranges::max_element(places_of[m], {}, &Place::sigma_v0)->sigma_v0;
        if (const auto* by = std::get_if<materials::BySounding>(&soil.strength->residual->kind))
            check_relation(*by, at_material(soil, "/strength/residual"), largest, problems);
        check_fall(soil, places_of[m], problems);
    }
    if (scene.fem) check_fem(scene, problems);
}

}  // namespace breach::check
