// One page from top to bottom: title, the section with everything that the scene says of it, the
// runout's grid if there is one, the legend, motion and cost, then faults and warnings in words.
// Each draw_ function returns where the next one begins.
#include "services/drawing/section_drawing.hpp"

#include <algorithm>
#include <cmath>

#include "core/scene/schema.hpp"
#include "services/drawing/fault_places.hpp"
#include "services/drawing/features.hpp"
#include "services/drawing/palette.hpp"

namespace breach::drawing {

using fault::Fault;
using nlohmann::json;

namespace {

constexpr double page_width = 1040, left = 60, text_width = 960, row = 20;
constexpr const char* red = "#c62828";
constexpr const char* amber = "#8a5a00";
constexpr std::size_t most_remarks = 20;

struct MarkedFault {
    const Fault& fault;
    std::vector<Trace> places;
};

/// Numbered in the order of the list below the picture.
std::vector<MarkedFault> marked(const Draft& draft) {
    std::vector<MarkedFault> marks;
    for (const Fault& each : draft.faults)
        marks.push_back({each, places_of(each, draft.base.scene, draft.scene)});
    return marks;
}

void extend(geometry::Box& box, const Vec2& place) {
    box.low = box.low.cwiseMin(place);
    box.high = box.high.cwiseMax(place);
}

std::optional<geometry::Box> box_around(const std::vector<const Trace*>& traces) {
    std::optional<geometry::Box> box;
    for (const Trace* trace : traces)
        for (const Vec2& each : *trace) {
            if (!each.allFinite()) continue;
            if (!box) box = geometry::Box{each, each};
            extend(*box, each);
        }
    return box;
}

/// Bounds of the section and of faults not much farther away; without a valid region, bounds of the
/// faults.
geometry::Box world_of(const scene::Scene& scene, const std::vector<MarkedFault>& marks) {
    std::vector<const Trace*> polygons, places;
    for (const scene::Region& each : scene.section.regions) polygons.push_back(&each.polygon);
    for (const MarkedFault& each : marks)
        for (const Trace& trace : each.places) places.push_back(&trace);
    std::optional<geometry::Box> box = box_around(polygons);
    // There is a place: can_be_drawn() was asked first.
    if (!box) return box_around(places).value();
    // A coordinate in the wrong unit must not shrink the section to a dot: its mark is put at the
    // edge.
    const Vec2 near = Vec2::Constant(0.25 * (box->high - box->low).maxCoeff());
    const geometry::Box limit{box->low - near, box->high + near};
    for (const Trace* trace : places)
        for (const Vec2& each : *trace)
            if (each.allFinite()) extend(*box, each.cwiseMax(limit.low).cwiseMin(limit.high));
    return *box;
}

std::string title_of(const Draft& draft) {
    const json& scene = draft.base.scene;
    for (const char* entry : {"title", "name"})
        if (scene.contains(entry) && scene.at(entry).is_string())
            return scene.at(entry).get<std::string>();
    return "A scene without a name";
}

// ---------------------------------------------------------------- regions

/// Materials in the order in which regions name them; each gets a colour.
std::vector<std::size_t> materials_of(const scene::Scene& scene) {
    std::vector<std::size_t> used;
    for (const scene::Region& each : scene.section.regions)
        if (!each.polygon.empty() && std::ranges::find(used, each.material) == used.end())
            used.push_back(each.material);
    return used;
}

std::size_t colour_index(const std::vector<std::size_t>& used, std::size_t material) {
    return static_cast<std::size_t>(std::ranges::find(used, material) - used.begin());
}

std::string material_name(const scene::Scene& scene, std::size_t material) {
    return material < scene.materials.size() ? scene.materials[material].name
                                             : "a material that cannot be read";
}

void draw_hatch_patterns(std::ostream& svg) {
    svg << "<defs>\n<pattern id=\"hatch-1\" width=\"9\" height=\"9\" "
           "patternUnits=\"userSpaceOnUse\">"
           "<path d=\"M0 9L9 0\" stroke=\"#000\" stroke-opacity=\"0.45\"/></pattern>\n"
           "<pattern id=\"hatch-2\" width=\"9\" height=\"9\" patternUnits=\"userSpaceOnUse\">"
           "<path d=\"M0 9L9 0M0 0L9 9\" stroke=\"#000\" stroke-opacity=\"0.45\"/></pattern>\n"
           "</defs>\n";
}

/// A material after the twelfth repeats a colour and gets a hatching on top.
std::string filled(const std::string& shape, std::size_t colour, const std::string& more) {
    std::string svg = shape + " fill=\"" + fill_of(colour).colour + "\" " + more + "/>\n";
    if (const std::size_t hatch = hatchings_of(colour); hatch > 0)
        svg += shape + " fill=\"url(#hatch-" + std::to_string(hatch) + ")\"/>\n";
    return svg;
}

/// outlined: on the runout's panel, where names are in the way.
enum class Regions { named, outlined };

void draw_regions(Canvas& canvas, const scene::Scene& scene, Regions how) {
    const std::vector<std::size_t> used = materials_of(scene);
    for (const scene::Region& each : scene.section.regions) {
        if (each.polygon.empty()) continue;
        const std::string name = "data-region=\"" + escaped(each.name) + "\" data-material=\"" +
                                 escaped(material_name(scene, each.material)) + "\" ";
        canvas.svg << filled("<path d=\"" + path_of(canvas.panel, each.polygon) + "Z\"",
                             colour_index(used, each.material),
                             how == Regions::named
                                 ? "class=\"region\" " + name + "stroke=\"#333\" stroke-width=\"1\""
                                 : "class=\"outline\" stroke=\"#333\" stroke-width=\"0.6\"");
    }
}

void add_material_keys(Canvas& canvas, const scene::Scene& scene) {
    const std::vector<std::size_t> used = materials_of(scene);
    for (std::size_t i = 0; i < used.size(); ++i) {
        std::string text = material_name(scene, used[i]);
        if (used[i] < scene.materials.size())
            text += std::string(" (") + materials::traits(scene.materials[used[i]].law).name + ")";
        std::string regions;
        for (const scene::Region& each : scene.section.regions)
            if (each.material == used[i] && !each.polygon.empty())
                regions += (regions.empty() ? "" : ", ") + each.name;
        canvas.keys.push_back({filled("<rect width=\"24\" height=\"12\"", i, "stroke=\"#333\""),
                               text + ": " + regions});
    }
}

/// Whether the whole label is inside the polygon.
/// A lattice of 15 places is enough for a text of one line.
bool holds(const geometry::Polygon& polygon, const Panel& panel, const Room& room) {
    for (const double across : {0.0, 0.25, 0.5, 0.75, 1.0})
        for (const double y : {room.top, 0.5 * (room.top + room.bottom), room.bottom})
            if (!geometry::contains(polygon,
                                    panel.back({room.left + across * (room.right - room.left), y})))
                return false;
    return true;
}

double depth_inside(const geometry::Polygon& polygon, const Vec2& place) {
    double least = INFINITY;
    for (const geometry::Side& side : geometry::sides_of(polygon))
        least = std::min(least, geometry::distance_to_segment(place, side.a, side.b));
    return geometry::contains(polygon, place) ? least : -least;
}

/// Lattice points of the region's box on the page, inside the polygon: the deepest first, and among
/// points that are deep enough the nearest to the centre [px].
std::vector<Vec2> places_inside(const geometry::Polygon& polygon, const Panel& panel) {
    constexpr int columns = 24, rows = 10;
    const geometry::Box box = geometry::bounding_box(polygon);
    std::vector<std::pair<double, Vec2>> places;
    for (int i = 1; i < columns; ++i)
        for (int j = 1; j < rows; ++j) {
            const Vec2 share(static_cast<double>(i) / columns, static_cast<double>(j) / rows);
            const Vec2 place = box.low + (box.high - box.low).cwiseProduct(share);
            const double depth = depth_inside(polygon, place);
            if (depth <= 0.0) continue;
            // Deeper than a label needs is no better: then the middle counts.
            const double enough = std::min(depth * panel.scale(), 24.0);  // px
            const double off = (share - Vec2(0.5, 0.5)).norm();
            places.emplace_back(enough - off, panel.at(place));
        }
    std::ranges::stable_sort(places, std::greater<>(), [](const auto& each) { return each.first; });
    std::vector<Vec2> sorted;
    for (const auto& each : places) sorted.push_back(each.second);
    return sorted;
}

/// Writes a name beside the section, with a line to its region.
void name_outside(Canvas& canvas, const scene::Scene& scene, const std::string& name,
                  const Vec2& anchor) {
    const auto in_soil = [&](const Room& room) {
        for (const double x : {room.left, 0.5 * (room.left + room.right), room.right})
            for (const double y : {room.top, room.bottom})
                if (geometry::in_soil(scene.section, canvas.panel.back({x, y}))) return true;
        return false;
    };
    // The nearest free place first.
    for (const double away : {26.0, 42.0, 60.0, 80.0, 110.0, 150.0})
        for (const double aside : {0.0, 40.0, -40.0, 90.0, -90.0, 150.0, -150.0})
            for (const double side : {-1.0, 1.0}) {
                const Vec2 centre = anchor + Vec2(aside, side * away);
                const Room room = Labels::around(centre, name);
                if (!canvas.labels.is_free(room) || in_soil(room)) continue;
                const double end = centre.y() - side * 8.0;
                canvas.over << "<path d=\"M" << px(anchor.x()) << " " << px(anchor.y()) << "L"
                            << px(centre.x()) << " " << px(end) << "\" stroke=\"#333\"/>\n"
                            << "<circle cx=\"" << px(anchor.x()) << "\" cy=\"" << px(anchor.y())
                            << "\" r=\"2\" fill=\"#333\"/>\n";
                canvas.labels.write(canvas.over, centre, name, "#111", Labels::Ground::lines);
                return;
            }
}

/// Names regions inside where the name fits, else beside the section, else only in the legend.
void name_regions(Canvas& canvas, const scene::Scene& scene) {
    const std::vector<std::size_t> used = materials_of(scene);
    for (const scene::Region& each : scene.section.regions) {
        if (each.polygon.empty()) continue;
        const std::vector<Vec2> places = places_inside(each.polygon, canvas.panel);
        const auto fits = std::ranges::find_if(places, [&](const Vec2& place) {
            const Room room = Labels::around(place, each.name);
            return canvas.labels.is_free(room) && holds(each.polygon, canvas.panel, room);
        });
        if (fits != places.end()) {
            const bool dark = fill_of(colour_index(used, each.material)).dark;
            canvas.labels.write(canvas.over, *fits, each.name, dark ? "#fff" : "#111");
        } else if (!places.empty()) {
            name_outside(canvas, scene, each.name, places.front());
        }
    }
}

// ---------------------------------------------------------------- mesh, faults

/// Each edge once, as neighbours share theirs: half the size, and no line drawn twice as dark.
void draw_mesh(Canvas& canvas, const DrawnMesh& mesh) {
    std::vector<std::pair<std::int32_t, std::int32_t>> edges;
    for (const auto& quad : mesh.quads)
        for (std::size_t k = 0; k < 4; ++k)
            edges.push_back(std::minmax(quad[k], quad[(k + 1) % 4]));
    std::ranges::sort(edges);
    edges.erase(std::ranges::unique(edges).begin(), edges.end());
    canvas.svg << "<path class=\"mesh\" fill=\"none\" stroke=\"#000\" stroke-opacity=\"0.45\" "
                  "stroke-width=\"0.5\" d=\"";
    for (const auto& [from, to] : edges) {
        const auto node = [&](std::int32_t i) { return mesh.nodes[static_cast<std::size_t>(i)]; };
        canvas.svg << path_of(canvas.panel, {node(from), node(to)});
    }
    canvas.svg << "\"/>\n";
    canvas.keys.push_back(
        {"<path d=\"M0 1h24M0 6h24M0 11h24M4 0v12M12 0v12M20 0v12\" "
         "stroke=\"#000\" stroke-opacity=\"0.5\"/>\n",
         "FEM: mesh of " + std::to_string(mesh.quads.size()) + " elements, " +
             std::to_string(mesh.nodes.size()) + " nodes"});
}

void draw_mark(Canvas& canvas, std::size_t number, const std::string& pointer, const Trace& trace) {
    const Panel& panel = canvas.panel;
    Trace seen;
    for (const Vec2& each : trace)
        if (each.allFinite()) seen.push_back(panel.inside(each));
    if (seen.empty()) return;
    canvas.over << "<g class=\"fault\" data-pointer=\"" << escaped(pointer) << "\">\n";
    if (seen.size() > 1) {
        canvas.over << "<path d=\"" << path_of(panel, seen) << "\" fill=\"none\" stroke=\"" << red
                    << "\" stroke-width=\"2.5\" stroke-dasharray=\"6 3\"/>\n";
    }
    // The number stands at the first point that can be shown.
    const Vec2 at = panel.at(seen.front());
    if (const Vec2 out = panel.at(trace.front()) - at; out.norm() > 1.0 && out.allFinite()) {
        const Vec2 end = at + 18.0 * out.normalized();  // the place is farther away
        canvas.over << "<path d=\"M" << px(at.x()) << " " << px(at.y()) << "L" << px(end.x()) << " "
                    << px(end.y()) << "\" stroke=\"" << red << "\" stroke-width=\"4\"/>\n";
    }
    canvas.over << "<circle cx=\"" << px(at.x()) << "\" cy=\"" << px(at.y()) << "\" r=\"9\" fill=\""
                << red << "\" stroke=\"#fff\" stroke-width=\"1.5\"/>\n"
                << text_at(at.x(), at.y() + 4, std::to_string(number),
                           "text-anchor=\"middle\" font-size=\"11\" font-weight=\"bold\" "
                           "fill=\"#fff\"")
                << "</g>\n";
}

// ---------------------------------------------------------------- the page

/// Breaks a text between words into lines of at most `width` pixels.
std::vector<std::string> broken(const std::string& text, double width) {
    std::vector<std::string> lines{""};
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find(' ', at), text.size());
        const std::string word = text.substr(at, end - at);
        std::string& line = lines.back();
        if (!line.empty() && Labels::width_of(line + " " + word) > width) {
            lines.push_back(word);
        } else {
            line += (line.empty() ? "" : " ") + word;
        }
        at = end + 1;
    }
    return lines;
}

