#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iomanip>
#include <map>
#include <sstream>

#include "core/exchange/publish.hpp"
#include "fem_solver/mesh.hpp"

extern char** environ;  // NOLINT: POSIX asks for this declaration

namespace breach::fem {
namespace {

/// The section as gmsh wants it: points, lines between neighbouring points, loops of signed lines.
struct Outline {
    struct Line {
        int from, to;                ///< points
        double length;               ///< [m]
        int divisions = 0;           ///< 0: not yet decided
        std::size_t divided_by = 0;  ///< region that decided
    };
    std::vector<Vec2> points;
    std::vector<Line> lines;
    std::vector<std::vector<int>> loops;  ///< per region: line + 1, negative when run backwards
};

int point_at(Outline& outline, const Vec2& x, double tolerance) {
    for (std::size_t i = 0; i < outline.points.size(); ++i) {
        if ((outline.points[i] - x).norm() <= tolerance) return static_cast<int>(i);
    }
    outline.points.push_back(x);
    return static_cast<int>(outline.points.size()) - 1;
}

/// Points on the segment a-b, from a to b, ends included.
std::vector<int> points_between(const Outline& outline, int a, int b, double tolerance) {
    const Vec2 A = outline.points[a], B = outline.points[b];
    std::vector<int> found;
    for (std::size_t i = 0; i < outline.points.size(); ++i) {
        if (scene::distance_to_segment(outline.points[i], A, B) <= tolerance) {
            found.push_back(static_cast<int>(i));
        }
    }
    std::ranges::sort(found, {}, [&](int i) { return (outline.points[i] - A).dot(B - A); });
    return found;
}

int line_between(Outline& outline, int from, int to) {
    for (std::size_t i = 0; i < outline.lines.size(); ++i) {
        const Outline::Line& line = outline.lines[i];
        if (line.from == from && line.to == to) return static_cast<int>(i) + 1;
        if (line.from == to && line.to == from) return -(static_cast<int>(i) + 1);
    }
    const double length = (outline.points[to] - outline.points[from]).norm();
    outline.lines.push_back({from, to, length});
    return static_cast<int>(outline.lines.size());
}

Outline outline_of(const scene::Section& section) {
    double size = 0.0;
    for (const auto& region : section.regions) {
        const scene::Box box = scene::bounding_box(region.polygon);
        size = std::max(size, (box.high - box.low).norm());
    }
    const double tolerance = 1e-9 * size;
    Outline outline;
    for (const auto& region : section.regions) {
        for (const Vec2& vertex : region.polygon) point_at(outline, vertex, tolerance);
    }
    for (const auto& region : section.regions) {
        std::vector<int> loop;
        for (std::size_t i = 0; i < region.polygon.size(); ++i) {
            const int a = point_at(outline, region.polygon[i], tolerance);
            const int b =
                point_at(outline, region.polygon[(i + 1) % region.polygon.size()], tolerance);
            const std::vector<int> chain = points_between(outline, a, b, tolerance);
            for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
                loop.push_back(line_between(outline, chain[k], chain[k + 1]));
            }
        }
        outline.loops.push_back(std::move(loop));
    }
    return outline;
}

/// Lines of a loop from the point at corner `from` to that at `to`.
std::vector<std::size_t> side_lines(const Outline& outline, const std::vector<int>& loop,
                                    const Vec2& from, const Vec2& to) {
    const auto start = [&](int signed_line) {
        const Outline::Line& line = outline.lines[std::abs(signed_line) - 1];
        return outline.points[signed_line > 0 ? line.from : line.to];
    };
    std::size_t at = 0;
    while ((start(loop[at]) - from).norm() > 1e-9 * (to - from).norm()) at = (at + 1) % loop.size();
    std::vector<std::size_t> lines;
    do {
        lines.push_back(static_cast<std::size_t>(std::abs(loop[at]) - 1));
        at = (at + 1) % loop.size();
    } while ((start(loop[at]) - to).norm() > 1e-9 * (to - from).norm());
    return lines;
}

void divide_block(Outline& outline, const scene::Section& section, std::size_t r,
                  std::vector<fault::Fault>& faults) {
    const scene::Region& region = section.regions[r];
    const std::string pointer = "/section/regions/" + std::to_string(r) + "/mesh/divisions";
    for (std::size_t k = 0; k < 4; ++k) {
        const auto lines = side_lines(outline, outline.loops[r], region.polygon[region.corners[k]],
                                      region.polygon[region.corners[(k + 1) % 4]]);
        std::vector<double> lengths;
        for (const std::size_t i : lines) lengths.push_back(outline.lines[i].length);
        const auto shares = share_divisions(lengths, region.divisions[k % 2]);
        if (shares.empty()) {
            faults.push_back({pointer,
                              "fewer divisions than segments on a side of '" + region.name + "'",
                              "give at least one division per segment"});
            return;
        }
        for (std::size_t i = 0; i < lines.size(); ++i) {
            Outline::Line& line = outline.lines[lines[i]];
            if (line.divisions != 0 && line.divisions != shares[i]) {
                faults.push_back({pointer,
                                  "regions '" + section.regions[line.divided_by].name + "' and '" +
                                      region.name + "' divide their shared side into " +
                                      std::to_string(line.divisions) + " and " +
                                      std::to_string(shares[i]),
                                  "give both the same number"});
            }
            line.divisions = shares[i];
            line.divided_by = r;
        }
    }
}

/// Even divisions on the free lines of an unstructured region; one more on a line of its own where
/// its blocks leave an odd sum, because only an even border can be filled with quads.
void divide_unstructured(Outline& outline, const scene::Section& section,
                         std::vector<fault::Fault>& faults) {
    std::vector<int> uses(outline.lines.size(), 0);
    for (const auto& loop : outline.loops) {
        for (const int line : loop) ++uses[std::abs(line) - 1];
    }
    for (std::size_t r = 0; r < section.regions.size(); ++r) {
        const scene::Region& region = section.regions[r];
        if (region.mesh != scene::RegionMesh::unstructured) continue;
        int sum = 0;
        Outline::Line* own = nullptr;
        for (const int signed_line : outline.loops[r]) {
            Outline::Line& line = outline.lines[std::abs(signed_line) - 1];
            if (line.divisions == 0) {
                const double wanted = line.length / (2.0 * region.element_size);
                line.divisions = 2 * std::max(1, static_cast<int>(std::lround(wanted)));
                if (uses[std::abs(signed_line) - 1] == 1) own = &line;
            }
            sum += line.divisions;
        }
        if (sum % 2 == 0) continue;
        if (own != nullptr) {
            ++own->divisions;
        } else {
            faults.push_back({"/section/regions/" + std::to_string(r) + "/mesh",
                              "the border of '" + region.name +
                                  "' has an odd number of divisions (" + std::to_string(sum) +
                                  "): quads cannot fill it",
                              "change the divisions of a neighbouring block by one"});
        }
    }
}

/// gmsh's 2D algorithm and how it recombines triangles to quads.
struct Recipe {
    int algorithm;
    int recombination;
};

/// Tried in this order until no triangle is left: frontal, Delaunay and adaptive triangles, paired
/// by blossom. (Algorithm 8, made for quads, crashes in Debian's gmsh 4.8.4.)
constexpr std::array<Recipe, 3> recipes{{{6, 1}, {5, 1}, {1, 1}}};

std::string geo_text(const Outline& outline, const scene::Section& section, const Recipe& recipe) {
    std::ostringstream geo;
    geo << std::setprecision(17);
    geo << "General.NumThreads = 1;\nMesh.Algorithm = " << recipe.algorithm
        << ";\nMesh.RecombinationAlgorithm = " << recipe.recombination
        << ";\nMesh.RecombineAll = 1;\nMesh.RandomFactor = "
           "1e-9;\n"
           "Mesh.Smoothing = 5;\nMesh.MshFileVersion = 2.2;\nMesh.Binary = 0;\n";
    double largest = 0.0;
    for (const auto& region : section.regions) largest = std::max(largest, region.element_size);
    geo << "Mesh.CharacteristicLengthMax = " << largest << ";\n";
    for (std::size_t i = 0; i < outline.points.size(); ++i) {
        geo << "Point(" << i + 1 << ") = {" << outline.points[i].x() << ", "
            << outline.points[i].y() << ", 0};\n";
    }
    for (std::size_t i = 0; i < outline.lines.size(); ++i) {
        const Outline::Line& line = outline.lines[i];
        geo << "Line(" << i + 1 << ") = {" << line.from + 1 << ", " << line.to + 1 << "};\n"
            << "Transfinite Line {" << i + 1 << "} = " << line.divisions + 1 << ";\n";
    }
    for (std::size_t r = 0; r < section.regions.size(); ++r) {
        const scene::Region& region = section.regions[r];
        geo << "Line Loop(" << r + 1 << ") = {";
        for (std::size_t k = 0; k < outline.loops[r].size(); ++k) {
            geo << (k == 0 ? "" : ", ") << outline.loops[r][k];
        }
        geo << "};\nPlane Surface(" << r + 1 << ") = {" << r + 1 << "};\n";
        if (region.mesh == scene::RegionMesh::block) {
            geo << "Transfinite Surface {" << r + 1 << "} = {";
            for (std::size_t k = 0; k < 4; ++k) {
                const Vec2& corner = region.polygon[region.corners[k]];
                const auto nearest = std::ranges::min_element(
                    outline.points, {}, [&](const Vec2& x) { return (x - corner).norm(); });
                geo << (k == 0 ? "" : ", ") << nearest - outline.points.begin() + 1;
            }
            geo << "};\n";
        }
        geo << "Physical Surface(\"" << region.name << "\") = {" << r + 1 << "};\n";
    }
    return geo.str();
}

/// Runs a program found on the PATH, its output going to `log`; returns its exit code.
int run_program(std::vector<std::string> words, const std::filesystem::path& log) {
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(),
                                     O_WRONLY | O_CREAT | O_TRUNC, 0644);
    posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
    pid_t child = 0;
    const int error =
        posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) {
        throw fault::IoError("gmsh cannot be started (" + std::string(std::strerror(error)) +
                             "): install it (apt-get install gmsh), mesh the regions as blocks, or "
                             "give /fem/msh_file");
    }
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

