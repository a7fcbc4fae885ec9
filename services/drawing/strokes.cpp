// SVG of lines and marks, shared by all features so that equal things look equal. Marks are in
// pixels and do not scale with the section.
#include "services/drawing/strokes.hpp"

#include <algorithm>

#include "core/words/number.hpp"

namespace breach::drawing {

std::string stroke(const std::string& colour, double width, const std::string& more) {
    return " fill=\"none\" stroke=\"" + colour + "\" stroke-width=\"" + words::text_of(width) +
           "\" " + more;
}

std::string shape(const std::string& path, const std::string& look) {
    return "<path d=\"" + path + "\"" + look + "/>\n";
}

void draw_line(Canvas& canvas, const std::string& name, const Line& line, const std::string& colour,
               const std::string& dashes) {
    const std::string path = path_of(canvas.panel, line);
    // A white line below keeps it visible on any soil.
    canvas.svg << shape(path, stroke("#fff", 4, "stroke-opacity=\"0.7\""))
               << shape(path, stroke(colour, 2, "class=\"" + name + "\"" + dashes));
}

Key line_key(const std::string& colour, const std::string& text, const std::string& dashes) {
    return {shape("M0 6h24", stroke(colour, 2, dashes)), text};
}

std::string place(const Vec2& at) {
    return "(" + words::text_of(at.x()) + ", " + words::text_of(at.y()) + ")";
}

/// `level` decides what a line means beyond its ends, level or straight on.
Line across(const Panel& panel, const Line& line, geometry::Level level) {
    const geometry::Box world = panel.world();
    Line whole{{world.low.x(), level(line, world.low.x())}};
    for (const Vec2& each : line)
        if (each.x() > world.low.x() && each.x() < world.high.x()) whole.push_back(each);
    whole.push_back({world.high.x(), level(line, world.high.x())});
    return whole;
}

void draw_loads(Canvas& canvas, const scene::Scene& scene,
                const std::vector<scene::Surcharge>& loads, const std::string& of) {
    for (const scene::Surcharge& each : loads) {
        for (const Line& ground : geometry::ground_between(scene.section, each.from, each.to)) {
            const Vec2 a = canvas.panel.at(ground.front()), b = canvas.panel.at(ground.back());
            // One in 14 pixels, on every width of load.
            const int arrows = std::max(2, static_cast<int>((b.x() - a.x()) / 14.0));
            std::string path;
            for (int i = 0; i <= arrows; ++i) {
                const double x = a.x() + (b.x() - a.x()) * i / arrows;
                // Level of the ground under each arrow: a load on a slope shows where it acts.
                const double y =
                    canvas.panel
                        .at({0.0, geometry::level_at(ground, canvas.panel.back({x, 0.0}).x())})
                        .y();
                path += "M" + px(x) + " " + px(y - 16) + "V" + px(y - 2) + "m-3 -4l3 4l3 -4";
            }
            canvas.svg << shape(path, stroke(violet, 1.2, "class=\"load\""));
        }
        canvas.keys.push_back(
            {shape("M6 0v10m-3 -4l3 4l3 -4M16 0v10m-3 -4l3 4l3 -4", stroke(violet, 1.2)),
             of + ": surcharge of " + words::text_of(each.pressure / 1e3) + " kPa, x = " +
                 words::text_of(each.from) + " to " + words::text_of(each.to) + " m"});
    }
}

}  // namespace breach::drawing