std::string line_at(double x, double y, const std::string& text, const std::string& more = "") {
    return text_at(x, y, text, "font-size=\"12\" " + more);
}

/// Draws keys from left to right; returns their lower end.
double draw_keys(std::ostream& svg, const std::vector<Key>& keys, double y) {
    double x = left;
    svg << "<g class=\"keys\">\n";
    for (const Key& key : keys) {
        const std::vector<std::string> lines = broken(key.text, text_width - 40);
        double widest = 0.0;
        for (const std::string& each : lines) widest = std::max(widest, Labels::width_of(each));
        if (x > left && x + 32 + widest > left + text_width) x = left, y += row;
        svg << "<g transform=\"translate(" << px(x) << " " << px(y) << ")\">" << key.symbol
            << "</g>\n";
        for (std::size_t i = 0; i < lines.size(); ++i) {
            if (i > 0) y += 16;
            svg << line_at(x + 32, y + 10, lines[i]);
        }
        // A key of several lines has its row for itself.
        x = lines.size() > 1 ? left + text_width : x + 32 + widest + 18;
    }
    svg << "</g>\n";
    return y + row;
}

double draw_foot(std::ostream& svg, const std::vector<std::string>& foot, double y) {
    svg << "<g class=\"foot\">\n";
    for (const std::string& text : foot)
        for (const std::string& each : broken(text, text_width))
            svg << line_at(left, y += 17, each, "xml:space=\"preserve\"");
    svg << "</g>\n";
    return y;
}

