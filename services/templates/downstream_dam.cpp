// Starter dam on the foundation; each raise covers the downstream face of the previous stage. The
// upstream face is one line from heel to crest, so each stage is given by three places along x. The
// last stage's toe is the origin, and all else lies at negative x.
#include <algorithm>

#include "services/templates/layers.hpp"

namespace breach::templates {

namespace {

/// The dam at one time.
struct Stage {
    double height;
    double upstream_edge, downstream_edge, toe;  ///< x
};

/// In terms of options, before any polygon exists: a person corrects numbers, not rings.
void check(const Values& values, double at_end, double heel_level, double starter) {
    Refusal refusal(values);
    if (values.whole("raises") > 0)
        refusal.unless(values["starter_height"] <= 0.95 * values["height"], "starter_height",
                       "leaves nothing to raise on a dam of " + metres(values["height"]),
                       "give at most 0.95 height, or raises 0");
    refusal.unless(values["freeboard"] <= 0.5 * values["height"], "freeboard",
                   "half of the dam or more would stand above the beach",
                   "give at most half of height");
    const bool valley = values["valley_slope"] > values["beach_slope"];
    refusal.unless(at_end >= 0.3 * values["height"], valley ? "valley_slope" : "beach_slope",
                   "tailings at the model's end would be " + metres(at_end) + " thick",
                   "make it flatter, lower freeboard, or shorten beach_length or pond_length");
    check_heel(refusal, heel_level, starter);
    refusal.speak();
}

}  // namespace

Outline downstream_dam(const Values& values) {
    const double H = values["height"], up = values["upstream_slope"],
                 down = values["downstream_slope"], width = values["crest_width"];
    const int raises = values.whole("raises");
    const double starter = raises == 0 ? H : values["starter_height"];
    const Terrain terrain(values);
    const double level_heel = -(up * H + width + down * H);
    // On rising ground the face ends where it meets the ground, not on the level of the toe.
    const double heel = level_heel / (1.0 + up * terrain.rise);
    std::vector<Stage> stages;
    for (int k = 0; k <= raises; ++k) {
        const double height = k == raises ? H : starter + k * (H - starter) / raises;
        const double edge = level_heel + up * height;
        const double foot = edge + width + down * height;  // on level ground
        stages.push_back({height, edge, edge + width, foot / (1.0 - down * terrain.rise)});
    }
    // Exactly, without the rounding of the sum: the toe is a vertex of ground and terrain.
    stages.back().toe = 0.0;
    const Stage& last = stages.back();
    const double fall = values["beach_slope"];
    // Where the beach meets the dam.
    const Vec2 contact{last.upstream_edge - up * values["freeboard"], H - values["freeboard"]};
    const auto surface = [&](double x) { return contact.y() - fall * (contact.x() - x); };
    const double edge = contact.x() - values["beach_length"];
    // The model must contain the whole dam, however short the pond is.
    const double left = std::min(edge - values["pond_length"], heel - 0.1 * H);
    check(values, surface(left) - terrain.at(left), terrain.at(heel), starter);

    Outline outline;
    outline.parts.push_back({"starter_dam",
                             starter_fill(values),
                             {{heel, terrain.at(heel)},
                              {stages[0].toe, terrain.at(stages[0].toe)},
                              {stages[0].downstream_edge, starter},
                              {stages[0].upstream_edge, starter}}});
    for (std::size_t k = 1; k < stages.size(); ++k) {
        const Stage &before = stages[k - 1], &after = stages[k];
        outline.parts.push_back({"raise_" + std::to_string(k),
                                 "embankment",
                                 {{before.toe, terrain.at(before.toe)},
                                  {after.toe, terrain.at(after.toe)},
                                  {after.downstream_edge, after.height},
                                  {after.upstream_edge, after.height},
                                  {before.upstream_edge, before.height},
                                  {before.downstream_edge, before.height}}});
    }
    outline.parts.push_back(
        {"tailings",
         "tailings",
         {{left, terrain.at(left)}, {heel, terrain.at(heel)}, contact, {left, surface(left)}}});
    share_vertices(outline.parts);
    outline.ground = {{left, surface(left)},
                      contact,
                      {last.upstream_edge, H},
                      {last.downstream_edge, H},
                      {0.0, 0.0}};
    outline.wet = "tailings";
    outline.crest = {last.downstream_edge, H};
    outline.crest_from = last.upstream_edge;
    outline.left = left;
    // A drain below the crest's middle keeps the downstream half of the dam dry.
    const double axis = last.upstream_edge + 0.5 * width;
    part_slimes(values, contact, heel, outline);
    add_water(values, {edge, surface(edge)}, values.is_on("drain") ? axis : 0.0, outline);
    return outline;
}

}  // namespace breach::templates
