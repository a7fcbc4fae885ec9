// Writes the Mochikoshi-shaped snapshot, for inspection:
//     write_mochikoshi_shaped SCENE.json MESH.json OUTPUT.vtkhdf
#include <cstdio>

#include "tests/verification/transfer/mochikoshi_shaped.hpp"

int main(int argc, char** argv) {
    if (argc != 4) {
        std::fprintf(stderr, "usage: write_mochikoshi_shaped SCENE.json MESH.json OUTPUT.vtkhdf\n");
        return 2;
    }
    const auto scene = breach::scene::read_scene(argv[1]);
    breach::exchange::Provenance provenance;
    provenance.phase = "write_mochikoshi_shaped";
    provenance.version = "invented fields";
    breach::exchange::write_mesh_snapshot(
        argv[3], breach::transfer::mochikoshi::snapshot(scene, argv[2]), provenance);
    return 0;
}
