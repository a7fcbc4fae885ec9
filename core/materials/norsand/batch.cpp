// Many points of one zone at once.
#include "core/materials/norsand/call.hpp"
#include "core/materials/side_by_side.hpp"

namespace breach::materials::norsand {

void integrate(const Ready& law, std::span<const State> old, std::span<const Voigt> d_epsilon,
               const Options& options, std::span<Update> updates, Width width) {
    call_side_by_side<Calls>(law, old, d_epsilon, options, updates, width);
}

}  // namespace breach::materials::norsand
