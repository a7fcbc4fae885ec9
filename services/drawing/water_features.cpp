// All water of a scene, drawn once for each different line with the names of the phases that use
// it: two lines where one was meant are seen at once.
#include <algorithm>

#include "core/words/number.hpp"
#include "services/drawing/features.hpp"
#include "services/drawing/strokes.hpp"

namespace breach::drawing {

namespace {

bool same(const Line& a, const Line& b) { return a == b; }

/// Draws standing water where a line is above the ground.
/// Of the LEM's line only; each stretch of ground by itself, as a section may have gaps. The
/// surface follows the line where that is higher than the ground, else the ground, so the area has
/// no width there.
void draw_standing(Canvas& canvas, const scene::Scene& scene, const Line& line) {
    const geometry::Box world = canvas.panel.world();
    for (const Line& ground :
         geometry::ground_between(scene.section, world.low.x(), world.high.x())) {
        std::vector<double> xs;
        for (const Vec2& each : ground) xs.push_back(each.x());
        for (const Vec2& each : line)
            if (each.x() > ground.front().x() && each.x() < ground.back().x())
                xs.push_back(each.x());
        std::ranges::sort(xs);
        Line surface, bed;
        for (const double x : xs) {
            const double soil = geometry::level_at(ground, x);
            surface.push_back({x, std::max(geometry::level_at(line, x), soil)});
            bed.push_back({x, soil});
        }
        std::ranges::reverse(bed);
        surface.insert(surface.end(), bed.begin(), bed.end());
        canvas.svg << shape(path_of(canvas.panel, surface) + "Z",
                            " class=\"water\" fill=\"#9fd3f5\" fill-opacity=\"0.6\"");
    }
}

/// Segments where the FEM prescribes the pore pressure.
void draw_boundaries(Canvas& canvas, const scene::GroundWater& water) {
    for (const scene::PressureBoundary& each : water.boundaries) {
        const Line segment{each.from, each.to};
        canvas.over << shape(path_of(canvas.panel, segment),
                             stroke(blue, 5,
                                    "class=\"pressure\" stroke-opacity=\"0.55\" "
                                    "stroke-linecap=\"round\""));
        canvas.keys.push_back(
            {shape("M2 6h20", stroke(blue, 5, "stroke-opacity=\"0.55\"")),
             "FEM: pore pressure held on " + each.name + ", " +
                 (each.level ? "water at y = " + words::text_of(*each.level) + " m" : "p = 0")});
    }
}

}  // namespace

/// Empty lines are skipped: a phase without water has none to compare.
void draw_water(Canvas& canvas, const scene::Scene& scene) {
    struct Found {
        Line line;
        std::string of;
    };
    std::vector<Found> found;
    const auto add = [&](const Line& line, const std::string& of) {
        if (line.empty()) return;
        const auto known =
            std::ranges::find_if(found, [&](const Found& each) { return same(each.line, line); });
        if (known == found.end()) {
            found.push_back({line, of});
        } else {
            known->of += ", " + of;
        }
    };
    if (scene.lem && scene.lem->water) {
        draw_standing(canvas, scene, scene.lem->water->line);
        add(scene.lem->water->line, "LEM");
    }
    if (scene.fem && scene.fem->water) add(scene.fem->water->line, "FEM");
    if (scene.fem)
        for (const scene::Stage& stage : scene.fem->stages)
            if (stage.phreatic_line) add(*stage.phreatic_line, "FEM, stage " + stage.name);
    if (scene.transfer) add(scene.transfer->phreatic_line, "transfer");
    // The third and all further lines look alike; the legend names them.
    const std::vector<std::string> dashes{"", " stroke-dasharray=\"9 4\"",
                                          " stroke-dasharray=\"3 3\""};
    for (std::size_t i = 0; i < found.size(); ++i) {
        const std::string& dash = dashes[std::min(i, dashes.size() - 1)];
        draw_line(canvas, "phreatic", across(canvas.panel, found[i].line, geometry::level_at), blue,
                  dash);
        canvas.keys.push_back(line_key(blue, "phreatic line (" + found[i].of + ")", dash));
    }
    if (scene.fem && scene.fem->water) draw_boundaries(canvas, *scene.fem->water);
    if (!scene.lem || scene.lem->piezometric_lines.empty()) return;
    const std::string dash = " stroke-dasharray=\"1 4\" stroke-linecap=\"round\"";
    for (const scene::Water& each : scene.lem->piezometric_lines)
        draw_line(canvas, "piezometric", across(canvas.panel, each.line, geometry::level_at), blue,
                  dash);
    canvas.keys.push_back(line_key(blue, "piezometric line (LEM)", dash));
}

}  // namespace breach::drawing
