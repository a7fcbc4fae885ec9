// Compares strength profiles with each other, with strengths given for single phases, and with the
// ranges of their relations.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "core/check/findings.hpp"
#include "core/check/section.hpp"
#include "core/mechanics/atmosphere.hpp"
#include "core/scene/ground.hpp"
#include "core/words/number.hpp"

namespace breach::check {

namespace {

using materials::Place;
using materials::StrengthCurve;

/// Relative difference of mean shear strengths that counts as equal [-].
constexpr double same = 0.05;
constexpr double least_difference = 100.0;  // Pa

/// Range of the shear strength at a place [Pa], from residual to peak.
struct Shear {
    double low, high;
    bool undrained;
};

/// A strength of a region's soil for one phase, and its scene entry.
struct View {
    std::string phase;
    std::string pointer;
    std::function<std::optional<Shear>(const Place&)> at;
};

Shear shear_of(const materials::Strength& strength, const Place& place) {
    const double tau = strength.c + std::max(place.sigma_v0, 0.0) * strength.tan_phi;
    return {tau, tau, strength.tan_phi == 0.0};
}

std::string at_material(const scene::Material& material, const std::string& below) {
    return "/materials/" + material.name + below;
}

View view_of(std::string phase, std::string pointer, const StrengthCurve& curve) {
    return {std::move(phase), std::move(pointer),
            [&curve](const Place& place) { return shear_of(strength_at(curve, place), place); }};
}

View view_of(std::string phase, std::string pointer, const materials::Strength& strength) {
    return {std::move(phase), std::move(pointer),
            [strength](const Place& place) { return shear_of(strength, place); }};
}

View view_of(std::string pointer, const scene::UndrainedRegion& entry) {
    return {"LEM", std::move(pointer), [&entry](const Place& place) -> std::optional<Shear> {
                const bool beside = entry.levels && (place.elevation < (*entry.levels)[0] ||
                                                     place.elevation >= (*entry.levels)[1]);
                if (beside || entry.strength.on_path) return std::nullopt;  // by the law
                const scene::UndrainedStrength& s = entry.strength;
                const double s_u =
                    s.constant + s.coefficient * std::pow(std::max(place.sigma_v0, 0.0) /
                                                              mechanics::standard_atmosphere,
                                                          s.exponent);
                return Shear{s_u, s_u, true};
            }};
}

class Region {
  public:
    Region(const scene::Scene& scene, std::size_t region)
        : scene_(scene), region_(region), own_(scene.materials[at().material]) {
        for (const scene::Soil& soil : scene::soils_of(scene))
            if (soil.region == region && !is_layer(soil.material))
                points_.push_back(&scene.materials[soil.material]);
    }

    std::vector<View> peaks() const {
        std::vector<View> views;
        if (scene_.lem) add_lem_peak(views);
        const bool has_profile = has_any_profile();
        if (scene_.fem && has_profile) add_law("FEM", own_, views);
        if (scene_.mpm)
            for (const scene::Material* each : points_) {
                if (materials::has_strength_of_points(each->law))
                    views.push_back(
                        view_of("MPM", at_material(*each, "/strength/peak"), each->strength->peak));
                else
                    add_law("MPM", *each, views);
            }
        for (const scene::Material* each : profiles())
            views.push_back(
                view_of("profile", at_material(*each, "/strength/peak"), each->strength->peak));
        return views;
    }

    std::vector<View> residuals() const {
        std::vector<View> views;
        if (scene_.lem)
            for (std::size_t i = 0; i < scene_.lem->liquefaction.size(); ++i) {
                const scene::UndrainedRegion& entry = scene_.lem->liquefaction[i];
                const bool of_profile =
                    entry.strength.is_of_profile() && own_.strength && own_.strength->residual;
                if (entry.region == region_ && !of_profile)
                    views.push_back(view_of("/lem/liquefaction/" + std::to_string(i), entry));
            }
        if (is_layered()) views.push_back(layers_view());
        for (const scene::Material* each : profiles())
            if (each->strength->residual)
                views.push_back(view_of("profile", at_material(*each, "/strength/residual"),
                                        *each->strength->residual));
        return views;
    }