Mesh mesh_with_gmsh(const scene::Section& section, const std::filesystem::path& folder) {
    Outline outline = outline_of(section);
    std::vector<fault::Fault> faults;
    for (std::size_t r = 0; r < section.regions.size(); ++r) {
        if (section.regions[r].mesh == scene::RegionMesh::block) {
            divide_block(outline, section, r, faults);
        }
    }
    divide_unstructured(outline, section, faults);
    if (!faults.empty()) throw fault::BadInput("scene", std::move(faults));
    const auto geo = folder / "mesh.geo", msh = folder / "mesh.msh", log = folder / "gmsh.log";
    for (std::size_t attempt = 0;; ++attempt) {
        exchange::publish_text(geo, geo_text(outline, section, recipes[attempt]));
        const int code = run_program({"gmsh", "-2", geo.string(), "-o", msh.string()}, log);
        const bool last = attempt + 1 == recipes.size();
        if (code != 0 && last) {
            throw fault::IoError("gmsh failed with exit code " + std::to_string(code) + ": see " +
                                 log.string());
        }
        if (code != 0) continue;
        try {
            return read_msh(msh, section);
        } catch (const fault::BadInput&) {
            if (last) throw;  // another recipe may leave no triangle
        }
    }
}

}  // namespace breach::fem
