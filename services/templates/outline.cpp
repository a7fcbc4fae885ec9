// What all templates share: ground, water and parts. The phreatic line is a parabola from the
// pond to its exit (Dupuit), or straight through a measured level.
#include "services/templates/outline.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/geometry/polyline.hpp"

namespace breach::templates {

namespace {

struct Seepage {
    Vec2 from, exit;
    std::optional<Vec2> measured;
};

Line phreatic_line(const Seepage& flow, double left, double right, const Line& ground,
                   const Terrain& terrain) {
    constexpr int pieces = 8;
    const auto& [from, exit, measured] = flow;
    const double span = exit.x() - from.x();
    // Points closer than this would give the mesh tiny elements.
    const double same = 0.005 * span;
    std::vector<double>
        xs;  // kinks of the ground, so that no chord leaves it, and points of the parabola
    for (const Vec2& kink : ground)
        if (kink.x() > from.x() + same && kink.x() < exit.x() - same) xs.push_back(kink.x());
    const auto add = [&](double x) {
        const auto near = [&](double other) { return std::abs(other - x) < same; };
        if (std::ranges::none_of(xs, near)) xs.push_back(x);
    };
    if (measured) add(measured->x());
    for (int i = 1; i < pieces && !measured; ++i) {
        // Equal steps of the level, so that the points lie close where the parabola falls steeply.
        const double share = 1.0 - static_cast<double>(i) / pieces;  // of the remaining height
        add(exit.x() - span * share * share);
    }
    std::ranges::sort(xs);
    const auto level = [&](double x) {
        if (measured) return geometry::level_at(Line{from, *measured, exit}, x);
        return exit.y() + (from.y() - exit.y()) * std::sqrt((exit.x() - x) / span);
    };
    Line line{{left, from.y()}, from};
    for (const double x : xs)
        // Water above the ground would be a pond on the face.
        line.push_back({x, std::min(level(x), geometry::level_at(ground, x))});
    line.push_back(exit);
    if (exit.x() < -same && !terrain.is_level()) line.push_back({0.0, 0.0});
    if (right > exit.x() + same) line.push_back({right, terrain.at(right)});
    // The level stretch is too short for a side of its own.
    if (from.x() - left < same) line.erase(line.begin());
    line.front().x() = left;
    return line;
}

/// The level in the piezometer below the crest, if the template has it; refused above the water at
/// `from` or below it at `exit`.
std::optional<Vec2> measured_level(const Values& values, const Vec2& crest, const Vec2& from,
                                   const Vec2& exit) {
    const double depth = values.or_none("piezometer_depth");
    if (depth == 0.0) return std::nullopt;
    const Vec2 level{crest.x(), crest.y() - depth};
    Refusal refusal(values);
    refusal.unless(exit.x() > level.x() + 0.1 * values["crest_width"], "drain",
                   "the drain lies upstream of the piezometer in the crest",
                   "leave piezometer_depth or the drain out");
    refusal.unless(level.y() <= from.y() && level.y() >= exit.y(), "piezometer_depth",
                   "the level would be " + metres(level.y()) + ", and the water falls from " +
                       metres(from.y()) + " at the pond to " + metres(exit.y()) + " at its exit",
                   "give from " + metres(std::max(0.0, crest.y() - from.y())) + " to " +
                       metres(crest.y() - exit.y()));
    refusal.speak();
    return level;
}

/// Raises the line to a pond of that depth at `from`: level to where it meets the ground, then down
/// to the line below the crest. Refused where it would stand over the crest.
void raise_to_pond(const Values& values, double level, Outline& outline) {
    Refusal refusal(values);
    refusal.unless(level < outline.crest.y(), "pond_depth",
                   "the water would stand at " + metres(level) + ", and the crest at " +
                       metres(outline.crest.y()),
                   "keep some freeboard: overtopping is out of scope");
    refusal.speak();
    const auto shore =
        std::ranges::find_if(outline.ground, [&](const Vec2& each) { return each.y() > level; });
    const Vec2 &above = *shore, &below = *std::prev(shore);
    const double x = geometry::on_straight({below.y(), below.x()}, {above.y(), above.x()}, level);
    const double crest = outline.crest.x();
    Line line{
        {outline.left, level}, {x, level}, {crest, geometry::level_at(outline.phreatic, crest)}};
    for (const Vec2& each : outline.phreatic)
        if (each.x() > crest) line.push_back(each);
    outline.phreatic = std::move(line);
}

}  // namespace

void add_water(const Values& values, const Vec2& from, double exit, Outline& outline) {
    const Terrain terrain(values);
    const Vec2 end{exit, terrain.at(exit)};
    const Vec2 crest{outline.crest_from, outline.crest.y()};
    outline.phreatic =
        phreatic_line({from, end, measured_level(values, crest, from, end)}, outline.left,
                      values["foundation_extent"], outline.ground, terrain);
    if (const double depth = values.or_none("pond_depth"); depth > 0.0)
        raise_to_pond(values, from.y() + depth, outline);
}

void check_heel(Refusal& refusal, double heel_level, double starter) {
    refusal.unless(heel_level < 0.5 * starter, "valley_slope",
                   "the ground rises to the upper half of the starter dam", "make it flatter");
}

/// An upright border: the option gives one distance for all depths.
void part_slimes(const Values& values, const Vec2& contact, double heel, Outline& outline) {
    const double distance = values["slimes_distance"];
    if (distance == 0.0) return;
    const double border = contact.x() - distance;
    Refusal refusal(values);
    refusal.unless(border >= outline.left + 2.0 * values["cell_size"], "slimes_distance",
                   "the model ends " + metres(contact.x() - outline.left) + " behind the dam",
                   "give less, or lengthen pond_length");
    refusal.unless(border <= heel - values["cell_size"], "slimes_distance",
                   "the dam's own fill reaches " + metres(contact.x() - heel) + " behind the beach",
                   "give a cell more than that, or 0");
    refusal.speak();
    for (Part& part : outline.parts) {
        if (part.name != outline.wet) continue;
        Part slimes{"slimes", "slimes", {}};
        Polygon beach;
        for (std::size_t i = 0; i < part.polygon.size(); ++i) {
            const Vec2 &a = part.polygon[i], &b = part.polygon[(i + 1) % part.polygon.size()];
            // One pass around the ring; where it crosses the border both pieces get the place.
            (a.x() < border ? slimes.polygon : beach).push_back(a);
            if ((a.x() < border) == (b.x() < border)) continue;
            const Vec2 place{border, a.y() + (b.y() - a.y()) * (border - a.x()) / (b.x() - a.x())};
            slimes.polygon.push_back(place);
            beach.push_back(place);
        }
        part.polygon = beach;
        outline.parts.push_back(slimes);
        return;
    }
}

}  // namespace breach::templates