/// A remark below the picture; `data`: attributes of its group.
struct Remark {
    std::string data;
    std::string text;
};

/// At most twenty, or the list would hide the picture.
double list_remarks(std::ostream& svg, const std::vector<Remark>& remarks, const std::string& kind,
                    const std::string& colour, double y) {
    if (remarks.empty()) return y;
    svg << line_at(
        left, y += 26,
        remarks.size() == 1 ? "1 " + kind : std::to_string(remarks.size()) + " " + kind + "s",
        "font-weight=\"bold\" fill=\"" + colour + "\"");
    for (std::size_t i = 0; i < std::min(remarks.size(), most_remarks); ++i) {
        svg << "<g class=\"" << kind << "\" " << remarks[i].data << " fill=\"" << colour << "\">\n";
        for (const std::string& each :
             broken(std::to_string(i + 1) + "  " + remarks[i].text, text_width))
            svg << line_at(left, y += 17, each);
        svg << "</g>\n";
    }
    if (remarks.size() > most_remarks)
        svg << line_at(left, y += 17,
                       "and " + std::to_string(remarks.size() - most_remarks) + " more");
    return y;
}

std::string attribute(const char* name, const std::string& value) {
    return std::string(" data-") + name + "=\"" + escaped(value) + "\"";
}

/// The attributes are for the page, which leads from a fault to its entry (live_drawing.js).
double list_faults(std::ostream& svg, const Draft& draft, const std::vector<Fault>& of_study,
                   double y) {
    std::vector<Remark> remarks;
    const auto add = [&](const std::string& pointer, const Fault& fault) {
        remarks.push_back({attribute("pointer", pointer) + attribute("cause", fault.cause) +
                               attribute("remedy", fault.remedy),
                           (pointer.empty() ? "/" : pointer) + " " + fault.cause +
                               (fault.remedy.empty() ? "" : ": " + fault.remedy)});
    };
    for (const Fault& each : draft.faults) add(draft.base.pointer + each.pointer, each);
    for (const Fault& each : of_study) add(each.pointer, each);
    return list_remarks(svg, remarks, "fault", red, y);
}

