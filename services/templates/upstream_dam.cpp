// Starter dam on the foundation; raises on the tailings upstream of it. From the toe upwards, each
// dyke begins on the crest below and stands mostly on tailings.
#include <algorithm>
#include <cmath>

#include "services/templates/outline.hpp"

namespace breach::templates {

namespace {

/// One dyke: a trapezoid on the level `base`.
struct Dyke {
    double base, top;
    double heel, upstream_edge, downstream_edge, toe;  ///< x
    double heel_level;
};

Dyke dyke_at(double toe, double base, double top, double face, const Values& values) {
    Dyke dyke{.base = base,
              .top = top,
              .heel = 0,
              .upstream_edge = 0,
              .downstream_edge = 0,
              .toe = toe,
              .heel_level = base};
    dyke.downstream_edge = toe - face * (top - base);
    dyke.upstream_edge = dyke.downstream_edge - values["crest_width"];
    dyke.heel = dyke.upstream_edge - values["upstream_slope"] * (top - base);
    return dyke;
}

/// Every dyke is built from its toe, so that the first one's toe is exactly the origin.
std::vector<Dyke> dykes_of(const Values& values) {
    const int raises = values.whole("raises");
    const double height = values["height"];
    const double starter = raises == 0 ? height : values["starter_height"];
    std::vector<Dyke> dykes{dyke_at(0.0, 0.0, starter, values["starter_slope"], values)};
    // The ground rises towards its upstream face.
    const double rise = values["valley_slope"];
    dykes[0].heel /= 1.0 + rise * values["upstream_slope"];
    dykes[0].heel_level = -rise * dykes[0].heel;
    for (int k = 1; k <= raises; ++k) {
        const double base = dykes.back().top;
        // Equal steps; the last one ends exactly at the height.
        const double top = k == raises ? height : starter + k * (height - starter) / raises;
        const double toe = dykes.back().downstream_edge - values["bench_width"];
        const double share = raises > 1 ? (k - 1.0) / (raises - 1.0) : 0.0;
        const double face = std::lerp(values["raise_slope"], values["last_raise_slope"], share);
        dykes.push_back(dyke_at(toe, base, top, face, values));
    }
    return dykes;
}

void check_raises(const Values& values) {
    Refusal refusal(values);
    if (values.whole("raises") > 0) {
        refusal.unless(values["starter_height"] <= 0.95 * values["height"], "starter_height",
                       "leaves nothing to raise on a dam of " + metres(values["height"]),
                       "give at most 0.95 height, or raises 0");
        refusal.unless(
            values["bench_width"] <= 0.75 * values["crest_width"], "bench_width",
            "the next raise would not stand on a crest of " + metres(values["crest_width"]),
            "give at most three quarters of crest_width");
    }
    refusal.speak();
}

void check_beach(const Values& values, const Dyke& last, double at_heel, double at_end) {
    Refusal refusal(values);
    refusal.unless(values["freeboard"] <= 0.5 * (last.top - last.base), "freeboard",
                   "the last dyke is only " + metres(last.top - last.base) + " high",
                   "give at most half of that");
    refusal.unless(at_heel > last.base + 0.2 * (last.top - last.base), "beach_slope",
                   "the beach falls below the base of the last dyke before it has covered it",
                   "make it flatter, lower freeboard, or make fewer raises");
    const bool valley = values["valley_slope"] > values["beach_slope"];
    refusal.unless(at_end >= 0.3 * values["height"], valley ? "valley_slope" : "beach_slope",
                   "tailings at the model's end would be " + metres(at_end) + " thick",
                   "make it flatter, or shorten beach_length or pond_length");
    refusal.speak();
}

/// On a steep valley floor a raise would leave the tailings and stand on the ground.
void check_ground(const Values& values, const std::vector<Dyke>& dykes) {
    Refusal refusal(values);
    const Terrain terrain(values);
    check_heel(refusal, dykes[0].heel_level, dykes[0].top);
    for (std::size_t k = 1; k < dykes.size(); ++k)
        refusal.unless(terrain.at(dykes[k].heel) < dykes[k].base - values["cell_size"],
                       "valley_slope",
                       "raise " + std::to_string(k) + " would stand on the ground, not on tailings",
                       "make it flatter, or make fewer raises");
    refusal.speak();
}

/// The phreatic line needs a length to fall over between the pond and a drain.
void check_drain(const Values& values, double span, double level) {
    Refusal refusal(values);
    refusal.unless(
        span > 0.3 * level, "drain",
        "the starter dam's heel lies only " + metres(span) + " downstream of the pond's edge",
        "lengthen beach_length, or leave the drain out");
    refusal.speak();
}

}  // namespace

Outline upstream_dam(const Values& values) {
    check_raises(values);
    const Terrain terrain(values);
    const std::vector<Dyke> dykes = dykes_of(values);
    check_ground(values, dykes);
    const Dyke& last = dykes.back();
    const double fall = values["beach_slope"];
    const Vec2 contact{last.upstream_edge - values["upstream_slope"] * values["freeboard"],
                       last.top - values["freeboard"]};
    const auto surface = [&](double x) { return contact.y() - fall * (contact.x() - x); };
    const double edge = contact.x() - values["beach_length"];
    double left = edge - values["pond_length"];
    // A dyke's heel may lie further upstream than the end of a short pond.
    for (const Dyke& each : dykes) left = std::min(left, each.heel - 0.1 * values["height"]);
    check_beach(values, last, surface(last.heel), surface(left) - terrain.at(left));
    const double exit = values.is_on("drain") ? dykes.front().heel : 0.0;
    check_drain(values, exit - edge, surface(edge));

    Outline outline;
    Polygon tailings{{left, terrain.at(left)}};
    outline.ground = {{left, surface(left)}, contact, {last.upstream_edge, last.top}};
    for (std::size_t k = 0; k < dykes.size(); ++k) {
        const Dyke& each = dykes[k];
        Polygon ring{{each.heel, each.heel_level}};
        if (k > 0) ring.push_back({dykes[k - 1].upstream_edge, each.base});
        ring.push_back({each.toe, each.base});
        ring.push_back({each.downstream_edge, each.top});
        // With a bench, the next toe lies on this crest; without, both points are the same.
        if (k + 1 < dykes.size() && dykes[k + 1].toe < each.downstream_edge)
            ring.push_back({dykes[k + 1].toe, each.top});
        ring.push_back({each.upstream_edge, each.top});
        if (k + 1 == dykes.size()) ring.push_back(contact);
        outline.parts.push_back({k == 0 ? "starter_dam" : "raise_" + std::to_string(k),
                                 k == 0 ? starter_fill(values) : "embankment", ring});
        // The tailings' border runs up the dam: along each dyke's upstream face and the base of the
        // next.
        tailings.push_back({each.heel, each.heel_level});
        tailings.push_back(k + 1 == dykes.size() ? contact : Vec2{each.upstream_edge, each.top});
    }
    tailings.push_back({left, surface(left)});
    for (auto each = dykes.rbegin(); each != dykes.rend(); ++each) {
        outline.ground.push_back({each->downstream_edge, each->top});
        const bool bench = each + 1 != dykes.rend() && each->toe < (each + 1)->downstream_edge;
        if (bench || each + 1 == dykes.rend()) outline.ground.push_back({each->toe, each->base});
    }
    outline.parts.push_back({"tailings", "tailings", tailings});
    outline.wet = "tailings";
    outline.crest = {last.downstream_edge, last.top};
    outline.crest_from = last.upstream_edge;
    outline.left = left;
    part_slimes(values, contact, std::ranges::min(dykes, {}, &Dyke::heel).heel, outline);
    add_water(values, {edge, surface(edge)}, exit, outline);
    return outline;
}

}  // namespace breach::templates
