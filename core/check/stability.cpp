#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/check/section.hpp"
#include "core/check/subjects.hpp"
#include "core/words/remedy.hpp"

namespace breach::check {

namespace {

// of the section's height; thinner gaps are inaccuracies of a drawing
constexpr double gap_share = 1e-3;

/// Refuses holes below the ground: slices are vertical.
bool check_slices(const scene::Scene& scene, Problems& problems) {
    const geometry::Box box = extent(scene.section);
    const double allowed = gap_share * (box.high.y() - box.low.y());
    const std::vector<double> xs = abscissae(scene.section);
    const std::string remedy =
        "limit equilibrium cuts vertical slices: give regions that touch from the ground to the "
        "bottom of the model, without overhang";
    for (std::size_t i = 0; i + 1 < xs.size(); ++i) {
        const double x = 0.5 * (xs[i] + xs[i + 1]);
        const std::vector<Stratum> strata = strata_at(scene.section, x);
        if (strata.empty()) {
            refuse(problems, "/section/regions",
                   "leave nothing between x = " + metres(xs[i]) + " and " + metres(xs[i + 1]),
                   remedy);
            return false;
        }
        for (std::size_t k = 1; k < strata.size(); ++k) {
            if (strata[k - 1].bottom - strata[k].top <= allowed) continue;
            const auto& regions = scene.section.regions;
            refuse(problems, "/section/regions",
                   "leave air below ground at x = " + metres(x) +
                       ", from y = " + metres(strata[k].top) + " (\"" +
                       regions[strata[k].region].name + "\") to " + metres(strata[k - 1].bottom) +
                       " (\"" + regions[strata[k - 1].region].name + "\")",
                   remedy);
            return false;
        }
    }
    return true;
}

/// Refuses an x range outside the section.
bool check_range(const scene::Scene& scene, const std::array<double, 2>& range,
                 const std::string& pointer, Problems& problems) {
    if (range[0] > range[1]) return false;  // reported by core/scene
    if (!check_beside(scene, range[0], range[1], pointer, problems)) return false;
    if (const geometry::Levels over = ground_over(scene.section, range[0], range[1]);
        over.highest < over.lowest) {
        refuse(problems, pointer,
               "lies in a gap of the section: x from " + text(range[0]) + " to " + metres(range[1]),
               "give a range with ground below it");
        return false;
    }
    const geometry::Box box = extent(scene.section);
    const double near = 1e-9 * (box.high.x() - box.low.x());
    if (range[0] < box.low.x() - near || range[1] > box.high.x() + near)
        warn(problems, "beyond_ground", pointer,
             "part of [" + text(range[0]) + ", " + text(range[1]) + "] has no ground below it; " +
                 words::set(pointer, std::array{std::max(range[0], box.low.x()),
                                                std::min(range[1], box.high.x())}));
    return true;
}

void check_search(const scene::Scene& scene, const scene::SlipSearch& search, Problems& problems) {
    const bool entry = check_range(scene, search.entry, "/lem/search/entry", problems);
    const bool exit = check_range(scene, search.exit, "/lem/search/exit", problems);
    if (!entry || !exit) return;
    const geometry::Levels upper = ground_over(scene.section, search.entry[0], search.entry[1]);
    const geometry::Levels lower = ground_over(scene.section, search.exit[0], search.exit[1]);
    if (upper.highest <= lower.lowest)
        refuse(problems, "/lem/search/entry",
               "lies at most at " + metres(upper.highest) + ", and exit nowhere below " +
                   metres(lower.lowest),
               "put entry on the upper and exit on the lower side of the slope");
    const geometry::Box box = extent(scene.section);
    const geometry::Levels ground = ground_over(scene.section, box.low.x(), box.high.x());
    if (search.lowest_level && *search.lowest_level >= ground.highest)
        refuse(problems, "/lem/search/lowest_level",
               "is not below the ground's highest level, " + metres(ground.highest),
               "give a level below the ground, or leave it out");
    if (search.minimum_depth >= ground.highest - box.low.y())
        refuse(problems, "/lem/search/minimum_depth",
               "is more than the section's height, " + metres(ground.highest - box.low.y()),
               "give a depth within the section");
}

/// The crack must not be deeper than the section and must start in its ground.
void check_crack(const scene::Scene& scene, const scene::TensionCrack& crack, Problems& problems) {
    const geometry::Box box = extent(scene.section);
    const std::string remedy =
        "give the depth to which the soil stands open, about 2 c / gamma tan(45 + phi / 2), or "
        "delete /lem/tension_crack";
    const double height = box.high.y() - box.low.y();
    if (crack.depth && *crack.depth >= height)
        refuse(
            problems, "/lem/tension_crack/depth",
            "is " + metres(*crack.depth) + ", and the section is only " + metres(height) + " high",
            remedy);
    if (crack.level && *crack.level <= box.low.y())
        refuse(problems, "/lem/tension_crack/level",
               "is " + metres(*crack.level) + ", and the section ends at " + metres(box.low.y()),
               remedy);
    if (crack.level && *crack.level >= box.high.y())
        refuse(problems, "/lem/tension_crack/level",
               "is " + metres(*crack.level) + ", above all ground, which reaches up to " +
                   metres(box.high.y()) + ": there is no crack",
               remedy);
}

void check_circle(const scene::Scene& scene, const scene::Circle& circle, Problems& problems) {
    const geometry::Box box = extent(scene.section);
    constexpr int samples = 256;
    const double left = std::max(box.low.x(), circle.center.x() - circle.radius);
    const double right = std::min(box.high.x(), circle.center.x() + circle.radius);
    for (int i = 0; i < samples && left < right; ++i) {
        const double x = left + (i + 0.5) / samples * (right - left);
        const double across = x - circle.center.x();
        const double base =
            circle.center.y() - std::sqrt(circle.radius * circle.radius - across * across);
        if (base < ground_at(scene.section, x)) return;
    }
    refuse(problems, "/lem/circle",
           "passes the ground without cutting it: its lowest point is (" + text(circle.center.x()) +
               ", " + text(circle.center.y() - circle.radius) + ")",
           "the section reaches from " + text(box.low) + " to " + text(box.high) +
               ": give a circle whose lower arc lies in it");
}

void check_loads(const scene::Scene& scene, Problems& problems) {
    const scene::Lem& lem = *scene.lem;
    for (std::size_t i = 0; i < lem.surcharge.size(); ++i)
        check_range(scene, {lem.surcharge[i].from, lem.surcharge[i].to},
                    "/lem/surcharge/" + std::to_string(i), problems);
}

/// Every layer must be part of its region, and no two may overlap.
void check_layers(const scene::Scene& scene, Problems& problems) {
    const auto& layers = scene.lem->liquefaction;
    for (std::size_t i = 0; i < layers.size(); ++i) {
        if (!layers[i].levels) continue;
        const scene::Region& region = scene.section.regions[layers[i].region];
        if (region.polygon.empty()) continue;
        const geometry::Box box = geometry::bounding_box(region.polygon);
        const auto& [low, high] = *layers[i].levels;
        const std::string pointer = "/lem/liquefaction/" + std::to_string(i) + "/levels";
        if (low >= box.high.y() || high <= box.low.y()) {
            refuse(
                problems, pointer,
                "lie outside region \"" + region.name + "\": " + text(low) + " to " + metres(high),
                "the region reaches from " + text(box.low.y()) + " to " + metres(box.high.y()));
            continue;
        }
        for (std::size_t j = 0; j < i; ++j) {
            if (layers[j].region != layers[i].region || !layers[j].levels) continue;
            const double shared =
                std::min(high, (*layers[j].levels)[1]) - std::max(low, (*layers[j].levels)[0]);
            if (shared <= 1e-9 * (box.high.y() - box.low.y())) continue;
            refuse(problems, pointer,
                   "overlap those of layer " + std::to_string(j) + " by " + metres(shared),
                   "let each layer begin where the one above it ends");
        }
    }
}

/// Range of y of a layer within its region.
std::array<double, 2> levels_of(const scene::Scene& scene, const scene::UndrainedRegion& layer) {
    const geometry::Box box = geometry::bounding_box(scene.section.regions[layer.region].polygon);
    if (!layer.levels) return {box.low.y(), box.high.y()};
    return {std::max(box.low.y(), (*layer.levels)[0]), std::min(box.high.y(), (*layer.levels)[1])};
}

/// The layer's soil at x, from the top down.
std::vector<Stratum> parts_at(const scene::Scene& scene, const scene::UndrainedRegion& layer,
                              double x) {
    const auto [low, high] = levels_of(scene, layer);
    std::vector<Stratum> parts;
    for (Stratum each : strata_at(scene.section, x)) {
        if (each.region != layer.region) continue;
        each.top = std::min(each.top, high);
        each.bottom = std::max(each.bottom, low);
        if (each.top > each.bottom) parts.push_back(each);
    }
    return parts;
}

/// Whether one layer lies on the other anywhere.
bool lies_on(const scene::Scene& scene, const scene::UndrainedRegion& upper,
             const scene::UndrainedRegion& lower) {
    const std::vector<double> xs = abscissae(scene.section);
    for (std::size_t i = 0; i + 1 < xs.size(); ++i) {
        const double x = 0.5 * (xs[i] + xs[i + 1]);
        const std::vector<Stratum> above = parts_at(scene, upper, x);
        const std::vector<Stratum> below = parts_at(scene, lower, x);
        if (!above.empty() && !below.empty() &&
            above.front().bottom >= below.front().top - 1e-9 * (1.0 + std::abs(below.front().top)))
            return true;
    }
    return false;
}

/// Layers must be listed from the top down: stages and triggers count depths from the top of the
/// first one.
void check_order(const scene::Scene& scene, Problems& problems) {
    const auto& layers = scene.lem->liquefaction;
    const auto& regions = scene.section.regions;
    for (const scene::UndrainedRegion& each : layers)
        if (regions[each.region].polygon.empty()) return;
    const geometry::Box box = extent(scene.section);
    const double height = box.high.y() - box.low.y();
    for (std::size_t i = 1; i < layers.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            if (!lies_on(scene, layers[i], layers[j]) || lies_on(scene, layers[j], layers[i]))
                continue;
            refuse(problems, "/lem/liquefaction/" + std::to_string(i),
                   "lies on layer " + std::to_string(j) + ", which is listed before it",
                   "list the layers from the top down: stage n liquefies the first n of them, and "
                   "depths are counted from the top of the first");
            return;
        }
    }
    if (layers.empty() || !scene.fem || !scene.fem->liquefaction) return;
    const double top = levels_of(scene, layers.front())[1];
    const double zero = scene.fem->liquefaction->level;
    if (std::abs(zero - top) > 0.05 * height)
        warn(problems, "depths_differ", "/fem/liquefaction/level",
             "counts depths from " + metres(zero) +
                 ", critical_depth from the top of the first layer of /lem/liquefaction, " +
                 metres(top) +
                 ": a trigger that compares them fires at another depth than it says; " +
                 words::set("/fem/liquefaction/level", top));
}

bool may_be_wet(const scene::Lem& lem, std::size_t region) {
    const auto reaches = [&](const scene::Water& line) {
        return std::ranges::count(line.regions, region) > 0;
    };
    return (lem.water && (lem.water->regions.empty() || reaches(*lem.water))) ||
           std::ranges::any_of(lem.piezometric_lines, reaches) ||
           std::ranges::any_of(lem.pore_pressure_ratios, [&](const scene::PorePressureRatio& each) {
               return each.region == region && each.r_u > 0.0;
           });
}

/// Soil that fails undrained needs an undrained strength; strength by state needs water. Layers in
/// a scene without any water: check_agreement.
void check_undrained_strengths(const scene::Scene& scene, Problems& problems) {
    const scene::Lem& lem = *scene.lem;
    const auto refuse_dry = [&](const scene::UndrainedRegion& each, const std::string& pointer,
                                const std::string& remedy) {
        if (may_be_wet(lem, each.region)) return;
        refuse(problems, pointer,
               "is of soil without water: /lem gives region \"" +
                   scene.section.regions[each.region].name + "\" no line and no r_u",
               remedy);
    };
    const auto check_water = [&](const scene::UndrainedRegion& each, const std::string& pointer) {
        if (each.strength.on_path)
            refuse_dry(each, pointer + "/norsand",
                       "give /lem/water, or leave the entry out: dry soil fails drained");
    };
    for (std::size_t i = 0; i < lem.undrained.size(); ++i) {
        const std::string pointer = "/lem/undrained/" + std::to_string(i);
        check_water(lem.undrained[i], pointer);
        if (lem.undrained[i].strength.is_of_profile())
            refuse(problems, pointer, "gives no strength: s_u would be 0",
                   "give strength_kPa or coefficient_kPa; norsand where the law is that; or leave "
                   "the entry out, and the material's own strength counts");
    }
    for (std::size_t i = 0; i < lem.liquefaction.size(); ++i) {
        const scene::UndrainedRegion& layer = lem.liquefaction[i];
        const std::string pointer = "/lem/liquefaction/" + std::to_string(i);
        check_water(layer, pointer);
        if (!layer.strength.on_path && lem.has_water())
            refuse_dry(layer, pointer,
                       "name the region in /lem/water/regions, or leave the layer out: dry soil "
                       "does not liquefy");
        const scene::Material* soil = material_of(scene, scene.section.regions[layer.region]);
        const bool of_profile = soil != nullptr && soil->strength && soil->strength->residual;
        if (layer.strength.is_of_profile() && !of_profile)
            warn(problems, "no_residual_strength", pointer,
                 "gives no residual strength, and the material has no profile with one: once "
                 "liquefied, this soil has none");
    }
}

void check_tables(const scene::Scene& scene, Problems& problems) {
    const scene::Lem& lem = *scene.lem;
    if (lem.water && !lem.water->line.empty() &&
        check_table(scene, lem.water->line, "/lem/water/line", problems))
        warn_about_ends(scene, lem.water->line, "/lem/water/line", problems);
    for (std::size_t i = 0; i < lem.piezometric_lines.size(); ++i)
        if (!lem.piezometric_lines[i].line.empty())
            check_table(scene, lem.piezometric_lines[i].line,
                        "/lem/piezometric_lines/" + std::to_string(i) + "/line", problems);
}

/// Warns that only the lem excludes weight that has not consolidated the soil.
void warn_about_unconsolidated(const scene::Scene& scene, Problems& problems) {
    if (scene.lem->unconsolidated.empty() || !(scene.mpm || scene.fem)) return;
    for (const scene::Material& each : scene.materials) {
        if (!each.strength) continue;
        const auto c_at = [&](double sigma_v0) {
            return materials::strength_at(each.strength->peak, {10.0, 0.0, sigma_v0}).c;
        };
        if (c_at(2e5) <= c_at(1e5)) continue;
        warn(problems, "unconsolidated", "/lem/unconsolidated",
             "is left out of sigma'_v0 by the stability analysis alone: in the other phases the "
             "strength of \"" +
                 each.name + "\" grows with that weight");
        return;
    }
}

void check_strength(const scene::Scene& scene, Problems& problems) {
    const scene::Lem& lem = *scene.lem;
    std::set<std::size_t> open;
    for (const scene::UndrainedRegion& each : lem.undrained) open.insert(each.region);
    for (std::size_t r = 0; r < scene.section.regions.size(); ++r) {
        const scene::Material* material = material_of(scene, scene.section.regions[r]);
        if (material == nullptr || material->limit_strength || material->strength ||
            open.contains(r) || materials::limit_strength(material->law))
            return;
    }
    refuse(problems, "/lem", "finds no soil that can fail: no region has a strength",
           "give one of the materials mohr_coulomb or a limit_strength");
}

}  // namespace

void check_stability(const scene::Scene& scene, Problems& problems) {
    const scene::Lem& lem = *scene.lem;
    check_strength(scene, problems);
    check_undrained_strengths(scene, problems);
    check_layers(scene, problems);
    check_order(scene, problems);
    check_tables(scene, problems);
    warn_about_unconsolidated(scene, problems);
    check_loads(scene, problems);
    if (!check_slices(scene, problems)) return;  // without ground the other checks are meaningless
    if (lem.search) check_search(scene, *lem.search, problems);
    if (lem.circle) check_circle(scene, *lem.circle, problems);
    if (lem.tension_crack) check_crack(scene, *lem.tension_crack, problems);
}

}  // namespace breach::check
