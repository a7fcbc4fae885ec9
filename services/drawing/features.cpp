// Supports, columns, water, loads and the like over the soil, so that an entry with a wrong sign
// or unit is seen before it costs a run. Called by section_drawing for the parts that the scene
// has.
#include "services/drawing/features.hpp"

#include <algorithm>
#include <cmath>

#include "core/check/applied_motion.hpp"
#include "core/motion/plausibility.hpp"
#include "core/words/number.hpp"
#include "services/drawing/strokes.hpp"

namespace breach::drawing {

namespace {

struct Held {
    const char* name;
    const char* meaning;
};
Held held_by(const scene::Support& support) {
    if (support.fixes_x && support.fixes_y) return {"held", "held in x and y"};
    return support.fixes_x ? Held{"held-x", "held in x"} : Held{"held-y", "held in y"};
}

/// One symbol of a support at a point of the border; `out`: direction away from the soil [px].
std::string sign_of(const scene::Support& support, const Vec2& at, const Vec2& out) {
    const Vec2 along(-out.y(), out.x());
    const auto corner = [&](const Vec2& p) { return px(p.x()) + " " + px(p.y()); };
    if (support.fixes_x && support.fixes_y) {
        return "M" + corner(at) + "L" + corner(at + 8 * out + 5 * along) + "L" +
               corner(at + 8 * out - 5 * along) + "Z";
    }
    const Vec2 centre = at + 4.5 * out;  // a roller, which moves along the free direction
    return "M" + corner(centre - 3.5 * along) + "a3.5 3.5 0 1 0 " + px(7 * along.x()) + " " +
           px(7 * along.y()) + "a3.5 3.5 0 1 0 " + px(-7 * along.x()) + " " + px(-7 * along.y());
}

void draw_support(Canvas& canvas, const scene::Scene& scene, const scene::Support& support) {
    const Vec2 a = canvas.panel.at(support.from), b = canvas.panel.at(support.to);
    const double length = (b - a).norm();
    Vec2 along(1.0, 0.0);
    if (length > 0.0) along = (b - a) / length;
    Vec2 out(-along.y(), along.x());
    // The side without soil: supports are drawn outside.
    const Vec2 probe = canvas.panel.back(0.5 * (a + b) + 6.0 * out);
    if (geometry::in_soil(scene.section, probe)) out = -out;
    std::string signs;
    // Signs at a constant distance in pixels, so that long sides are not crowded.
    const int count = std::max(1, static_cast<int>(length / 26.0));
    for (int i = 0; i < count; ++i)
        signs += sign_of(support, a + (b - a) * ((i + 0.5) / count), out);
    canvas.over << shape("M" + px(a.x()) + " " + px(a.y()) + "L" + px(b.x()) + " " + px(b.y()),
                         stroke("#111", 2.2))
                << shape(signs,
                         " class=\"support\" fill=\"#fff\" stroke=\"#111\" stroke-width=\"1.1\"");
}

void draw_free_field(Canvas& canvas, const scene::Scene& scene) {
    const scene::FreeField& columns = *scene.fem->free_field;
    const geometry::Box soil = geometry::extent(scene.section);
    const auto column = [&](double edge, double direction) {
        const auto strata = geometry::strata_at(scene.section, edge - direction * 1e-6);
        if (strata.empty()) return;
        // Columns may be wider than the dam: drawn as wide as they are, they would leave no room
        // for it.
        const double far = edge + direction * std::min(columns.width, 24.0 / canvas.panel.scale());
        const Line ring{{edge, strata.back().bottom},
                        {far, strata.back().bottom},
                        {far, strata.front().top},
                        {edge, strata.front().top}};
        canvas.svg << shape(path_of(canvas.panel, ring) + "Z",
                            " class=\"free-field\" fill=\"#ddd\" stroke=\"#444\" "
                            "stroke-dasharray=\"3 2\"");
    };
    if (columns.sides != scene::FreeFieldSides::right) column(soil.low.x(), -1.0);
    if (columns.sides != scene::FreeFieldSides::left) column(soil.high.x(), 1.0);
    canvas.keys.push_back(
        {"<rect x=\"6\" width=\"12\" height=\"12\" fill=\"#ddd\" stroke=\"#444\" "
         "stroke-dasharray=\"3 2\"/>\n",
         "FEM: free-field column, " + words::text_of(columns.width) +
             " m wide (at most 24 px are drawn)"});
}

}  // namespace

void draw_supports(Canvas& canvas, const scene::Scene& scene) {
    if (!scene.fem) return;
    const scene::Fem& fem = *scene.fem;
    if (fem.free_field) draw_free_field(canvas, scene);
    std::vector<std::string> told;
    for (const scene::Support& each : fem.supports) {
        draw_support(canvas, scene, each);
        const Held held = held_by(each);
        // One key for each kind of support.
        if (std::ranges::find(told, held.name) != told.end()) continue;
        told.push_back(held.name);
        canvas.keys.push_back({shape(sign_of(each, {12.0, 1.0}, {0.0, 1.0}),
                                     " fill=\"#fff\" stroke=\"#111\" stroke-width=\"1.1\""),
                               std::string("FEM: ") + held.meaning});
    }
    if (fem.base) {
        const geometry::Box soil = geometry::extent(scene.section);
        // The half-space has no lower edge: a line below the soil stands for it.
        const double below = 14.0 / canvas.panel.scale();
        canvas.svg << shape(path_of(canvas.panel, {{soil.low.x(), soil.low.y() - below},
                                                   {soil.high.x(), soil.low.y() - below}}),
                            stroke("#777", 3, "class=\"base\" stroke-dasharray=\"2 5\""));
        canvas.keys.push_back(line_key(
            "#777",
            "FEM: elastic half-space below, V_s = " + words::text_of(fem.base->V_s) + " m/s",
            " stroke-dasharray=\"2 5\""));
    }
    draw_loads(canvas, scene, fem.surcharge, "FEM");
    canvas.keys.push_back({"<path d=\"M12 11l-6 -10h12z\" fill=\"" + std::string(green) + "\"/>\n",
                           "FEM: monitored crest " + place(fem.crest)});
    // The key stays, with the coordinates: a person sees by them why the crest is not in the
    // picture.
    if (!canvas.panel.shows(fem.crest)) return;
    const Vec2 crest = canvas.panel.at(fem.crest);
    canvas.over << "<path class=\"crest\" d=\"M" << px(crest.x()) << " " << px(crest.y())
                << "l-6 -10h12z\" fill=\"" << green << "\" stroke=\"#fff\"/>\n";
    canvas.labels.take({crest.x() - 6, crest.y() - 10, crest.x() + 6, crest.y()});
    canvas.labels.beside(canvas.over, crest + Vec2(0, -5), "crest", green);
}

namespace {

/// Points up from below, the crest down from above: both may lie on one vertical line.
void draw_toe(Canvas& canvas, const Vec2& place) {
    if (!canvas.panel.shows(place)) return;
    const Vec2 toe = canvas.panel.at(place);
    canvas.over << "<path class=\"toe\" d=\"M" << px(toe.x()) << " " << px(toe.y())
                << "l-6 10h12z\" fill=\"" << dark_red << "\" stroke=\"#fff\"/>\n";
    canvas.labels.take({toe.x() - 6, toe.y(), toe.x() + 6, toe.y() + 10});
    canvas.labels.beside(canvas.over, toe + Vec2(0, 5), "toe", dark_red);
}

}  // namespace

void draw_runout_marks(Canvas& canvas, const scene::Scene& scene) {
    if (!scene.mpm) return;
    const scene::Mpm& mpm = *scene.mpm;
    draw_toe(canvas, mpm.runout.toe);
    canvas.keys.push_back({"<path d=\"M12 1l-6 10h12z\" fill=\"" + std::string(dark_red) + "\"/>\n",
                           "MPM: toe, runout counts from " + place(mpm.runout.toe)});
    if (mpm.gauges.empty()) return;
    const Room room = canvas.panel.room();
    std::string list;
    for (const scene::Gauge& each : mpm.gauges) {
        list += (list.empty() ? "" : ", ") + each.name + " (x = " + words::text_of(each.x) + ")";
        const double x = canvas.panel.at({each.x, 0.0}).x();
        // A gauge beyond the section is in the list, and on the runout's panel if that reaches it.
        if (x < room.left || x > room.right) continue;
        canvas.svg << shape("M" + px(x) + " " + px(room.bottom) + "V" + px(room.top + 18),
                            stroke(green, 1.3, "class=\"gauge\" stroke-dasharray=\"5 3\""));
        canvas.labels.beside(canvas.over, {x, room.top + 24}, each.name, green);
    }
    canvas.keys.push_back(line_key(green, "MPM: gauges " + list, " stroke-dasharray=\"5 3\""));
}

void draw_grid(Canvas& canvas, const scene::Scene& scene) {
    const scene::Mpm& mpm = *scene.mpm;
    const auto [left, right] = mpm.domain_x;
    const auto [low, high] = mpm.domain_y;
    canvas.svg << shape(
        path_of(canvas.panel, {{left, low}, {right, low}, {right, high}, {left, high}}) + "Z",
        stroke("#111", 1.4, "class=\"mpm-grid\" stroke-dasharray=\"7 3\""));
    const double cells_x = std::round((right - left) / mpm.cell_size);
    const double cells_y = std::round((high - low) / mpm.cell_size);
    canvas.keys.push_back(line_key("#111",
                                   "MPM: grid of " + words::text_of(cells_x) + " x " +
                                       words::text_of(cells_y) + " cells of " +
                                       words::text_of(mpm.cell_size) + " m",
                                   " stroke-dasharray=\"7 3\""));
    // A terrain is the ground of the runout then, and the floor's level would only mislead.
    if (!mpm.terrain.empty()) {
        draw_line(canvas, "terrain", across(canvas.panel, mpm.terrain, geometry::straight_level_at),
                  brown);
        canvas.keys.push_back(line_key(brown, "MPM: terrain"));
    } else {
        draw_line(canvas, "floor", {{left, mpm.floor.level}, {right, mpm.floor.level}}, brown);
        canvas.keys.push_back(
            line_key(brown, "MPM: floor at y = " + words::text_of(mpm.floor.level) + " m"));
    }
    std::string friction;
    for (const scene::FrictionZone& each : mpm.floor.friction)
        friction += (friction.empty() ? "" : "; ") + words::text_of(each.coefficient) +
                    " from x = " + words::text_of(each.from) + " to " + words::text_of(each.to);
    canvas.keys.push_back({"", friction.empty() ? "MPM: nothing slips on the ground"
                                                : "MPM: friction of the ground " + friction});
}

/// The motion as it is applied, scaled: the user compares it with the intended earthquake.
std::optional<std::string> motion_line(const scene::Scene& scene) {
    if (!scene.fem || !scene.fem->motion) return std::nullopt;
    try {
        const motion::Recording shaking = check::applied_motion(*scene.fem->motion);
        std::string line = "Motion " + scene.fem->motion->file.filename().string() + ": " +
                           motion::summary_of(shaking);
        if (shaking.quantity == motion::Quantity::acceleration) {
            const motion::StrongPart strong = motion::strong_part(shaking.series);
            line += ", Arias intensity " +
                    words::text_of(motion::arias_intensity(shaking.series), 3) +
                    " m/s, strong part from " + words::text_of(strong.begin, 3) + " to " +
                    words::text_of(strong.end, 3) + " s";
        }
        if (scene.fem->motion->scale_to_pga_g)
            line += " (scaled to " + words::text_of(*scene.fem->motion->scale_to_pga_g) + " g)";
        return line;
    } catch (const fault::BadInput&) {  // reported as a fault elsewhere
    } catch (const fault::IoError&) {
    }
    return std::nullopt;
}

}  // namespace breach::drawing
