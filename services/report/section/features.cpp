#include "services/report/section/features.hpp"

#include <algorithm>
#include <cmath>

#include "core/check/applied_motion.hpp"
#include "core/check/section.hpp"
#include "core/motion/plausibility.hpp"
#include "services/report/chart/axis.hpp"
#include "services/report/chart/frame.hpp"

namespace breach::report {

namespace {

using Line = std::vector<Vec2>;

constexpr const char* blue = "#0b5fa5";
constexpr const char* violet = "#7a1fa2";
constexpr const char* brown = "#5d4037";
constexpr const char* green = "#00695c";

std::string stroke(const std::string& colour, double width, const std::string& more = "") {
    return " fill=\"none\" stroke=\"" + colour + "\" stroke-width=\"" + short_number(width) +
           "\" " + more;
}

std::string shape(const std::string& path, const std::string& look) {
    return "<path d=\"" + path + "\"" + look + "/>\n";
}

/// A line on white, so that it is seen on every fill.
void draw_line(Canvas& canvas, const std::string& name, const Line& line, const std::string& colour,
               const std::string& dashes = "") {
    const std::string path = path_of(canvas.panel, line);
    canvas.svg << shape(path, stroke("#fff", 4, "stroke-opacity=\"0.7\""))
               << shape(path, stroke(colour, 2, "class=\"" + name + "\"" + dashes));
}

Key line_key(const std::string& colour, const std::string& text, const std::string& dashes = "") {
    return {shape("M0 6h24", stroke(colour, 2, dashes)), text};
}

std::string place(const Vec2& at) {
    return "(" + short_number(at.x()) + ", " + short_number(at.y()) + ")";
}

/// The line over the whole panel, as it goes on beyond its ends.
Line across(const Panel& panel, const Line& line, check::Level level) {
    const scene::Box world = panel.world();
    Line whole{{world.low.x(), level(line, world.low.x())}};
    for (const Vec2& each : line)
        if (each.x() > world.low.x() && each.x() < world.high.x()) whole.push_back(each);
    whole.push_back({world.high.x(), level(line, world.high.x())});
    return whole;
}

bool same(const Line& a, const Line& b) { return a == b; }

/// Where a line of water stands above the ground.
void draw_standing(Canvas& canvas, const scene::Scene& scene, const Line& line) {
    const scene::Box world = canvas.panel.world();
    for (const Line& ground : ground_between(scene, world.low.x(), world.high.x())) {
        std::vector<double> xs;
        for (const Vec2& each : ground) xs.push_back(each.x());
        for (const Vec2& each : line)
            if (each.x() > ground.front().x() && each.x() < ground.back().x())
                xs.push_back(each.x());
        std::ranges::sort(xs);
        Line surface, bed;
        for (const double x : xs) {
            const double soil = check::level_at(ground, x);
            surface.push_back({x, std::max(check::level_at(line, x), soil)});
            bed.push_back({x, soil});
        }
        std::ranges::reverse(bed);
        surface.insert(surface.end(), bed.begin(), bed.end());
        canvas.svg << shape(path_of(canvas.panel, surface) + "Z",
                            " class=\"water\" fill=\"#9fd3f5\" fill-opacity=\"0.6\"");
    }
}

}  // namespace

std::vector<Line> ground_between(const scene::Scene& scene, double from, double to) {
    std::vector<double> xs;
    for (const scene::Region& each : scene.section.regions)
        for (const Vec2& vertex : each.polygon) xs.push_back(std::clamp(vertex.x(), from, to));
    if (xs.empty()) return {};
    xs.push_back(std::clamp(from, std::ranges::min(xs), std::ranges::max(xs)));
    std::ranges::sort(xs);
    const double aside = 1e-7 * std::max(1.0, xs.back() - xs.front());
    std::vector<Line> pieces;
    for (std::size_t i = 0; i + 1 < xs.size(); ++i) {
        if (xs[i + 1] - xs[i] < 4.0 * aside) continue;
        const auto left = check::strata_at(scene, xs[i] + aside);
        const auto right = check::strata_at(scene, xs[i + 1] - aside);
        if (left.empty() || right.empty()) continue;
        const Vec2 a(xs[i], left.front().top), b(xs[i + 1], right.front().top);
        if (pieces.empty() || (pieces.back().back() - a).norm() > 1e3 * aside)
            pieces.push_back({a});
        pieces.back().push_back(b);
    }
    return pieces;
}

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
    if (scene.transfer) add(scene.transfer->phreatic_line, "transfer");
    const std::vector<std::string> dashes{"", " stroke-dasharray=\"9 4\"",
                                          " stroke-dasharray=\"3 3\""};
    for (std::size_t i = 0; i < found.size(); ++i) {
        const std::string& dash = dashes[std::min(i, dashes.size() - 1)];
        draw_line(canvas, "phreatic", across(canvas.panel, found[i].line, check::level_at), blue,
                  dash);
        canvas.keys.push_back(line_key(blue, "phreatic line (" + found[i].of + ")", dash));
    }
    if (!scene.lem || scene.lem->piezometric_lines.empty()) return;
    const std::string dash = " stroke-dasharray=\"1 4\" stroke-linecap=\"round\"";
    for (const scene::Water& each : scene.lem->piezometric_lines)
        draw_line(canvas, "piezometric", across(canvas.panel, each.line, check::level_at), blue,
                  dash);
    canvas.keys.push_back(line_key(blue, "piezometric line (LEM)", dash));
}

