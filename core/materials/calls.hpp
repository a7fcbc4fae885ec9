// A call of a law that walks through sub-steps with error control: opened (reversal, elastic part),
// walked, closed. How is the law's own affair, in its own namespace:
//     open_call(law, old, d, errand), load(errand, lane, walk), after_unloading(law, lane, walk,
//     errand), ends(lane, walk, lost, options, errand), store(law, lane, walk, errand),
//     finish_call(law, old, d, errand), may_be_tried(d, options)
// and its `Calls` names the types. Here is one point; side_by_side.hpp has several.
#pragma once

namespace breach::materials {

/// One lane's progress after `begin`: leaves, unloads or walks on.
enum class Next { walk, again, leave };

/// The new state after the strain increment d, which may be tried.
template <class Calls>
typename Calls::Update call_alone(const typename Calls::Ready& law,
                                  const typename Calls::State& old, const typename Calls::Strain& d,
                                  const typename Calls::Options& options) {
    typename Calls::Update update;
    typename Calls::Errand errand{};
    errand.update = &update;
    const auto walk_through = [&] {
        typename Calls::template Walk<double> walk(law, options);
        load(errand, 0, walk);
        for (;;) {
            if (walk.begin(true)) {
                const Next next = after_unloading(law, 0, walk, errand);
                if (next == Next::leave) return;
                if (next == Next::again) {
                    if (ends(0, walk, false, options, errand)) return store(law, 0, walk, errand);
                    continue;
                }
            }
            const bool lost = walk.advance(true);
            if (ends(0, walk, lost, options, errand)) return store(law, 0, walk, errand);
        }
    };
    if (open_call(law, old, d, errand)) walk_through();
    finish_call(law, old, d, errand);
    return update;
}

}  // namespace breach::materials
