#include "mpm_solver/step.hpp"

namespace breach::mpm {

void keep_sorted(Body& body) {
    if (body.tally.strayed <= Strips::largest_stray) return;
    body.strips.sort(body.grid, body.points, body.zones);
    body.tally.strayed = 0.0;
}

void step(Body& body, double dt) {
    keep_sorted(body);
    clear(body.grid);
    particle_to_grid(body, dt);
    if (body.order == Order::usf) update_stress_first(body, dt);
    update_momentum(body, dt);
    grid_to_particle(body, dt);
    if (body.order == Order::musl) map_again(body, dt);
    if (body.order != Order::usf) update_stress(body, dt);
}

}  // namespace breach::mpm