namespace {

void draw_range(Canvas& canvas, const scene::Scene& scene, const std::array<double, 2>& range,
                const std::string& name, const std::string& colour) {
    const double lift = 5.0 / canvas.panel.scale();
    for (Line ground : ground_between(scene, range[0], range[1])) {
        for (Vec2& each : ground) each.y() += lift;
        canvas.svg << shape(path_of(canvas.panel, ground),
                            stroke(colour, 5, "class=\"search\" stroke-opacity=\"0.85\""));
    }
    canvas.keys.push_back({shape("M0 6h24", stroke(colour, 5)),
                           "LEM: " + name + " searched from x = " + short_number(range[0]) +
                               " to " + short_number(range[1]) + " m"});
}

void draw_loads(Canvas& canvas, const scene::Scene& scene,
                const std::vector<scene::Surcharge>& loads, const std::string& of) {
    for (const scene::Surcharge& each : loads) {
        for (const Line& ground : ground_between(scene, each.from, each.to)) {
            const Vec2 a = canvas.panel.at(ground.front()), b = canvas.panel.at(ground.back());
            const int arrows = std::max(2, static_cast<int>((b.x() - a.x()) / 14.0));
            std::string path;
            for (int i = 0; i <= arrows; ++i) {
                const double x = a.x() + (b.x() - a.x()) * i / arrows;
                const double y =
                    canvas.panel.at({0.0, check::level_at(ground, canvas.panel.back({x, 0.0}).x())})
                        .y();
                path += "M" + px(x) + " " + px(y - 16) + "V" + px(y - 2) + "m-3 -4l3 4l3 -4";
            }
            canvas.svg << shape(path, stroke(violet, 1.2, "class=\"load\""));
        }
        canvas.keys.push_back(
            {shape("M6 0v10m-3 -4l3 4l3 -4M16 0v10m-3 -4l3 4l3 -4", stroke(violet, 1.2)),
             of + ": surcharge of " + short_number(each.pressure / 1e3) +
                 " kPa, x = " + short_number(each.from) + " to " + short_number(each.to) + " m"});
    }
}

}  // namespace

