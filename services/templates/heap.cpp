// Half of a heap: the axis is the model's left end, the toe is at (0, 0). Water stands highest at
// the axis, by symmetry, and leaves at the toe.
#include <algorithm>

#include "services/templates/outline.hpp"

namespace breach::templates {

Outline heap(const Values& values) {
    const double H = values["height"], water = values["water_height"];
    Refusal refusal(values);
    refusal.unless(water <= H, "water_height", "the heap is only " + metres(H) + " high",
                   "give at most height");
    refusal.speak();
    const int lifts = values.whole("lifts");
    const double step = H / lifts;
    Polygon ring{{0.0, 0.0}};
    double x = 0.0;
    for (int k = 1; k <= lifts; ++k) {
        x -= values["lift_slope"] * step;
        // The last level is the height itself, not a sum that misses it by rounding.
        const double level = k == lifts ? H : k * step;
        ring.push_back({x, level});
        if (k == lifts || values["bench_width"] == 0.0) continue;
        x -= values["bench_width"];
        ring.push_back({x, level});
    }
    const double left = x - values["top_width"];
    Outline outline;
    outline.crest = ring.back();
    // A heap has no upstream edge: a place just inside the model's end stands for it.
    outline.crest_from = left + 0.02 * values["top_width"];
    outline.left = left;
    ring.push_back({left, H});
    outline.ground.assign(ring.rbegin(), ring.rend());
    ring.push_back({left, 0.0});
    outline.parts = {{"heap", "soil", ring}};
    outline.wet = "heap";
    add_water(values, {left, water}, 0.0, outline);
    return outline;
}

}  // namespace breach::templates
