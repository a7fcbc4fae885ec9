// Writes one mesh and one particle file for external readers.
#include "tests/unit/exchange/samples.hpp"

int main(int argc, char** argv) {
    using namespace breach::exchange;
    if (argc != 2) return 2;
    const std::filesystem::path folder = argv[1];
    write_mesh_snapshot(folder / "mesh.vtkhdf", samples::mesh(5), samples::provenance());
    write_particle_state(folder / "particles.vtkhdf", samples::particles(9), samples::provenance(),
                         {{"total", "mass", "kg", 1.0, 1.0, 0.0}});
    return 0;
}
