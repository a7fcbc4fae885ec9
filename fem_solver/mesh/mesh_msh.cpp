// Reads a user's .msh file (/fem/msh_file) and the one that mesh_gmsh.cpp lets gmsh write. A user's
// file can be anything: every count is read with a check of the stream, and faults of elements name
// their number in that file.
#include <algorithm>
#include <fstream>
#include <map>
#include <numeric>
#include <optional>
#include <sstream>

#include "core/geometry/polyline.hpp"
#include "fem_solver/mesh/mesh.hpp"

namespace breach::fem {
namespace {

constexpr int gmsh_triangle = 2;
constexpr int gmsh_quad = 3;
constexpr int surface_dimension = 2;
constexpr std::size_t most_told = 10;  ///< reported faults of elements

/// Contents of a .msh file, before it is matched with the section.
struct RawMesh {
    std::map<int, std::string> surface_names;  ///< by physical tag
    std::map<long, Vec2> nodes;                ///< by node tag
    std::map<int, int> physical_of_surface;    ///< 4.1: by entity tag
    struct QuadOfFile {
        int physical;  ///< tag of its surface
        long tag;
        std::array<long, 4> nodes;
    };
    std::vector<QuadOfFile> quads;
    long triangles = 0;
    long others = 0;
};

class MshReader {
  public:
    explicit MshReader(const std::filesystem::path& file) : file_(file) {
        std::error_code error;  // excludes devices and pipes
        if (std::filesystem::is_regular_file(file, error)) in_.open(file);
        if (!in_.is_open()) throw fault::IoError(file.string() + ": cannot be opened");
    }

    RawMesh read() {
        std::string word;
        // Unknown sections are skipped word by word. Nodes are looked up after all sections are
        // read.
        while (in_ >> word) {
            if (word == "$MeshFormat")
                read_format();
            else if (word == "$PhysicalNames")
                read_names();
            else if (word == "$Entities")
                read_entities();
            else if (word == "$Nodes")
                version_4_ ? read_nodes_4() : read_nodes_2();
            else if (word == "$Elements")
                version_4_ ? read_elements_4() : read_elements_2();
            else
                continue;
            if (!in_)
                refuse(word, "this section ends too early or is not a number where one belongs");
        }
        if (mesh_.quads.empty() && mesh_.triangles == 0) refuse("$Elements", "no surface elements");
        return std::move(mesh_);
    }

    [[noreturn]] void refuse(const std::string& where, const std::string& cause) const {
        throw fault::BadInput(file_.string(),
                              {{where, cause, "save the mesh as gmsh text format 4.1 or 2.2"}});
    }

  private:
    template <typename T>
    T next() {
        T value{};
        in_ >> value;
        return value;
    }
    void skip(long words) {
        std::string word;
        for (long i = 0; i < words && in_; ++i) in_ >> word;
    }

    void read_format() {
        const auto version = next<std::string>();
        const int binary = next<int>();
        if (version != "2.2" && version != "4.1") refuse("$MeshFormat", "format " + version);
        if (binary != 0) refuse("$MeshFormat", "a binary file");
        version_4_ = version == "4.1";
    }

    void read_names() {
        const long count = next<long>();
        for (long i = 0; i < count && in_; ++i) {
            const int dimension = next<int>();
            const int tag = next<int>();
            std::string name;
            std::getline(in_, name);
            const auto first = name.find('"');
            const auto last = name.rfind('"');
            if (first == std::string::npos || last <= first)
                refuse("$PhysicalNames", "a name without quotes");
            if (dimension == surface_dimension) {
                mesh_.surface_names[tag] = name.substr(first + 1, last - first - 1);
            }
        }
    }

    void read_entities() {
        const long points = next<long>(), curves = next<long>(), surfaces = next<long>();
        next<long>();  // volumes
        for (long i = 0; i < points && in_; ++i) {
            skip(4);
            skip(next<long>());
        }
        for (long i = 0; i < curves && in_; ++i) {
            skip(7);
            skip(next<long>());
            skip(next<long>());
        }
        for (long i = 0; i < surfaces && in_; ++i) {
            const int tag = next<int>();
            skip(6);
            const long physicals = next<long>();
            for (long k = 0; k < physicals && in_; ++k) {
                const int physical = next<int>();
                // A surface with several names counts for the first.
                if (k == 0) mesh_.physical_of_surface[tag] = physical;
            }
            skip(next<long>());
        }
    }

    Vec2 read_point() {
        const auto x = next<double>(), y = next<double>();
        next<double>();
        return {x, y};
    }

    void read_nodes_2() {
        const long count = next<long>();
        for (long i = 0; i < count && in_; ++i) {
            const long tag = next<long>();
            mesh_.nodes[tag] = read_point();
        }
    }

    void read_nodes_4() {
        const long blocks = next<long>();
        skip(3);
        for (long b = 0; b < blocks && in_; ++b) {
            skip(2);
            if (next<int>() != 0) refuse("$Nodes", "parametric nodes");
            const long count = next<long>();
            std::vector<long> tags;
            for (long i = 0; i < count && in_; ++i) tags.push_back(next<long>());
            for (const long tag : tags) mesh_.nodes[tag] = read_point();
        }
    }

    void add_element(int type, int physical, long tag) {
        if (type != gmsh_quad) {
            mesh_.triangles += type == gmsh_triangle ? 1 : 0;
            return;
        }
        mesh_.quads.push_back({physical, tag, {}});
        for (long& node : mesh_.quads.back().nodes) node = next<long>();
    }

