// Starter dam on the foundation, every raise on the downstream face of what stood before.
#include <algorithm>

#include "services/templates/layers.hpp"

namespace breach::templates {

namespace {

/// The dam as it stood at one time.
struct Stage {
    double height;
    double upstream_edge, downstream_edge, toe;  ///< x
};

void check(const Values& values, double at_end) {
    Refusal refusal(values);
    if (values.whole("raises") > 0)
        refusal.unless(values["starter_height"] <= 0.95 * values["height"], "starter_height",
                       "leaves nothing to raise on a dam of " + metres(values["height"]),
                       "give at most 0.95 height, or raises 0");
    refusal.unless(values["freeboard"] <= 0.5 * values["height"], "freeboard",
                   "half of the dam or more would stand above the beach",
                   "give at most half of height");
    refusal.unless(at_end >= 0.3 * values["height"], "beach_slope",
                   "tailings at the model's end would be " + metres(at_end) + " high",
                   "make it flatter, lower freeboard, or shorten beach_length or pond_length");
    refusal.speak();
}

}  // namespace

Outline downstream_dam(const Values& values) {
    const double H = values["height"], up = values["upstream_slope"],
                 down = values["downstream_slope"], width = values["crest_width"];
    const int raises = values.whole("raises");
    const double starter = raises == 0 ? H : values["starter_height"];
    const double heel = -(up * H + width + down * H);
    std::vector<Stage> stages;
    for (int k = 0; k <= raises; ++k) {
        const double height = k == raises ? H : starter + k * (H - starter) / raises;
        const double edge = heel + up * height;
        stages.push_back({height, edge, edge + width, edge + width + down * height});
    }
    stages.back().toe = 0.0;
    const Stage& last = stages.back();
    const double fall = values["beach_slope"];
    const Vec2 contact{last.upstream_edge - up * values["freeboard"], H - values["freeboard"]};
    const auto surface = [&](double x) { return contact.y() - fall * (contact.x() - x); };
    const double edge = contact.x() - values["beach_length"];
    const double left = std::min(edge - values["pond_length"], heel - 0.1 * H);
    check(values, surface(left));

    Outline outline;
    outline.parts.push_back({"starter_dam",
                             starter_fill(values),
                             {{heel, 0.0},
                              {stages[0].toe, 0.0},
                              {stages[0].downstream_edge, starter},
                              {stages[0].upstream_edge, starter}}});
    for (std::size_t k = 1; k < stages.size(); ++k) {
        const Stage &before = stages[k - 1], &after = stages[k];
        outline.parts.push_back({"raise_" + std::to_string(k),
                                 "embankment",
                                 {{before.toe, 0.0},
                                  {after.toe, 0.0},
                                  {after.downstream_edge, after.height},
                                  {after.upstream_edge, after.height},
                                  {before.upstream_edge, before.height},
                                  {before.downstream_edge, before.height}}});
    }
    outline.parts.push_back(
        {"tailings", "tailings", {{left, 0.0}, {heel, 0.0}, contact, {left, surface(left)}}});
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
    const double axis = last.upstream_edge + 0.5 * width;
    outline.phreatic = drained_line({edge, surface(edge)}, values.is_on("drain") ? axis : 0.0, left,
                                    values["foundation_extent"], outline.ground);
    return outline;
}

}  // namespace breach::templates