double list_warnings(std::ostream& svg, const std::vector<fault::Flag>& warnings, double y) {
    std::vector<Remark> remarks;
    for (const fault::Flag& each : warnings)
        remarks.push_back({attribute("pointer", each.pointer) + attribute("code", each.code) +
                               attribute("warning", each.message),
                           (each.pointer.empty() ? "" : each.pointer + " ") + each.message});
    return list_remarks(svg, remarks, "warning", amber, y);
}

/// Writes a finished panel: its picture clipped at its border, marks and text above.
void put(std::ostream& svg, const Canvas& canvas, const std::string& name) {
    const Room room = canvas.panel.room();
    svg << "<clipPath id=\"drawn-" << name << "\"><rect x=\"" << px(room.left) << "\" y=\""
        << px(room.top) << "\" width=\"" << px(room.right - room.left) << "\" height=\""
        << px(room.bottom - room.top) << "\"/></clipPath>\n";
    draw_axes(svg, canvas.panel);
    svg << "<g class=\"" << name << "\" clip-path=\"url(#drawn-" << name << ")\">\n"
        << canvas.svg.str() << "</g>\n"
        << canvas.over.str();
}

Canvas canvas_of(const geometry::Box& world, double top, double most_height) {
    Panel panel(world, top, most_height);
    const Room room = panel.room();
    return {panel, Labels({room.left + 2, room.top + 2, room.right - 2, room.bottom - 2})};
}