  private:
    const scene::Region& at() const { return scene_.section.regions[region_]; }

    bool is_layered() const {
        const auto& liquefied = scene_.transfer ? scene_.transfer->liquefied : std::nullopt;
        return scene_.mpm && liquefied && !liquefied->layers.empty() &&
               std::ranges::count(liquefied->regions, region_) > 0;
    }

    bool is_layer(std::size_t material) const {
        return is_layered() && std::ranges::count(scene_.transfer->liquefied->layers, material,
                                                  &scene::LiquefiedLayer::material) > 0;
    }

    /// Profiles of the region's materials, each once.
    std::vector<const scene::Material*> profiles() const {
        std::vector<const scene::Material*> found;
        if (own_.strength) found.push_back(&own_);
        for (const scene::Material* each : points_)
            if (each->strength && std::ranges::find(found, each) == found.end())
                found.push_back(each);
        return found;
    }
    bool has_any_profile() const { return !profiles().empty(); }

    void add_law(const std::string& phase, const scene::Material& soil,
                 std::vector<View>& views) const {
        if (!materials::traits(soil.law).c_and_phi || materials::has_strength_of_points(soil.law))
            return;
        views.push_back(
            view_of(phase, at_material(soil, "/law"), *materials::limit_strength(soil.law)));
    }

    void add_lem_peak(std::vector<View>& views) const {
        for (std::size_t i = 0; i < scene_.lem->undrained.size(); ++i) {
            const scene::UndrainedRegion& entry = scene_.lem->undrained[i];
            if (entry.region != region_) continue;
            views.push_back(view_of("/lem/undrained/" + std::to_string(i), entry));
            return;
        }
        if (own_.limit_strength) {
            const auto [c, phi] = *own_.limit_strength;
            views.push_back(view_of("LEM", at_material(own_, "/limit_strength"),
                                    materials::Strength{c, std::tan(phi)}));
        } else if (scene::lem_takes_profile(own_)) {
            views.push_back(
                view_of("LEM", at_material(own_, "/strength/peak"), own_.strength->peak));
        } else {
            add_law("LEM", own_, views);
        }
    }

    View layers_view() const {
        return {"MPM", "/transfer/liquefied/layers",
                [this](const Place& place) -> std::optional<Shear> {
                    const auto& layers = scene_.transfer->liquefied->layers;
                    const auto below = std::ranges::find_if(
                        layers, [&](const auto& each) { return place.sigma_v0 < each.to; });
                    const auto& layer = below == layers.end() ? layers.back() : *below;
                    if (layer.material >= scene_.materials.size()) return std::nullopt;
                    const materials::Law& law = scene_.materials[layer.material].law;
                    if (!materials::traits(law).c_and_phi) return std::nullopt;
                    Shear shear = shear_of(*materials::limit_strength(law), place);
                    if (const auto* softens = materials::softening(law))
                        shear.low = std::min(shear.low, softens->c_residual);
                    return shear;
                }};
    }

