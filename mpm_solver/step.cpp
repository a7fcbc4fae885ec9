#include "mpm_solver/step.hpp"

namespace breach::mpm {

namespace {

using scene::AntiLocking;
using scene::UpdateOrder;

template <class Kernel, AntiLocking anti_locking>
Verbs verbs_in(const scene::Mpm& mpm) {
    const bool musl = mpm.order == UpdateOrder::musl;
    const bool corrects = mpm.overlap_correction.rate > 0.0;
    return {.particle_to_grid = particle_to_grid<Kernel>,
            .grid_to_particle = musl ? grid_to_particle<Kernel, UpdateOrder::musl, anti_locking>
                                     : grid_to_particle<Kernel, UpdateOrder::usl, anti_locking>,
            .map_again = musl ? map_again<Kernel, anti_locking> : nullptr,
            .update_stress = corrects ? update_stress<anti_locking, Overlap::corrected>
                                      : update_stress<anti_locking, Overlap::left_alone>};
}

template <class Kernel>
Verbs verbs_with(const scene::Mpm& mpm) {
    return mpm.anti_locking == AntiLocking::on ? verbs_in<Kernel, AntiLocking::on>(mpm)
                                               : verbs_in<Kernel, AntiLocking::off>(mpm);
}

}  // namespace

Verbs choose_verbs(const scene::Mpm& mpm) {
    switch (mpm.kernel) {
        case scene::Kernel::gimp:
            return verbs_with<GimpKernel>(mpm);
        case scene::Kernel::b_spline:
            return verbs_with<BSplineKernel>(mpm);
        default:
            return verbs_with<LinearKernel>(mpm);
    }
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
