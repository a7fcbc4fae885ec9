#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/check/segment.hpp"
#include "core/check/subjects.hpp"

namespace breach::check {

namespace {

/// Number of the connected body of each region.
std::vector<std::size_t> bodies_of(const scene::Scene& scene, double tolerance) {
    const auto& regions = scene.section.regions;
    std::vector<std::size_t> body(regions.size());
    std::iota(body.begin(), body.end(), std::size_t{0});
    const auto touch = [&](const scene::Region& a, const scene::Region& b) {
        return std::ranges::any_of(a.polygon, [&](const Vec2& vertex) {
            return geometry::contains(b.polygon, vertex, tolerance);
        });
    };
    for (std::size_t i = 0; i < regions.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            if (regions[i].polygon.empty() || regions[j].polygon.empty()) continue;
            if (!touch(regions[i], regions[j]) && !touch(regions[j], regions[i])) continue;
            const std::size_t old = body[i];
            for (std::size_t& each : body)
                if (each == old) each = body[j];
        }
    }
    return body;
}

/// [bodies] whether the segment touches them.
std::vector<bool> bodies_touched(const scene::Scene& scene, const std::vector<std::size_t>& body,
                                 const Side& segment, double tolerance) {
    std::vector<bool> touched(body.size(), false);
    for (std::size_t r = 0; r < body.size(); ++r) {
        const scene::Region& region = scene.section.regions[r];
        if (!region.polygon.empty() && touches(region, segment, tolerance)) touched[body[r]] = true;
    }
    return touched;
}

void check_held(const scene::Scene& scene, double tolerance, Problems& problems) {
    const auto& regions = scene.section.regions;
    const std::vector<std::size_t> body = bodies_of(scene, tolerance);
    std::vector<bool> x(regions.size(), false), y(regions.size(), false);
    const auto hold = [&](const Side& segment, bool holds_x, bool holds_y) {
        const auto touched = bodies_touched(scene, body, segment, tolerance);
        for (std::size_t b = 0; b < touched.size(); ++b) {
            x[b] = x[b] || (touched[b] && holds_x);
            y[b] = y[b] || (touched[b] && holds_y);
        }
    };
    for (const scene::Support& each : scene.fem->supports)
        hold({each.from, each.to}, each.fixes_x, each.fixes_y);
    if (!scene.fem->stages.empty())
        for (const scene::Displacement& each : scene.fem->stages.front().displacements)
            hold({each.from, each.to}, each.x.has_value(), each.y.has_value());
    for (std::size_t r = 0; r < regions.size(); ++r) {
        if (regions[r].polygon.empty() || body[r] != r || (x[r] && y[r])) continue;
        const bool whole = std::ranges::count(body, r) == std::ptrdiff_t(regions.size());
        refuse(problems, "/fem/supports",
               "nothing holds " + (whole ? "the body" : "region \"" + regions[r].name + "\"") +
                   " in " + (x[r] ? "y" : "x"),
               whole ? "add a support that fixes this direction"
                     : "let the region touch the others, or give it a support of its own");
    }
}

void check_column(const scene::Scene& scene, double x, const std::string& side, double tolerance,
                  Problems& problems) {
    const geometry::Upright reach = geometry::upright_at(scene.section, x, tolerance);
    if (!reach.unbroken) {
        refuse(problems, "/fem/free_field",
               "the " + side + " side of the section, at x = " + metres(x) +
                   ", is not one vertical line",
               "end the section there in a vertical side, or leave this column out (\"sides\")");
        return;
    }
    const double base = extent(scene.section).low.y();
    for (std::size_t i = 0; i < scene.fem->supports.size(); ++i) {
        const scene::Support& support = scene.fem->supports[i];
        const bool along = std::abs(support.from.x() - x) <= tolerance &&
                           std::abs(support.to.x() - x) <= tolerance;
        const double low = std::min(support.from.y(), support.to.y());
        const double high = std::max(support.from.y(), support.to.y());
        if (!along || high <= std::max(base, reach.low) + tolerance || low > reach.high + tolerance)
            continue;
        refuse(problems, "/fem/supports/" + std::to_string(i),
               "holds the " + side + " side up to " + metres(std::min(high, reach.high)) +
                   ", where a free-field column stands",
               "hold only the base of a side that has a column");
    }
}

void check_free_field(const scene::Scene& scene, double tolerance, Problems& problems) {
    if (!scene.fem->free_field) return;
    const scene::FreeFieldSides sides = scene.fem->free_field->sides;
    const geometry::Box box = extent(scene.section);
    if (sides != scene::FreeFieldSides::right)
        check_column(scene, box.low.x(), "left", tolerance, problems);
    if (sides != scene::FreeFieldSides::left)
        check_column(scene, box.high.x(), "right", tolerance, problems);
}

double length_of_lowest_sides(const scene::Scene& scene, double tolerance) {
    const Vec2 low = extent(scene.section).low, high = extent(scene.section).high;
    return length_on_sides(scene, {low, {high.x(), low.y()}}, tolerance);
}

/// The base needs horizontal edges at the lowest level, for its dashpots.
void check_base(const scene::Scene& scene, double tolerance, Problems& problems) {
    if (!scene.fem->base) return;
    const geometry::Box box = extent(scene.section);
    const double level = length_of_lowest_sides(scene, tolerance);
    const double width = box.high.x() - box.low.x();
    if (level >= (1.0 - 1e-6) * width) return;
    const std::string cause = "only " + metres(level) + " of the section's " + metres(width) +
                              " lie on its lowest level, y = " + metres(box.low.y());
    const std::string remedy = "the base is a level line: draw the foundation down to it";
    if (level <= tolerance)
        refuse(problems, "/fem/base", cause, remedy);
    else
        warn(problems, "broken_base", "/fem/base",
             cause + ": the rest moves without rock below; " + remedy);
}

/// Warns of a base whose support ends before the section does: lengthened without it.
void warn_of_unheld_base(const scene::Scene& scene, double tolerance, Problems& problems) {
    const double level = extent(scene.section).low.y();
    const double length = length_of_lowest_sides(scene, tolerance);
    const auto lies_there = [&](const Vec2& end) { return std::abs(end.y() - level) <= tolerance; };
    double held = 0.0;
    for (const scene::Support& each : scene.fem->supports)
        if (each.fixes_y && lies_there(each.from) && lies_there(each.to))
            held += length_on_sides(scene, {each.from, each.to}, tolerance);
    if (held <= tolerance || held >= (1.0 - 1e-6) * length) return;
    warn(problems, "hardly_held", "/fem/supports",
         "only " + metres(held) + " of the section's lowest side, " + metres(length) +
             " at y = " + metres(level) +
             ", are held: the soil over the rest is not supported; extend the support from end to "
             "end");
}

void check_crest(const scene::Scene& scene, Problems& problems) {
    const Vec2& crest = scene.fem->crest;
    const double away = geometry::distance_to_soil(scene.section, crest);
    const double size = largest_element_size(scene);
    const geometry::Box box = extent(scene.section);
    const double height = box.high.y() - box.low.y();
    if (away > std::max(height, 2.0 * size)) {
        refuse(
            problems, "/fem/crest",
            "lies " + metres(away) + " away from the section, which is " + metres(height) + " high",
            "give a point of the section, x from " + text(box.low.x()) + " to " +
                metres(box.high.x()));
    } else if (away > 2.0 * size) {
        warn(problems, "far_crest", "/fem/crest",
             "the crest " + text(crest) + " lies " + metres(away) +
                 " away from the soil, whose elements are " + metres(size) +
                 ": the recorded motion is not that of the crest; give a point on the ground");
    }
}

/// Warns of a long segment along no side of a region.
void warn_if_hardly_held(const scene::Scene& scene, std::size_t index, double tolerance,
                         Problems& problems) {
    const scene::Support& support = scene.fem->supports[index];
    const Side segment{support.from, support.to};
    const double size = largest_element_size(scene);
    if ((segment.b - segment.a).norm() <= size ||
        length_on_sides(scene, segment, tolerance) > tolerance)
        return;
    warn(problems, "hardly_held", "/fem/supports/" + std::to_string(index),
         "\"" + support.name + "\" runs from " + text(support.from) + " to " + text(support.to) +
             " along no side of a region: it holds single nodes, if any; place it on an edge");
}

}  // namespace

void check_supports(const scene::Scene& scene, Problems& problems) {
    const double tolerance = 1e-6 * least_element_size(scene);
    check_crest(scene, problems);
    if (scene.fem->mesh.msh_file) return;  // a mesh file has edges of its own
    bool missed = false;
    for (std::size_t i = 0; i < scene.fem->supports.size(); ++i) {
        const scene::Support& support = scene.fem->supports[i];
        const Side segment{support.from, support.to};
        if (may_hold_nodes(scene, segment, tolerance)) {
            warn_if_hardly_held(scene, i, tolerance, problems);
            continue;
        }
        missed = true;
        refuse(problems, "/fem/supports/" + std::to_string(i),
               "\"" + support.name + "\" " + how_it_misses(scene, segment),
               "let the segment run along an edge of a region, ends included");
    }
    if (!missed) check_held(scene, tolerance, problems);
    check_free_field(scene, tolerance, problems);
    check_base(scene, tolerance, problems);
    warn_of_unheld_base(scene, tolerance, problems);
}

}  // namespace breach::check
