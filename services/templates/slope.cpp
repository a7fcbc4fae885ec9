// A plain slope with its toe at (0, 0). The model ends at the level ground behind the crest; the
// water stands there and falls to the toe.
#include "services/templates/outline.hpp"

namespace breach::templates {

Outline slope(const Values& values) {
    const double H = values["height"], depth = values["water_depth"];
    Refusal refusal(values);
    refusal.unless(depth <= H, "water_depth", "the slope is only " + metres(H) + " high",
                   "give at most height");
    refusal.speak();
    const double crest = -values["face_slope"] * H;
    const double left = crest - values["crest_extent"];
    Outline outline;
    outline.parts = {{"slope", "soil", {{left, 0.0}, {0.0, 0.0}, {crest, H}, {left, H}}}};
    outline.ground = {{left, H}, {crest, H}, {0.0, 0.0}};
    outline.wet = "slope";
    outline.crest = {crest, H};
    // As of a heap: there is no upstream edge (heap.cpp).
    outline.crest_from = left + 0.02 * (crest - left);
    outline.left = left;
    add_water(values, {left, H - depth}, 0.0, outline);
    return outline;
}

}  // namespace breach::templates
