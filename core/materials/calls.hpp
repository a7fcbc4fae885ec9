// The integration of a law in sub-steps with error control: open (reversal, elastic part), walk,
// close. Each law implements these functions in its own namespace:
//     open_call(law, old, d, task), load(task, lane, walk), after_unloading(law, lane, walk,
//     task), ends(lane, walk, lost, options, task), store(law, lane, walk, task),
//     finish_call(law, old, d, task), may_be_tried(d, options)
// and its `Calls` names the types. This file integrates one point; side_by_side.hpp several.
#pragma once

namespace breach::materials {

/// What a lane does after `begin`: continue its sub-step, begin again, or end.
enum class Next { walk, again, leave };

/// The new state after the strain increment d; may_be_tried(d, options) must be true.
template <class Calls>
typename Calls::Update call_alone(const typename Calls::Ready& law,
                                  const typename Calls::State& old, const typename Calls::Strain& d,
                                  const typename Calls::Options& options) {
    typename Calls::Update update;
    typename Calls::Task task{};
    task.update = &update;
    const auto walk_through = [&] {
        typename Calls::template Walk<double> walk(law, options);
        load(task, 0, walk);
        for (;;) {
            if (walk.begin(true)) {
                const Next next = after_unloading(law, 0, walk, task);
                if (next == Next::leave) return;
                if (next == Next::again) {
                    if (ends(0, walk, false, options, task)) return store(law, 0, walk, task);
                    continue;
                }
            }
            const bool lost = walk.advance(true);
            if (ends(0, walk, lost, options, task)) return store(law, 0, walk, task);
        }
    };
    if (open_call(law, old, d, task)) walk_through();
    finish_call(law, old, d, task);
    return update;
}

}  // namespace breach::materials
