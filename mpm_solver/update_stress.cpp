#include <algorithm>

#include "mpm_solver/share.hpp"
#include "mpm_solver/step.hpp"

namespace breach::mpm {

namespace {

/// Totals of one kind in the cells become averages over their volume.
void average(Body& body, double CellSum::*number) {
    for (std::vector<CellSum>& sums : body.averages) {
        if (sums.empty()) continue;
        for (const std::int32_t cell : body.grid.active) {
            if (sums[cell].V > 0.0) sums[cell].*number /= sums[cell].V;
        }
    }
}

void find_lightest(Body& body) {
    for (std::size_t z = 0; z < body.zones.size(); ++z) {
        double largest = 0.0;
        for (const std::size_t strip : body.strips.all()) {
            largest =
                std::max(largest, body.sums[strip * body.zones.size() + z].largest_specific_volume);
        }
        body.zones[z].largest_specific_volume = largest;
    }
}

}  // namespace

void update_stress(Body& body, double dt) {
    average(body, &CellSum::trD);
    body.tally.viscous += run(body, &Loops::dissipate, Writes::own_points, dt).viscous;
    const Totals sums = run(body, &Loops::stress, Writes::nodes, dt);
    body.tally.plastic += sums.plastic;
    body.tally.pushed_in += sums.pushed_in;
    average(body, &CellSum::sigma_m);
    run(body, &Loops::settle, Writes::own_points, dt);
    find_lightest(body);
}

}  // namespace breach::mpm