/// Drawn from below to above: soil, mesh, water, what acts, names, and faults over all of them.
Canvas section_of(const Draft& draft, const Additions& additions,
                  const std::vector<MarkedFault>& marks, double top) {
    const scene::Scene& scene = draft.scene;
    Canvas canvas = canvas_of(world_of(scene, marks), top, 470);
    draw_regions(canvas, scene, Regions::named);
    add_material_keys(canvas, scene);
    if (additions.mesh) draw_mesh(canvas, *additions.mesh);
    draw_water(canvas, scene);
    draw_stability(canvas, scene);
    draw_supports(canvas, scene);
    draw_runout_marks(canvas, scene);
    name_regions(canvas, scene);
    for (std::size_t i = 0; i < marks.size(); ++i)
        for (const Trace& each : marks[i].places)
            draw_mark(canvas, i + 1, draft.base.pointer + marks[i].fault.pointer, each);
    return canvas;
}

Canvas runout_of(const scene::Scene& scene, double top) {
    const scene::Mpm& mpm = *scene.mpm;
    const geometry::Box world{{mpm.domain_x[0], mpm.domain_y[0]},
                              {mpm.domain_x[1], mpm.domain_y[1]}};
    Canvas canvas = canvas_of(world, top, 280);
    draw_regions(canvas, scene, Regions::outlined);
    draw_grid(canvas, scene);
    // Kept aside while the marks are drawn, which add keys of their own.
    std::vector<Key> keys = std::move(canvas.keys);
    draw_runout_marks(canvas, scene);
    canvas.keys = std::move(keys);  // toe and gauges are listed beside the section
    return canvas;
}

}  // namespace

