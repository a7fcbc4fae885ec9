// Sorts outlines by the meaning of their layers. Layers come in the order of the drawing, as
// regions are numbered and healed in it. Called once by import_section(), after the drawing was
// read; the outlines are moved, not copied.
#include <algorithm>
#include <cmath>

#include "services/import/join_lines.hpp"
#include "services/import/steps.hpp"

namespace breach::importing {

namespace {

/// Whether corners and middles of the sides lie in the polygon.
/// Corners alone would accept a hatch that crosses a bay of the outline.
bool lies_in(const std::vector<Vec2>& inner, const std::vector<Vec2>& outer, double off) {
    for (std::size_t i = 0; i < inner.size(); ++i) {
        const Vec2 middle = 0.5 * (inner[i] + inner[(i + 1) % inner.size()]);
        if (!geometry::contains(outer, inner[i], off) || !geometry::contains(outer, middle, off))
            return false;
    }
    return true;
}

/// Adds areas to the outlines of their layer, except those that lie in one: a hatch repeats it.
void take_areas(std::vector<Outline> areas, std::vector<Outline>& whole, double off, Notes& notes) {
    std::ranges::stable_sort(areas, std::ranges::greater(), [](const Outline& each) {
        return std::abs(geometry::signed_area(each.points));
    });
    for (Outline& each : areas) {
        const auto around = std::ranges::find_if(whole, [&](const Outline& outline) {
            return outline.closed && lies_in(each.points, outline.points, off);
        });
        if (around == whole.end()) {
            whole.push_back(std::move(each));
        } else if (around->fills && around->origin.line == each.origin.line) {
            notes.refuse(at_line(each.origin.line),
                         named(each) + " has an island at " + text(each.points.front()),
                         "a region has no holes: draw its parts around the island as closed "
                         "polylines");
        }
    }
}

/// Open outlines are kept as soils, too: the picture of the faults shows them. Names are unique in
/// the scene, also where two layers differ only in characters that names cannot have.
std::vector<Soil> soils_of(const std::vector<Outline>& outlines, const std::string& layer,
                           const std::string& material, std::set<std::string>& names,
                           Notes& notes) {
    std::vector<Soil> soils;
    const std::string base = as_name(layer, "region");
    if (base != layer) notes.remark("regions of layer " + layer + " are named " + base);
    std::size_t number = 0;
    for (const Outline& each : outlines) {
        std::string name = base;
        if (outlines.size() > 1) name += "_" + std::to_string(++number);
        while (!names.insert(name).second) name += "_b";
        soils.push_back({name, layer, material, each.points, each.origin});
        if (each.closed) continue;
        const Vec2 &a = each.points.front(), &b = each.points.back();
        notes.refuse(at_line(each.origin.line),
                     named(each) + " is open: its ends " + text(a) + " and " + text(b) + " are " +
                         metres((a - b).norm()) + " apart",
                     "close the polyline, or map its layer to phreatic, terrain, ground or none");
    }
    return soils;
}

}  // namespace

/// Each run of other characters becomes one "_", none at either end.
std::string as_name(const std::string& text, const std::string& otherwise) {
    std::string name;
    for (const char each : text) {
        const bool fits = (each >= 'a' && each <= 'z') || (each >= 'A' && each <= 'Z') ||
                          (each >= '0' && each <= '9') || each == '_' || each == '-';
        if (fits || (!name.empty() && name.back() != '_')) name += fits ? each : '_';
    }
    name.resize(std::min<std::size_t>(name.size(), 40));
    while (!name.empty() && name.back() == '_') name.pop_back();
    return name.empty() ? otherwise : name;
}

Sorted sorted(Drawing& drawing, const LayerMap& map, Notes& notes) {
    const Request& request = notes.request;
    Sorted out;
    std::set<std::string> names;
    std::vector<std::string> order;
    std::map<std::string, std::vector<Outline>> by_layer;
    for (Outline& each : drawing.outlines) {
        if (!by_layer.contains(each.layer)) order.push_back(each.layer);
        by_layer[each.layer].push_back(std::move(each));
    }
    for (const std::string& layer : order) {
        const Meaning meaning = map.meaning_of(layer);
        std::vector<Outline>& pieces = by_layer[layer];
        const auto areas =
            std::ranges::stable_partition(pieces, [](const Outline& each) { return !each.fills; });
        std::vector<Outline> fills(std::make_move_iterator(areas.begin()),
                                   std::make_move_iterator(areas.end()));
        pieces.erase(areas.begin(), areas.end());
        std::vector<Outline> whole = joined(std::move(pieces), request.tolerance);
        take_areas(std::move(fills), whole, request.tolerance + request.flatten.value_or(0.0),
                   notes);
        if (meaning.role == Role::soil) {
            for (Soil& each : soils_of(whole, layer, meaning.material, names, notes))
                out.soils.push_back(std::move(each));
        } else {
            for (Outline& each : whole) out.lines[meaning.role].push_back(std::move(each));
        }
    }
    if (out.soils.empty())
        notes.refuse("drawing",
                     "there is no closed polyline on a layer with a material; the layers are " +
                         layers_named(drawing.layers),
                     "map a layer to a material, or name layers as the materials are named");
    return out;
}

}  // namespace breach::importing
