#include "core/check/mesh_file.hpp"

#include <fstream>

#include "core/fault/fault.hpp"

namespace breach::check {

namespace {

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

}  // namespace

MeshHead read_mesh_head(const std::filesystem::path& file) {
    std::ifstream in;
    std::error_code error;  // excludes devices and pipes
    if (std::filesystem::is_regular_file(file, error)) in.open(file);
    if (!in.is_open()) {
        const bool exists = std::filesystem::exists(file, error);
        throw fault::IoError((exists ? "cannot be read: " : "does not exist: ") + file.string());
    }
    std::string word, version;
    in >> word >> version;
    int binary = 0;
    in >> binary;
    if (word != "$MeshFormat" || (version != "2.2" && version != "4.1") || binary != 0)
        throw fault::BadInput(
            file.string(),
            {{"line 1",
              word != "$MeshFormat" ? "does not begin with $MeshFormat: " + file.string()
              : binary != 0         ? "is a binary mesh"
                                    : "is a mesh of format " + version,
              "save the mesh as gmsh text format 4.1 or 2.2"}});
    while (in >> word && word != "$PhysicalNames" && word != "$Nodes") {
    }
    return {version, word == "$PhysicalNames" ? surface_names(in) : std::set<std::string>{}};
}

}  // namespace breach::check