/// Variants are not drawn: the picture is of what all of them share.
BaseScene base_scene_of(const json& document) {
    if (!document.is_object() || !document.contains("scene")) return {document, {}, ""};
    if (!document.at("scene").is_object())
        throw fault::BadInput("study", {{"/scene", "is not the scene itself",
                                         "put the scene into the study instead of its path"}});
    BaseScene base{document.at("scene"), {}, "/scene"};
    if (const auto list = document.find("overrides"); list != document.end() && list->is_array())
        for (const json& each : *list)
            if (each.is_string()) base.overrides.push_back(each.get<std::string>());
    return base;
}

/// The checked scene has the overrides already; the document gets them too, because places of
/// faults are looked up in it.
Draft draft_of(BaseScene base, check::Checked checked) {
    for (const std::string& each : base.overrides) scene::apply_override(base.scene, each);
    return {std::move(base), std::move(checked.scene), std::move(checked.faults)};
}

bool can_be_drawn(const Draft& draft) {
    const bool soil =
        std::ranges::any_of(draft.scene.section.regions,
                            [](const scene::Region& each) { return !each.polygon.empty(); });
    return soil || std::ranges::any_of(
                       marked(draft), [](const MarkedFault& each) { return !each.places.empty(); });
}

std::string as_svg(const Draft& draft, const Additions& additions) {
    const std::vector<MarkedFault> marks = marked(draft);
    std::ostringstream svg;
    const std::vector<std::string> title = broken(title_of(draft), 0.8 * text_width);
    double y = 10;
    for (const std::string& each : title)
        svg << text_at(left, y += 20, each, "font-size=\"15\" font-weight=\"bold\"");
    draw_hatch_patterns(svg);
    const Canvas section = section_of(draft, additions, marks, y + 14);
    put(svg, section, "section");
    y = section.panel.room().bottom + 46;
    std::vector<Key> keys = section.keys;
    if (draft.scene.mpm) {
        const Canvas runout = runout_of(draft.scene, y);
        put(svg, runout, "runout");
        y = runout.panel.room().bottom + 46;
        keys.insert(keys.end(), runout.keys.begin(), runout.keys.end());
    }
    y = draw_keys(svg, keys, y);
    std::vector<std::string> foot;
    if (auto motion = motion_line(draft.scene)) foot.push_back(std::move(*motion));
    if (!additions.foot.empty()) foot.push_back("One run of each phase will take about:");
    foot.insert(foot.end(), additions.foot.begin(), additions.foot.end());
    y = draw_foot(svg, foot, y);
    y = list_faults(svg, draft, additions.faults, y);
    y = list_warnings(svg, additions.warnings, y);
    // Last, because the height is known only now.
    const std::string size = px(page_width) + "\" height=\"" + px(y + 20);
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + px(page_width) + " " +
           px(y + 20) + "\" width=\"" + size +
           "\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"14\" fill=\"#222\">\n"
           "<title>" +
           escaped(title_of(draft)) +
           "</title>\n"
           "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n" +
           svg.str() + "</svg>\n";
}

}  // namespace breach::drawing