    const scene::Scene& scene_;
    std::size_t region_;
    const scene::Material& own_;
    std::vector<const scene::Material*> points_;  ///< materials of its unliquefied soil in the MPM
};

/// Sample places over a region.
std::vector<Place> places_in(const scene::Scene& scene, const scene::Ground& ground,
                             std::size_t region) {
    constexpr int along = 6;
    const geometry::Polygon& polygon = scene.section.regions[region].polygon;
    const geometry::Box box = geometry::bounding_box(polygon);
    std::vector<Place> places;
    for (int i = 0; i < along; ++i) {
        for (int j = 0; j < along; ++j) {
            const Vec2 at{box.low.x() + (box.high.x() - box.low.x()) * (i + 0.5) / along,
                          box.low.y() + (box.high.y() - box.low.y()) * (j + 0.5) / along};
            if (geometry::contains(polygon, at)) places.push_back(ground.at(at, region));
        }
    }
    return places;
}

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

bool differ(const Shear& a, const Shear& b) {
    const auto below = [](double high, double low) {
        return high < (1.0 - same) * low && low - high > least_difference;
    };
    return below(a.high, b.low) || below(b.high, a.low);
}

void compare(const std::vector<View>& views, const std::string& region, const std::string& which,
             const std::vector<Place>& places, Findings& findings) {
    for (std::size_t i = 0; i < views.size(); ++i) {
        for (std::size_t j = i + 1; j < views.size(); ++j) {
            if (views[i].pointer == views[j].pointer) continue;
            const auto means = means_of(views[i], views[j], places);
            if (!means || !differ(means->a, means->b)) continue;
            warn(findings, "strengths_differ", views[i].pointer,
                 "\"" + region + "\" has two " + which +
                     " strengths, averaged over it: " + kilopascals(means->a.high) + " here (" +
                     views[i].phase + ") and " + kilopascals(means->b.high) + " by " +
                     views[j].pointer + " (" + views[j].phase +
                     "); write it once, in its material's \"strength\", and leave the others out");
            return;
        }
    }
}

void check_relation(const materials::BySounding& by, const std::string& pointer,
                    double largest_stress, Findings& findings) {
    const materials::RelationFacts& facts = materials::facts_of(by.relation);
    const std::string range = std::string(facts.name) + " is for " + facts.sounding + " from " +
                              text(facts.range[0]) + " to " + text(facts.range[1]) +
                              " and sigma'_v0 up to " + kilopascals(facts.largest_stress);
    const auto outside = [&](const std::array<double, 2>& point) {
        return point[1] < facts.range[0] || point[1] > facts.range[1];
    };
    const auto& points = by.sounding.points;
    if (const auto found = std::ranges::find_if(points, outside); found != points.end())
        warn(findings, "outside_relation", pointer,
             "the sounding's " + text((*found)[1]) + " is outside the relation's range (" + range +
                 "): the value at the range's end is used");
    if (largest_stress > facts.largest_stress)
        warn(findings, "outside_relation", pointer,
             "sigma'_v0 reaches " + kilopascals(largest_stress) + " in this soil (" + range +
                 "): the relation is extrapolated there");
}

/// Refuses a residual strength above the peak.
void check_fall(const scene::Material& soil, const std::vector<Place>& places, Findings& findings) {
    double peak = 0.0;
    double residual = 0.0;
    for (const Place& place : places) {
        peak += shear_of(strength_at(soil.strength->peak, place), place).high;
        residual += shear_of(strength_at(*soil.strength->residual, place), place).high;
    }
    if (residual <= peak * (1.0 + 1e-9)) return;
    const auto n = static_cast<double>(places.size());
    refuse(findings, at_material(soil, "/strength/residual"),
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
void warn_about_residuals(const Region& region, const std::string& name,
                          const std::vector<Place>& places, Findings& findings) {
    const std::vector<View> peaks = region.peaks();
    if (peaks.empty()) return;
    const auto peak = mean_of(peaks.front(), places);
    for (const View& residual : region.residuals()) {
        const auto left = mean_of(residual, places);
        if (!peak || !left || *left <= *peak * (1.0 + same) || *left - *peak < least_difference)
            continue;
        if (residual.phase == "profile") continue;  // reported by check_fall
        warn(findings, "implausible", residual.pointer,
             "the residual strength of \"" + name + "\" is above its peak: " + kilopascals(*left) +
                 " against " + kilopascals(*peak) + " by " + peaks.front().pointer +
                 ", averaged over it. Soil that has failed is no stronger than before: lower the "
                 "residual strength, or raise the peak");
    }
}

/// Warns of a cohesion that looks like a friction angle, or the reverse.
void warn_about_swapped(const scene::Material& soil, Findings& findings) {
    const auto look = [&](double c_Pa, double phi_rad, const char* entry) {
        const double c = c_Pa / 1e3, phi = phi_rad * 180.0 / std::numbers::pi;
        if (c < 20.0 || c > 45.0 || phi < 1.0 || phi > 12.0) return;
        const std::string angle = words::text_of(phi, 3), cohesion = words::text_of(c, 3);
        warn(findings, "implausible", at_material(soil, entry),
             "c_kPa " + cohesion + " and phi_deg " + angle +
                 " look swapped: write \"c_kPa\": " + angle + ", \"phi_deg\": " + cohesion);
    };
    if (const auto own = materials::limit_strength(soil.law))
        look(own->c, std::atan(own->tan_phi), "/law/phi_deg");
    if (const auto& own = soil.limit_strength) look(own->c, own->phi, "/limit_strength/phi_deg");
}

bool is_whole(const scene::Scene& scene) {
    return std::ranges::all_of(scene.section.regions, [&](const scene::Region& region) {
        return !region.polygon.empty() && region.material < scene.materials.size();
    });
}

bool asks_for_stress(const scene::Material& soil) {
    return soil.strength &&
           (materials::needs_stress(soil.strength->peak) ||
            (soil.strength->residual && materials::needs_stress(*soil.strength->residual)));
}

/// The FEM uses one strength per material.
void check_fem(const scene::Scene& scene, Findings& findings) {
    for (std::size_t r = 0; r < scene.section.regions.size(); ++r) {
        const scene::Material& soil = scene.materials[scene.section.regions[r].material];
        if (!materials::has_strength_of_points(soil.law)) continue;
        const bool uniform =
            materials::is_uniform(soil.strength->peak) &&
            (!soil.strength->softening || materials::is_uniform(*soil.strength->residual));
        if (uniform) continue;
        refuse(findings, at_material(soil, "/law"),
               "leaves its strength to a profile that differs from place to place, and the FEM "
               "computes \"" +
                   scene.section.regions[r].name + "\" with one strength",
               "give the FEM's material a law of its own and map it in /transfer/mapping to this "
               "one; both may have the profile (\"strength\": {\"like\": ...})");
    }
}

}  // namespace

void check_strengths(const scene::Scene& scene, Findings& findings) {
    if (!is_whole(scene)) return;
    const scene::Ground ground(scene);
    std::vector<std::vector<Place>> places_of(scene.materials.size());
    for (std::size_t r = 0; r < scene.section.regions.size(); ++r) {
        const std::vector<Place> places = places_in(scene, ground, r);
        if (places.empty()) continue;
        const Region region(scene, r);
        const std::string& name = scene.section.regions[r].name;
        compare(region.peaks(), name, "peak", places, findings);
        compare(region.residuals(), name, "residual", places, findings);
        warn_about_residuals(region, name, places, findings);
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
        if (!places_of[m].empty()) warn_about_swapped(soil, findings);
        if (!soil.strength || !soil.strength->residual || places_of[m].empty()) continue;
        const double largest =
            std::ranges::max_element(places_of[m], {}, &Place::sigma_v0)->sigma_v0;
        if (const auto* by = std::get_if<materials::BySounding>(&soil.strength->residual->kind))
            check_relation(*by, at_material(soil, "/strength/residual"), largest, findings);
        check_fall(soil, places_of[m], findings);
    }
    if (scene.fem) check_fem(scene, findings);
    const bool lem_dry = scene.lem && !scene.lem->water && scene.lem->piezometric_lines.empty() &&
                         scene.lem->pore_pressure_ratios.empty();
    if (lem_dry && scene.fem && scene.fem->water &&
        std::ranges::any_of(scene.materials, asks_for_stress))
        warn(findings, "strengths_differ", "/lem/water",
             "is missing, and /fem/water has a line: a strength by sigma'_v0 is another one in the "
             "LEM; give both the same line");
}

}  // namespace breach::check
