#include "core/check/region_strengths.hpp"

#include <algorithm>
#include <cmath>

#include "core/mechanics/atmosphere.hpp"

namespace breach::check {

namespace {

using materials::Place;
using materials::StrengthCurve;

/// A place to see whether a strength has friction or depends on stress.
Place stressed(double sigma_v0) { return {10.0, 0.0, sigma_v0}; }

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

bool has_own_strength(const scene::Material& soil) {
    return materials::traits(soil.law).c_and_phi && !materials::has_strength_of_points(soil.law);
}

/// Strength of a law with its residual, as a range.
Shear softening_shear(const materials::Law& law, const Place& place) {
    Shear shear = shear_of(*materials::limit_strength(law), place);
    if (const auto* softens = materials::softening(law); softens && shear.undrained)
        shear.low = std::min(shear.low, softens->c_residual);
    return shear;
}

bool is_undrained(const scene::Material& soil) {
    if (materials::has_strength_of_points(soil.law))
        return soil.strength &&
               materials::strength_at(soil.strength->peak, stressed(1e5)).tan_phi == 0.0;
    return has_own_strength(soil) && materials::limit_strength(soil.law)->tan_phi == 0.0;
}

}  // namespace

Shear shear_of(const materials::Strength& strength, const Place& place) {
    const double tau = strength.c + std::max(place.sigma_v0, 0.0) * strength.tan_phi;
    return {tau, tau, strength.tan_phi == 0.0};
}

std::string at_material(const scene::Material& material, const std::string& below) {
    return "/materials/" + material.name + below;
}

std::vector<scene::Vec2> spread_over(const geometry::Polygon& polygon) {
    constexpr int columns = 24, rows = 5;  // rows: on the mean height
    const geometry::Box box = geometry::bounding_box(polygon);
    const scene::Vec2 size = box.high - box.low;
    const double mean_height = geometry::area(polygon) / size.x();
    std::vector<scene::Vec2> points;
    for (int i = 0; i < columns; ++i) {
        const double x = box.low.x() + size.x() * (i + 0.5) / columns;
        const std::vector<double> heights = geometry::crossings(polygon, x);
        for (std::size_t k = 0; k + 1 < heights.size(); k += 2) {
            const double height = heights[k + 1] - heights[k];
            const double count = std::max(1.0, std::round(rows * height / mean_height));
            for (double j = 0.5; j < count; ++j)
                points.emplace_back(x, heights[k] + height * j / count);
        }
    }
    return points;
}

RegionStrengths::RegionStrengths(const scene::Scene& scene, const scene::Ground& ground,
                                 std::size_t region)
    : scene_(scene),
      region_(region),
      own_(scene.materials[at().material]),
      r_u_(std::clamp(ground.r_u_at_base(region), 0.0, 0.9)) {
    for (const scene::Soil& soil : scene::soils_of(scene))
        if (soil.region == region && soil.material < scene.materials.size() &&
            !is_layer(soil.material))
            points_.push_back(&scene.materials[soil.material]);
}

std::optional<View> RegionStrengths::lem_peak() const {
    for (std::size_t i = 0; i < scene_.lem->undrained.size(); ++i)
        if (scene_.lem->undrained[i].region == region_)
            return view_of("/lem/undrained/" + std::to_string(i), scene_.lem->undrained[i]);
    if (own_.limit_strength) {
        const auto [c, phi] = *own_.limit_strength;
        return view_of("LEM", at_material(own_, "/limit_strength"),
                       materials::Strength{c, std::tan(phi)});
    }
    if (scene::lem_takes_profile(own_))
        return view_of("LEM", at_material(own_, "/strength/peak"), own_.strength->peak);
    if (!has_own_strength(own_)) return std::nullopt;
    return view_of("LEM", at_material(own_, "/law"), *materials::limit_strength(own_.law));
}

bool RegionStrengths::lem_depends_on_water() const {
    if (const auto view = lem_peak()) {
        const auto shallow = view->at(stressed(1e5)), deep = view->at(stressed(2e5));
        return !shallow || !deep || shallow->high != deep->high;
    }
    const auto of_law = materials::limit_strength(own_.law);
    return of_law && of_law->tan_phi > 0.0;
}

/// Friction of the MPM acts on the total stress. Friction that is reduced below that of
/// limit_strength, at most for the pore pressure on the region's base, stands for all of it.
View RegionStrengths::points_view(const scene::Material& soil) const {
    materials::Strength strength = *materials::limit_strength(soil.law);
    if (own_.limit_strength) {
        constexpr double rounding = 0.97;
        const double drained = std::tan(own_.limit_strength->phi);
        if (strength.tan_phi >= rounding * (1.0 - r_u_) * drained)
            strength.tan_phi = std::max(strength.tan_phi, drained);
    }
    return view_of("MPM", at_material(soil, "/law"), strength);
}

std::vector<View> RegionStrengths::peaks() const {
    std::vector<View> views;
    const std::vector<const scene::Material*> own_profiles = profiles();
    if (scene_.lem)
        if (auto view = lem_peak()) views.push_back(std::move(*view));
    if (scene_.fem && !own_profiles.empty() && has_own_strength(own_))
        views.push_back(
            view_of("FEM", at_material(own_, "/law"), *materials::limit_strength(own_.law)));
    if (scene_.mpm)
        for (const scene::Material* each : points_) {
            if (materials::has_strength_of_points(each->law))
                views.push_back(
                    view_of("MPM", at_material(*each, "/strength/peak"), each->strength->peak));
            else if (has_own_strength(*each))
                views.push_back(points_view(*each));
        }
    for (const scene::Material* each : own_profiles)
        views.push_back(
            view_of("profile", at_material(*each, "/strength/peak"), each->strength->peak));
    return views;
}

std::vector<View> RegionStrengths::residuals() const {
    std::vector<View> views;
    if (scene_.lem)
        for (std::size_t i = 0; i < scene_.lem->liquefaction.size(); ++i) {
            const scene::UndrainedRegion& entry = scene_.lem->liquefaction[i];
            const bool of_profile =
                entry.strength.is_of_profile() && own_.strength && own_.strength->residual;
            if (entry.region == region_ && !of_profile)
                views.push_back(view_of("/lem/liquefaction/" + std::to_string(i), entry));
        }
    if (is_layered()) {
        views.push_back(layers_view());
    } else if (liquefied_in_runout()) {
        for (const scene::Material* each : points_)
            if (is_undrained(*each) && has_own_strength(*each))
                views.push_back({"MPM", at_material(*each, "/law"),
                                 [each](const Place& place) -> std::optional<Shear> {
                                     return softening_shear(each->law, place);
                                 }});
    }
    for (const scene::Material* each : profiles())
        if (each->strength->residual)
            views.push_back(view_of("profile", at_material(*each, "/strength/residual"),
                                    *each->strength->residual));
    return views;
}

std::optional<std::string> RegionStrengths::liquefied_in_runout() const {
    if (may_liquefy_by_transfer()) return "/transfer/liquefied/regions";
    if (!scene_.mpm || !scene_.lem) return std::nullopt;
    const auto peak = lem_peak();
    const auto shear = peak ? peak->at(stressed(1e5)) : std::nullopt;
    if (!shear || shear->undrained) return std::nullopt;
    for (const scene::Material* each : points_)
        if (is_undrained(*each))
            return at_material(*each,
                               materials::has_strength_of_points(each->law) ? "/strength" : "/law");
    return std::nullopt;
}

bool RegionStrengths::is_weak_in_runout() const {
    return may_liquefy_by_transfer() || std::ranges::any_of(points_, [](const auto* each) {
               return is_undrained(*each) || (each->strength && each->strength->residual);
           });
}

bool RegionStrengths::is_liquefied_in_lem() const {
    return scene_.lem && std::ranges::count(scene_.lem->liquefaction, region_,
                                            &scene::UndrainedRegion::region) > 0;
}

bool RegionStrengths::is_undrained_in_lem() const {
    return scene_.lem &&
           std::ranges::count(scene_.lem->undrained, region_, &scene::UndrainedRegion::region) > 0;
}

bool RegionStrengths::may_liquefy_by_transfer() const {
    return scene_.fem && scene_.transfer && scene_.transfer->liquefied &&
           std::ranges::count(scene_.transfer->liquefied->regions, region_) > 0;
}

bool RegionStrengths::is_layered() const {
    return scene_.mpm && may_liquefy_by_transfer() && !scene_.transfer->liquefied->layers.empty();
}

bool RegionStrengths::is_layer(std::size_t material) const {
    return is_layered() && std::ranges::count(scene_.transfer->liquefied->layers, material,
                                              &scene::LiquefiedLayer::material) > 0;
}

/// Profiles of the region's materials, each once.
std::vector<const scene::Material*> RegionStrengths::profiles() const {
    std::vector<const scene::Material*> found;
    if (own_.strength) found.push_back(&own_);
    for (const scene::Material* each : points_)
        if (each->strength && std::ranges::find(found, each) == found.end()) found.push_back(each);
    return found;
}

View RegionStrengths::layers_view() const {
    return {"MPM", "/transfer/liquefied/layers",
            [this](const Place& place) -> std::optional<Shear> {
                const auto& layers = scene_.transfer->liquefied->layers;
                const auto below = std::ranges::find_if(
                    layers, [&](const auto& each) { return place.sigma_v0 < each.to; });
                const auto& layer = below == layers.end() ? layers.back() : *below;
                if (layer.material >= scene_.materials.size()) return std::nullopt;
                const scene::Material& soil = scene_.materials[layer.material];
                if (!has_own_strength(soil)) return std::nullopt;
                return softening_shear(soil.law, place);
            }};
}

}  // namespace breach::check
