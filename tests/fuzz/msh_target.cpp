// gmsh's text formats: a mesh that is read has valid nodes and regions.
#include "fem_solver/mesh/mesh.hpp"
#include "tests/fuzz/fuzz.hpp"

using namespace breach;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const fuzz::File file(fuzz::text_of(data, size));
    scene::Section section;
    section.regions.resize(2);
    section.regions[0].name = "soil";
    section.regions[1].name = "rock";
    fuzz::taken([&] {
        const fem::Mesh mesh = fem::read_msh(file.path(), section);
        fuzz::require(mesh.region_of_element.size() == mesh.quads.size(), "quads have regions");
        for (const fem::Quad& quad : mesh.quads)
            for (const std::int32_t node : quad)
                fuzz::require(node >= 0 && static_cast<std::size_t>(node) < mesh.nodes.size(),
                              "quads name nodes");
        fem::quality_of(mesh);
    });
    return 0;
}
