#include <algorithm>
#include <fstream>
#include <set>

#include "core/check/findings.hpp"
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
constexpr const char* mesh_remedy = "save the mesh as gmsh text format 4.1 or 2.2";

/// Names of the physical surfaces that follow $PhysicalNames.
std::set<std::string> surface_names(std::istream& in) {
    std::set<std::string> names;
    long count = 0;
    in >> count;
    std::string line;
    std::getline(in, line);
    for (long i = 0; i < count && std::getline(in, line); ++i) {
        const auto first = line.find('"'), last = line.rfind('"');
        if (line.starts_with("2 ") && first != std::string::npos && last > first)
            names.insert(line.substr(first + 1, last - first - 1));
    }
    return names;
}

/// The head of the mesh file: its format, and a surface for every region. Nodes and elements are
/// read when it is used.
void check_mesh_file(const scene::Scene& scene, const std::filesystem::path& file,
                     Findings& findings) {
    std::ifstream in;
    std::error_code error;  // a device or a pipe never ends
    if (std::filesystem::is_regular_file(file, error)) in.open(file);
    if (!in.is_open()) {
        const bool exists = std::filesystem::exists(file, error);
        refuse(findings, mesh_pointer,
               (exists ? "cannot be read: " : "does not exist: ") + file.string(),
               "give a path relative to the scene file, or the absolute path on the machine that "
               "computes");
        return;
    }
    std::string word, version;
    in >> word >> version;
    int binary = 0;
    in >> binary;
    if (word != "$MeshFormat" || (version != "2.2" && version != "4.1") || binary != 0) {
        refuse(findings, mesh_pointer,
               word != "$MeshFormat" ? "does not begin with $MeshFormat: " + file.string()
               : binary != 0         ? "is a binary mesh"
                                     : "is a mesh of format " + version,
               mesh_remedy);
        return;
    }
    while (in >> word && word != "$PhysicalNames" && word != "$Nodes") {
    }
    const auto names = word == "$PhysicalNames" ? surface_names(in) : std::set<std::string>{};
    for (std::size_t r = 0; r < scene.section.regions.size(); ++r) {
        const std::string& name = scene.section.regions[r].name;
        if (names.contains(name)) continue;
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
