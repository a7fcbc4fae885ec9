#include "mpm_solver/share.hpp"
#include "mpm_solver/step.hpp"

namespace breach::mpm {

void particle_to_grid(Body& body, double dt) { run(body, &Loops::scatter, Writes::nodes, dt); }

}  // namespace breach::mpm