    void read_elements_2() {
        const long count = next<long>();
        for (long i = 0; i < count && in_; ++i) {
            const long tag = next<long>();
            const int type = next<int>();
            // long: the least int less one would overflow (found by fuzzing).
            const long tags = next<int>();
            const int physical = tags > 0 ? next<int>() : 0;
            skip(tags - 1);
            add_element(type, physical, tag);
            std::string rest;
            std::getline(in_, rest);
        }
    }

    void read_elements_4() {
        const long blocks = next<long>();
        skip(3);
        for (long b = 0; b < blocks && in_; ++b) {
            const int dimension = next<int>();
            const int surface = next<int>();
            const int type = next<int>();
            const long count = next<long>();
            const int physical =
                dimension == surface_dimension ? mesh_.physical_of_surface[surface] : 0;
            for (long i = 0; i < count && in_; ++i) {
                const long tag = next<long>();
                add_element(type, physical, tag);
                std::string rest;
                std::getline(in_, rest);
            }
        }
    }

    std::filesystem::path file_;
    std::ifstream in_;
    RawMesh mesh_;
    bool version_4_ = false;
};

/// Region index of each physical tag. Faults for names that are no regions, and regions without
/// elements.
std::map<int, std::int32_t> match_regions(const RawMesh& raw, const scene::Section& section,
                                          std::vector<fault::Fault>& faults) {
    std::map<int, std::int32_t> region_of_tag;
    std::vector<bool> found(section.regions.size(), false);
    for (const auto& [tag, name] : raw.surface_names) {
        for (std::size_t i = 0; i < section.regions.size(); ++i) {
            if (section.regions[i].name != name) continue;
            region_of_tag[tag] = static_cast<std::int32_t>(i);
            found[i] = true;
        }
        if (!region_of_tag.contains(tag)) {
            faults.push_back({"$PhysicalNames", "surface '" + name + "' is no region of the scene",
                              "name physical surfaces after regions"});
        }
    }
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (found[i]) continue;
        faults.push_back({"/section/regions/" + std::to_string(i),
                          "region '" + section.regions[i].name + "' has no physical surface",
                          "add a physical surface of that name to the mesh"});
    }
    return region_of_tag;
}

double twice_area(const Corners& x) {
    return geometry::cross(x.col(2) - x.col(0), x.col(3) - x.col(1));
}

/// Fault of the last quad; none: it is valid.
std::optional<fault::Fault> fault_of_last_quad(const Mesh& mesh,
                                               const RawMesh::QuadOfFile& in_file) {
    const std::string name = "element " + std::to_string(in_file.tag);
    for (std::size_t k = 0; k < 4; ++k) {
        if (std::count(in_file.nodes.begin(), in_file.nodes.end(), in_file.nodes[k]) == 1) continue;
        return fault::Fault{"$Elements",
                            name + " names node " + std::to_string(in_file.nodes[k]) + " twice",
                            "give it four nodes of its own: a triangle is no quad"};
    }
    const Corners x = corners_of(mesh, mesh.quads.size() - 1);
    if (geometry::corner_jacobians(x).minCoeff() > 0.0) return std::nullopt;
    const Vec2 where = x.rowwise().mean();
    return fault::Fault{"$Elements",
                        name + " near (" + std::to_string(where.x()) + ", " +
                            std::to_string(where.y()) + ") is folded: not convex, or crossed",
                        "name its corners in their order around it, or mesh that place anew"};
}

}  // namespace

Mesh read_msh(const std::filesystem::path& file, const scene::Section& section) {
    MshReader reader(file);
    RawMesh raw = reader.read();
    std::vector<fault::Fault> faults;
    if (raw.triangles > 0) {
        faults.push_back({"$Elements", std::to_string(raw.triangles) + " triangles",
                          "recombine the mesh to quads only"});
    }
    const auto region_of_tag = match_regions(raw, section, faults);
    for (const auto& each : raw.quads) {
        const bool known =
            region_of_tag.contains(each.physical) || raw.surface_names.contains(each.physical);
        if (known) continue;
        faults.push_back({"$Elements", "quads outside every named physical surface",
                          "give each surface one physical name"});
        break;
    }
    if (!faults.empty()) throw fault::BadInput(file.string(), std::move(faults));
    // Zones need the elements of a region in one run; their order within it stays the file's.
    std::ranges::stable_sort(raw.quads, {},
                             [&](const auto& q) { return region_of_tag.at(q.physical); });
    Mesh mesh;
    std::map<long, std::int32_t> number;
    for (const auto& each : raw.quads) {
        Quad quad;
        for (std::size_t k = 0; k < 4; ++k) {
            const long tag = each.nodes[k];
            const auto node = raw.nodes.find(tag);
            if (node == raw.nodes.end()) {
                reader.refuse("$Elements", "node " + std::to_string(tag) + " does not exist");
            }
            const auto [place, is_new] =
                number.emplace(tag, static_cast<std::int32_t>(mesh.nodes.size()));
            // Numbered at first use: nodes of points and curves without an element drop out.
            if (is_new) mesh.nodes.push_back(node->second);
            quad[k] = place->second;
        }
        mesh.quads.push_back(quad);
        mesh.region_of_element.push_back(region_of_tag.at(each.physical));
        // Clockwise quads are common in files and harmless.
        if (twice_area(corners_of(mesh, mesh.quads.size() - 1)) < 0.0) {
            std::swap(mesh.quads.back()[1], mesh.quads.back()[3]);
        }
        const auto fault = fault_of_last_quad(mesh, each);
        if (fault && faults.size() < most_told) faults.push_back(*fault);
    }
    if (!faults.empty()) throw fault::BadInput(file.string(), std::move(faults));
    return mesh;
}

}  // namespace breach::fem
