#include <algorithm>
#include <fstream>
#include <map>
#include <numeric>
#include <sstream>

#include "fem_solver/mesh/mesh.hpp"

namespace breach::fem {
namespace {

constexpr int gmsh_triangle = 2;
constexpr int gmsh_quad = 3;
constexpr int surface_dimension = 2;

/// What a .msh file says about its surfaces, before it is matched with the section.
struct RawMesh {
    std::map<int, std::string> surface_names;                ///< by physical tag
    std::map<long, Vec2> nodes;                              ///< by node tag
    std::map<int, int> physical_of_surface;                  ///< 4.1: by entity tag
    std::vector<std::pair<int, std::array<long, 4>>> quads;  ///< physical tag, node tags
    long triangles = 0;
    long others = 0;
};

class MshReader {
  public:
    explicit MshReader(const std::filesystem::path& file) : file_(file) {
        std::error_code error;  // a device or a pipe never ends
        if (std::filesystem::is_regular_file(file, error)) in_.open(file);
        if (!in_.is_open()) throw fault::IoError(file.string() + ": cannot be opened");
    }

    RawMesh read() {
        std::string word;
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

    void add_element(int type, int physical) {
        if (type != gmsh_quad) {
            mesh_.triangles += type == gmsh_triangle ? 1 : 0;
            return;
        }
        std::array<long, 4> tags;
        for (long& tag : tags) tag = next<long>();
        mesh_.quads.emplace_back(physical, tags);
    }

    void read_elements_2() {
        const long count = next<long>();
        for (long i = 0; i < count && in_; ++i) {
            next<long>();
            const int type = next<int>();
            const long tags = next<int>();
            const int physical = tags > 0 ? next<int>() : 0;
            skip(tags - 1);
            add_element(type, physical);
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
                next<long>();
                add_element(type, physical);
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

/// Region index of each physical tag; faults for names that are no region and regions without
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
    const Vec2 d1 = x.col(2) - x.col(0), d2 = x.col(3) - x.col(1);
    return d1.x() * d2.y() - d1.y() * d2.x();
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
    for (const auto& [tag, nodes] : raw.quads) {
        const bool known = region_of_tag.contains(tag) || raw.surface_names.contains(tag);
        if (known) continue;
        faults.push_back({"$Elements", "quads outside every named physical surface",
                          "give each surface one physical name"});
        break;
    }
    if (!faults.empty()) throw fault::BadInput(file.string(), std::move(faults));
    std::ranges::stable_sort(raw.quads, {},
                             [&](const auto& q) { return region_of_tag.at(q.first); });
    Mesh mesh;
    std::map<long, std::int32_t> number;
    for (const auto& [tag, tags] : raw.quads) {
        Quad quad;
        for (std::size_t k = 0; k < 4; ++k) {
            const auto node = raw.nodes.find(tags[k]);
            if (node == raw.nodes.end()) {
                reader.refuse("$Elements", "node " + std::to_string(tags[k]) + " does not exist");
            }
            const auto [place, is_new] =
                number.emplace(tags[k], static_cast<std::int32_t>(mesh.nodes.size()));
            if (is_new) mesh.nodes.push_back(node->second);
            quad[k] = place->second;
        }
        mesh.quads.push_back(quad);
        mesh.region_of_element.push_back(region_of_tag.at(tag));
        if (twice_area(corners_of(mesh, mesh.quads.size() - 1)) < 0.0) {
            std::swap(mesh.quads.back()[1], mesh.quads.back()[3]);
        }
    }
    return mesh;
}

}  // namespace breach::fem
