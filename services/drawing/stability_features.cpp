// What the stability analysis will do: which soil it lets liquefy in which stage, where its
// surfaces may begin and end, and what bounds them. Called by section_drawing for scenes with /lem.
#include <algorithm>
#include <cmath>

#include "core/words/number.hpp"
#include "services/drawing/features.hpp"
#include "services/drawing/strokes.hpp"

namespace breach::drawing {

namespace {

/// On the ground, raised by its own width: search ranges lie along the border of the soil.
void draw_range(Canvas& canvas, const scene::Scene& scene, const std::array<double, 2>& range,
                const std::string& name, const std::string& colour) {
    const double lift = 5.0 / canvas.panel.scale();
    for (Line ground : geometry::ground_between(scene.section, range[0], range[1])) {
        for (Vec2& each : ground) each.y() += lift;
        canvas.svg << shape(path_of(canvas.panel, ground),
                            stroke(colour, 5, "class=\"search\" stroke-opacity=\"0.85\""));
    }
    canvas.keys.push_back({shape("M0 6h24", stroke(colour, 5)),
                           "LEM: " + name + " searched from x = " + words::text_of(range[0]) +
                               " to " + words::text_of(range[1]) + " m"});
}

/// Outlines and numbers the zones that liquefy stage by stage.
void draw_liquefaction(Canvas& canvas, const scene::Scene& scene) {
    const std::vector<scene::UndrainedRegion>& layers = scene.lem->liquefaction;
    if (layers.empty()) return;
    const std::string dash = " stroke-dasharray=\"6 3\"";
    for (std::size_t i = 0; i < layers.size(); ++i) {
        geometry::Polygon part = scene.section.regions[layers[i].region].polygon;
        if (layers[i].levels) {
            const auto [low, high] = *layers[i].levels;
            // Left of a line to the right is above it.
            part = geometry::clipped_left(part, {0.0, low}, {1.0, low});
            part = geometry::clipped_left(part, {1.0, high}, {0.0, high});
        }
        // Levels outside of the region leave nothing.
        if (part.empty()) continue;
        canvas.svg << shape(path_of(canvas.panel, part) + "Z",
                            stroke(dark_red, 1.3, "class=\"liquefaction\"" + dash));
        const geometry::Box box = geometry::bounding_box(part);
        // side by side, as layers may be thinner than a digit
        const double along =
            0.5 + 0.06 * (static_cast<double>(i) - 0.5 * static_cast<double>(layers.size() - 1));
        const Vec2 middle{box.low.x() + along * (box.high.x() - box.low.x()),
                          0.5 * (box.low.y() + box.high.y())};
        const Vec2 inside = canvas.panel.inside(middle);
        canvas.labels.write(canvas.over, canvas.panel.at(inside), std::to_string(i + 1), dark_red);
    }
    canvas.keys.push_back(line_key(
        dark_red,
        layers.size() == 1 ? "LEM: liquefies in stage 1"
                           : "LEM: liquefies in stages 1 to " + std::to_string(layers.size()),
        dash));
}

/// Down from the ground where surfaces begin, or where the search lets them begin.
void draw_crack(Canvas& canvas, const scene::Scene& scene) {
    const scene::Lem& lem = *scene.lem;
    if (!lem.tension_crack) return;
    const scene::TensionCrack& crack = *lem.tension_crack;
    const geometry::Box world = canvas.panel.world();
    const auto [from, to] =
        lem.search ? lem.search->entry : std::array<double, 2>{world.low.x(), world.high.x()};
    const std::string dash = " stroke-dasharray=\"1 3\"";
    for (Line foot : geometry::ground_between(scene.section, from, to)) {
        for (Vec2& each : foot)
            each.y() = crack.depth ? each.y() - *crack.depth : std::min(each.y(), *crack.level);
        draw_line(canvas, "crack", foot, dark_red, dash);
    }
    canvas.keys.push_back(line_key(
        dark_red,
        "LEM: foot of the tension crack, " +
            (crack.depth ? words::text_of(*crack.depth) + " m deep"
                         : "at y = " + words::text_of(*crack.level) + " m") +
            (crack.filled > 0.0 ? ", water in " + words::text_of(100.0 * crack.filled) + " %" : ""),
        dash));
}

}  // namespace

void draw_stability(Canvas& canvas, const scene::Scene& scene) {
    if (!scene.lem) return;
    const scene::Lem& lem = *scene.lem;
    draw_liquefaction(canvas, scene);
    draw_crack(canvas, scene);
    if (lem.search) {
        draw_range(canvas, scene, lem.search->entry, "upper ends", "#d55e00");
        draw_range(canvas, scene, lem.search->exit, "lower ends", violet);
        if (lem.search->lowest_level) {
            const geometry::Box world = canvas.panel.world();
            const double y = *lem.search->lowest_level;
            const std::string dash = " stroke-dasharray=\"2 4\"";
            draw_line(canvas, "search", {{world.low.x(), y}, {world.high.x(), y}}, violet, dash);
            canvas.keys.push_back(
                line_key(violet, "LEM: no surface below y = " + words::text_of(y) + " m", dash));
        }
    }
    if (lem.circle) {
        const Vec2 centre = canvas.panel.at(lem.circle->center);
        canvas.svg << "<circle class=\"slip\" cx=\"" << px(centre.x()) << "\" cy=\""
                   << px(centre.y()) << "\" r=\"" << px(lem.circle->radius * canvas.panel.scale())
                   << "\"" << stroke(violet, 1.6, "stroke-dasharray=\"6 3\"") << "/>\n";
        canvas.keys.push_back(line_key(violet, "LEM: given circle", " stroke-dasharray=\"6 3\""));
    }
    if (lem.non_circular && !lem.non_circular->given.empty()) {
        draw_line(canvas, "slip", lem.non_circular->given, violet);
        canvas.keys.push_back(line_key(violet, "LEM: given surface"));
    }
    if (!lem.floor.empty()) {
        draw_line(canvas, "floor", across(canvas.panel, lem.floor, geometry::level_at), brown,
                  " stroke-dasharray=\"8 3 2 3\"");
        canvas.keys.push_back(
            line_key(brown, "LEM: floor of all surfaces", " stroke-dasharray=\"8 3 2 3\""));
    }
    draw_loads(canvas, scene, lem.surcharge, "LEM");
}

}  // namespace breach::drawing
