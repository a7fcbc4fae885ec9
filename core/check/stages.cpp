#include "core/check/findings.hpp"
#include "core/check/mesh_file.hpp"
#include "core/check/section.hpp"

namespace breach::check {

namespace {

/// Of a law of the regions whose points remember more than State; null: there is none.
const char* name_of_law_with_memory(const scene::Scene& scene) {
    for (const scene::Region& region : scene.section.regions) {
        const scene::Material* material = material_of(scene, region);
        if (material != nullptr && materials::remembers(material->law))
            return materials::traits(material->law).name;
    }
    return nullptr;
}

/// Histories per component do not turn with a moving mesh, and an elastic stage would lose them.
void check_memory(const scene::Scene& scene, const std::string& law, Findings& findings) {
    const scene::Fem& fem = *scene.fem;
    if (fem.kinematics == scene::Kinematics::updated_lagrangian)
        refuse(findings, "/fem/kinematics",
               "is updated_lagrangian, where " + law + " cannot follow", "use small_strain");
    bool began = false;
    for (std::size_t i = 0; i < fem.stages.size(); ++i) {
        const bool elastic = fem.stages[i].laws == scene::StageLaws::elastic;
        if (began && elastic)
            refuse(findings, "/fem/stages/" + std::to_string(i) + "/laws",
                   "is elastic after " + law + " has begun",
                   "put elastic stages first: the soil's memory would be lost");
        began = began || !elastic;
    }
}

constexpr const char* mesh_pointer = "/fem/msh_file";
/// The head of the mesh file: its format, and a surface for every region. Nodes and elements are
/// read when it is used.
void check_mesh_file(const scene::Scene& scene, const std::filesystem::path& file,
                     Findings& findings) {
    MeshHead head;
    try {
        head = read_mesh_head(file);
    } catch (const fault::IoError& error) {
        refuse(findings, mesh_pointer, error.what(),
               "give a path relative to the scene file, or the absolute path on the machine that "
               "computes");
        return;
    } catch (const fault::BadInput& error) {
        for (const fault::Fault& each : error.faults())
            refuse(findings, mesh_pointer, each.cause, each.remedy);
        return;
    }
    for (std::size_t r = 0; r < scene.section.regions.size(); ++r) {
        const std::string& name = scene.section.regions[r].name;
        if (head.surfaces.contains(name)) continue;
        refuse(findings, region_pointer(r),
               "\"" + name + "\" has no physical surface in " + file.string(),
               "add a physical surface of that name to the mesh");
    }
}

}  // namespace

void check_stages(const scene::Scene& scene, Findings& findings) {
    if (const char* law = name_of_law_with_memory(scene)) check_memory(scene, law, findings);
    if (scene.fem->mesh.msh_file) check_mesh_file(scene, *scene.fem->mesh.msh_file, findings);
}

}  // namespace breach::check