void draw_stability(Canvas& canvas, const scene::Scene& scene) {
    if (!scene.lem) return;
    const scene::Lem& lem = *scene.lem;
    if (lem.search) {
        draw_range(canvas, scene, lem.search->entry, "upper ends", "#d55e00");
        draw_range(canvas, scene, lem.search->exit, "lower ends", violet);
        if (lem.search->lowest_level) {
            const scene::Box world = canvas.panel.world();
            const double y = *lem.search->lowest_level;
            const std::string dash = " stroke-dasharray=\"2 4\"";
            draw_line(canvas, "search", {{world.low.x(), y}, {world.high.x(), y}}, violet, dash);
            canvas.keys.push_back(
                line_key(violet, "LEM: no surface below y = " + short_number(y) + " m", dash));
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
        draw_line(canvas, "floor", across(canvas.panel, lem.floor, check::level_at), brown,
                  " stroke-dasharray=\"8 3 2 3\"");
        canvas.keys.push_back(
            line_key(brown, "LEM: floor of all surfaces", " stroke-dasharray=\"8 3 2 3\""));
    }
    draw_loads(canvas, scene, lem.surcharge, "LEM");
    for (const scene::LineLoad& each : lem.line_loads) {
        const auto ground = ground_between(scene, each.x - 0.01, each.x + 0.01);
        if (ground.empty()) continue;
        const Vec2 at = canvas.panel.at(ground.front().front());
        canvas.svg << shape("M" + px(at.x()) + " " + px(at.y() - 26) + "v24m-4 -6l4 6l4 -6",
                            stroke(violet, 2, "class=\"load\""));
        canvas.keys.push_back({shape("M12 0v11m-4 -5l4 5l4 -5", stroke(violet, 2)),
                               "LEM: line load at x = " + short_number(each.x) + " m, " +
                                   short_number(each.down / 1e3) + " kN/m down, " +
                                   short_number(each.right / 1e3) + " kN/m right"});
    }
}

namespace {

struct Held {
    const char* name;
    const char* meaning;
};
Held held_by(const scene::Support& support) {
    if (support.fixes_x && support.fixes_y) return {"held", "held in x and y"};
    return support.fixes_x ? Held{"held-x", "held in x"} : Held{"held-y", "held in y"};
}

/// One sign of how nodes are held, at a point of the border; `out` leads away from the soil [px].
std::string sign_of(const scene::Support& support, const Vec2& at, const Vec2& out) {
    const Vec2 along(-out.y(), out.x());
    const auto corner = [&](const Vec2& p) { return px(p.x()) + " " + px(p.y()); };
    if (support.fixes_x && support.fixes_y) {
        return "M" + corner(at) + "L" + corner(at + 8 * out + 5 * along) + "L" +
               corner(at + 8 * out - 5 * along) + "Z";
    }
    const Vec2 centre = at + 4.5 * out;  // a roller, which goes along the free direction
    return "M" + corner(centre - 3.5 * along) + "a3.5 3.5 0 1 0 " + px(7 * along.x()) + " " +
           px(7 * along.y()) + "a3.5 3.5 0 1 0 " + px(-7 * along.x()) + " " + px(-7 * along.y());
}

void draw_support(Canvas& canvas, const scene::Scene& scene, const scene::Support& support) {
    const Vec2 a = canvas.panel.at(support.from), b = canvas.panel.at(support.to);
    const double length = (b - a).norm();
    Vec2 along(1.0, 0.0);
    if (length > 0.0) along = (b - a) / length;
    Vec2 out(-along.y(), along.x());
    const Vec2 probe = canvas.panel.back(0.5 * (a + b) + 6.0 * out);
    if (check::in_soil(scene, probe, 0.0)) out = -out;
    std::string signs;
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
    const scene::Box soil = check::extent(scene);
    const auto column = [&](double edge, double direction) {
        const auto strata = check::strata_at(scene, edge - direction * 1e-6);
        if (strata.empty()) return;
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
         "FEM: free-field column, " + short_number(columns.width) +
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
        if (std::ranges::find(told, held.name) != told.end()) continue;
        told.push_back(held.name);
        canvas.keys.push_back({shape(sign_of(each, {12.0, 1.0}, {0.0, 1.0}),
                                     " fill=\"#fff\" stroke=\"#111\" stroke-width=\"1.1\""),
                               std::string("FEM: ") + held.meaning});
    }
    if (fem.base) {
        const scene::Box soil = check::extent(scene);
        const double below = 14.0 / canvas.panel.scale();
        canvas.svg << shape(path_of(canvas.panel, {{soil.low.x(), soil.low.y() - below},
                                                   {soil.high.x(), soil.low.y() - below}}),
                            stroke("#777", 3, "class=\"base\" stroke-dasharray=\"2 5\""));
        canvas.keys.push_back(line_key(
            "#777", "FEM: elastic half-space below, V_s = " + short_number(fem.base->V_s) + " m/s",
            " stroke-dasharray=\"2 5\""));
    }
    draw_loads(canvas, scene, fem.surcharge, "FEM");
    canvas.keys.push_back({"<path d=\"M12 11l-6 -10h12z\" fill=\"" + std::string(green) + "\"/>\n",
                           "FEM: monitored crest " + place(fem.crest)});
    if (!canvas.panel.shows(fem.crest)) return;
    const Vec2 crest = canvas.panel.at(fem.crest);
    canvas.over << "<path class=\"crest\" d=\"M" << px(crest.x()) << " " << px(crest.y())
                << "l-6 -10h12z\" fill=\"" << green << "\" stroke=\"#fff\"/>\n";
    canvas.labels.take({crest.x() - 6, crest.y() - 10, crest.x() + 6, crest.y()});
    canvas.labels.beside(canvas.over, crest + Vec2(0, -5), "crest", green);
}

namespace {

void draw_toe(Canvas& canvas, const Vec2& place) {
    if (!canvas.panel.shows(place)) return;
    const Vec2 toe = canvas.panel.at(place);
    canvas.over << "<path class=\"toe\" d=\"M" << px(toe.x()) << " " << px(toe.y())
                << "l-6 10h12z\" fill=\"#b3261e\" stroke=\"#fff\"/>\n";
    canvas.labels.take({toe.x() - 6, toe.y(), toe.x() + 6, toe.y() + 10});
    canvas.labels.beside(canvas.over, toe + Vec2(0, 5), "toe", "#b3261e");
}

}  // namespace

void draw_runout_marks(Canvas& canvas, const scene::Scene& scene) {
    if (!scene.mpm) return;
    const scene::Mpm& mpm = *scene.mpm;
    draw_toe(canvas, mpm.runout.toe);
    canvas.keys.push_back({"<path d=\"M12 1l-6 10h12z\" fill=\"#b3261e\"/>\n",
                           "MPM: toe, runout counts from " + place(mpm.runout.toe)});
    if (mpm.gauges.empty()) return;
    const Room room = canvas.panel.room();
    std::string list;
    for (const scene::Gauge& each : mpm.gauges) {
        list += (list.empty() ? "" : ", ") + each.name + " (x = " + short_number(each.x) + ")";
        const double x = canvas.panel.at({each.x, 0.0}).x();
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
                                   "MPM: grid of " + short_number(cells_x) + " x " +
                                       short_number(cells_y) + " cells of " +
                                       short_number(mpm.cell_size) + " m",
                                   " stroke-dasharray=\"7 3\""));
    if (!mpm.terrain.empty()) {
        draw_line(canvas, "terrain", across(canvas.panel, mpm.terrain, check::straight_level_at),
                  brown);
        canvas.keys.push_back(line_key(brown, "MPM: terrain"));
    } else {
        draw_line(canvas, "floor", {{left, mpm.floor.level}, {right, mpm.floor.level}}, brown);
        canvas.keys.push_back(
            line_key(brown, "MPM: floor at y = " + short_number(mpm.floor.level) + " m"));
    }
    std::string friction;
    for (const scene::FrictionZone& each : mpm.floor.friction)
        friction += (friction.empty() ? "" : "; ") + short_number(each.coefficient) +
                    " from x = " + short_number(each.from) + " to " + short_number(each.to);
    canvas.keys.push_back({"", friction.empty() ? "MPM: nothing slips on the ground"
                                                : "MPM: friction of the ground " + friction});
}

std::optional<std::string> motion_line(const scene::Scene& scene) {
    if (!scene.fem || !scene.fem->motion) return std::nullopt;
    try {
        const motion::Recording shaking = check::applied_motion(*scene.fem->motion);
        std::string line = "Motion " + scene.fem->motion->file.filename().string() + ": " +
                           motion::summary_of(shaking);
        if (shaking.quantity == motion::Quantity::acceleration) {
            const motion::StrongPart strong = motion::strong_part(shaking.series);
            line += ", Arias intensity " + rounded(motion::arias_intensity(shaking.series), 3) +
                    " m/s, strong part from " + rounded(strong.begin, 3) + " to " +
                    rounded(strong.end, 3) + " s";
        }
        if (scene.fem->motion->scale_to_pga_g)
            line += " (scaled to " + short_number(*scene.fem->motion->scale_to_pga_g) + " g)";
        return line;
    } catch (const fault::BadInput&) {  // the faults say what is wrong with it
    } catch (const fault::IoError&) {
    }
    return std::nullopt;
}

}  // namespace breach::report
