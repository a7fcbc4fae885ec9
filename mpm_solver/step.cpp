#include "mpm_solver/step.hpp"

namespace breach::mpm {

namespace {

using scene::AntiLocking;
using scene::UpdateOrder;

template <class Kernel, AntiLocking anti_locking>
Verbs verbs_in(UpdateOrder order) {
    const bool musl = order == UpdateOrder::musl;
    return {.particle_to_grid = particle_to_grid<Kernel>,
            .grid_to_particle = musl ? grid_to_particle<Kernel, UpdateOrder::musl, anti_locking>
                                     : grid_to_particle<Kernel, UpdateOrder::usl, anti_locking>,
            .map_again = musl ? map_again<Kernel, anti_locking> : nullptr,
            .update_stress = update_stress<anti_locking>};
}

template <class Kernel>
Verbs verbs_with(AntiLocking anti_locking, UpdateOrder order) {
    return anti_locking == AntiLocking::on ? verbs_in<Kernel, AntiLocking::on>(order)
                                           : verbs_in<Kernel, AntiLocking::off>(order);
}

}  // namespace

Verbs choose_verbs(const scene::Mpm& mpm) {
    return mpm.kernel == scene::Kernel::gimp
               ? verbs_with<GimpKernel>(mpm.anti_locking, mpm.order)
               : verbs_with<LinearKernel>(mpm.anti_locking, mpm.order);
}

void step(Body& body, double dt) {
    clear(body.grid);
    body.verbs.particle_to_grid(body);
    update_momentum(body, dt);
    body.verbs.grid_to_particle(body, dt);
    if (body.verbs.map_again) body.verbs.map_again(body, dt);
    body.verbs.update_stress(body, dt);
}

}  // namespace breach::mpm
