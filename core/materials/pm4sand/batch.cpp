// Many points of one zone at once.
#include <cassert>

#include "core/materials/pm4sand/adaptive.hpp"
#include "core/materials/side_by_side.hpp"

namespace breach::materials::pm4sand {

void integrate(const Ready& law, std::span<const State> old, std::span<const Voigt> d_epsilon,
               const Options& options, std::span<Update> updates, Width width) {
    assert(old.size() == d_epsilon.size() && old.size() == updates.size());
    if (options.scheme == Scheme::reference) {
        for (std::size_t i = 0; i < old.size(); ++i) {
            updates[i] = integrate(law, old[i], d_epsilon[i], options);
        }
        return;
    }
    call_side_by_side<Calls>(law, old, d_epsilon, options, updates, width);
}

}  // namespace breach::materials::pm4sand
