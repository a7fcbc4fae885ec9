// Meshes with gmsh's command line, through a .geo file in the run's folder. All borders are divided
// here, not by gmsh: neighbours must share nodes, quads need an even border, and blocks keep their
// divisions. Files stay for inspection (mesh.geo, gmsh.log).
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstring>
#include <ctime>
#include <fstream>
#include <iomanip>
#include <map>
#include <sstream>

#include "core/exchange/publish.hpp"
#include "fem_solver/mesh/mesh.hpp"

extern char** environ;  // NOLINT: required by POSIX

namespace breach::fem {
namespace {

/// The section for gmsh: points, lines between neighbouring points, loops of signed lines.
struct Outline {
    struct Line {
        int from, to;                ///< points
        double length;               ///< [m]
        int divisions = 0;           ///< 0: not decided yet
        double growth = 1.0;         ///< of its elements, from `from` to `to`
        std::size_t divided_by = 0;  ///< region that decided the divisions
    };
    std::vector<Vec2> points;
    std::vector<Line> lines;
    std::vector<std::vector<int>> loops;  ///< per piece: line + 1, negative if reversed
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
        if (geometry::distance_to_segment(outline.points[i], A, B) <= tolerance) {
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

Outline outline_of(const std::vector<Piece>& pieces) {
    double size = 0.0;
    for (const Piece& piece : pieces) {
        const geometry::Box box = geometry::bounding_box(piece.region.polygon);
        size = std::max(size, (box.high - box.low).norm());
    }
    const double tolerance = 1e-9 * size;
    Outline outline;
    for (const Piece& piece : pieces) {
        for (const Vec2& vertex : piece.region.polygon) point_at(outline, vertex, tolerance);
    }
    for (const Piece& piece : pieces) {
        const geometry::Polygon& ring = piece.region.polygon;
        std::vector<int> loop;
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const int a = point_at(outline, ring[i], tolerance);
            const int b = point_at(outline, ring[(i + 1) % ring.size()], tolerance);
            // A vertex of a neighbour may lie within this side: it splits the side, or the regions
            // would not share their nodes.
            const std::vector<int> chain = points_between(outline, a, b, tolerance);
            for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
                loop.push_back(line_between(outline, chain[k], chain[k + 1]));
            }
        }
        outline.loops.push_back(std::move(loop));
    }
    return outline;
}

/// Signed lines of a loop from the point at corner `from` to that at `to`.
std::vector<int> side_lines(const Outline& outline, const std::vector<int>& loop, const Vec2& from,
                            const Vec2& to) {
    const auto start = [&](int signed_line) {
        const Outline::Line& line = outline.lines[std::abs(signed_line) - 1];
        return outline.points[signed_line > 0 ? line.from : line.to];
    };
    std::size_t at = 0;
    while ((start(loop[at]) - from).norm() > 1e-9 * (to - from).norm()) at = (at + 1) % loop.size();
    std::vector<int> lines;
    do {
        lines.push_back(loop[at]);
        at = (at + 1) % loop.size();
    } while ((start(loop[at]) - to).norm() > 1e-9 * (to - from).norm());
    return lines;
}

void divide_block(Outline& outline, const std::vector<Piece>& pieces, std::size_t p,
                  std::vector<fault::Fault>& faults) {
    const scene::Region& region = pieces[p].region;
    const std::string pointer =
        "/section/regions/" + std::to_string(pieces[p].of) + "/mesh/divisions";
    const std::array<double, 4> growth{pieces[p].growth, 1.0, 1.0 / pieces[p].growth, 1.0};
    for (std::size_t k = 0; k < 4; ++k) {
        const auto lines = side_lines(outline, outline.loops[p], region.polygon[region.corners[k]],
                                      region.polygon[region.corners[(k + 1) % 4]]);
        std::vector<double> lengths;
        for (const int i : lines) lengths.push_back(outline.lines[std::abs(i) - 1].length);
        const auto shares = share_divisions(lengths, region.divisions[k % 2], pieces[p].unit);
        if (shares.empty()) {
            faults.push_back({pointer,
                              "fewer divisions than segments on a side of '" + region.name + "'",
                              "give at least one division per segment"});
            return;
        }
        for (std::size_t i = 0; i < lines.size(); ++i) {
            Outline::Line& line = outline.lines[std::abs(lines[i]) - 1];
            if (line.divisions != 0 && line.divisions != shares[i]) {
                faults.push_back({pointer,
                                  "regions '" + pieces[line.divided_by].region.name + "' and '" +
                                      region.name + "' divide their shared side into " +
                                      std::to_string(line.divisions) + " and " +
                                      std::to_string(shares[i]),
                                  "give both the same number"});
            }
            line.divisions = shares[i];
            // A line has one direction, and the regions on its two sides use it in opposite ones.
            line.growth = lines[i] > 0 ? growth[k] : 1.0 / growth[k];
            line.divided_by = p;
        }
    }
}

/// Even divisions on the free lines of an unstructured region; one more on a line of its own if its
/// blocks leave an odd sum: only an even border can be filled with quads.
void divide_unstructured(Outline& outline, const std::vector<Piece>& pieces,
                         std::vector<fault::Fault>& faults) {
    std::vector<int> uses(outline.lines.size(), 0);
    for (const auto& loop : outline.loops) {
        for (const int line : loop) ++uses[std::abs(line) - 1];
    }
    for (std::size_t p = 0; p < pieces.size(); ++p) {
        const scene::Region& region = pieces[p].region;
        if (region.mesh != scene::RegionMesh::unstructured) continue;
        int sum = 0;
        Outline::Line* own = nullptr;
        for (const int signed_line : outline.loops[p]) {
            Outline::Line& line = outline.lines[std::abs(signed_line) - 1];
            if (line.divisions == 0) {
                const double wanted = line.length / (2.0 * region.element_size);
                line.divisions = 2 * std::max(1, static_cast<int>(std::lround(wanted)));
                // A line without a neighbour: one more division on it disturbs no one.
                if (uses[std::abs(signed_line) - 1] == 1) own = &line;
            }
            sum += line.divisions;
        }
        if (sum % 2 == 0) continue;
        if (own != nullptr) {
            ++own->divisions;
        } else {
            faults.push_back({"/section/regions/" + std::to_string(pieces[p].of) + "/mesh",
                              "the border of '" + region.name +
                                  "' has an odd number of divisions (" + std::to_string(sum) +
                                  "): quads cannot fill it",
                              "change the divisions of a neighbouring block by one"});
        }
    }
}

/// gmsh's 2D algorithm and its recombination of triangles to quads.
struct Recipe {
    int algorithm;
    int recombination;
};

/// Tried in this order until no triangle is left: frontal, Delaunay and adaptive triangles,
/// recombined by blossom or, if all lines have even divisions, at twice the size and halved. The
/// last two split remaining triangles, which gives more elements than requested. (Algorithm 8, for
/// quads, crashes in Debian's gmsh 4.8.4.)
constexpr std::array<Recipe, 7> recipes{{{6, 1}, {6, 3}, {5, 1}, {5, 3}, {1, 1}, {9, 3}, {6, 2}}};

/// One physical surface per region, for all its pieces.
void write_regions(std::ostringstream& geo, const std::vector<Piece>& pieces) {
    for (std::size_t p = 0; p < pieces.size(); ++p) {
        const bool begins = p == 0 || pieces[p - 1].of != pieces[p].of;
        const bool ends = p + 1 == pieces.size() || pieces[p + 1].of != pieces[p].of;
        if (begins) geo << "Physical Surface(\"" << pieces[p].region.name << "\") = {";
        geo << (begins ? "" : ", ") << p + 1 << (ends ? "};\n" : "");
    }
}

std::string geo_text(const Outline& outline, const std::vector<Piece>& pieces,
                     const Recipe& recipe) {
    std::ostringstream geo;
    geo << std::setprecision(17);
    // One thread and nearly no random shift: the same scene gives the same mesh.
    geo << "General.NumThreads = 1;\nMesh.Algorithm = " << recipe.algorithm
        << ";\nMesh.RecombinationAlgorithm = " << recipe.recombination
        << ";\nMesh.RecombineAll = 1;\nMesh.RandomFactor = "
           "1e-9;\n"
           "Mesh.Smoothing = 5;\nMesh.MshFileVersion = 2.2;\nMesh.Binary = 0;\n";
    double largest = 0.0;
    for (const Piece& piece : pieces) {
        largest = std::max(largest, piece.region.element_size);
    }
    geo << "Mesh.CharacteristicLengthMax = " << largest << ";\n";
    for (std::size_t i = 0; i < outline.points.size(); ++i) {
        geo << "Point(" << i + 1 << ") = {" << outline.points[i].x() << ", "
            << outline.points[i].y() << ", 0};\n";
    }
    for (std::size_t i = 0; i < outline.lines.size(); ++i) {
        const Outline::Line& line = outline.lines[i];
        geo << "Line(" << i + 1 << ") = {" << line.from + 1 << ", " << line.to + 1 << "};\n"
            << "Transfinite Line {" << i + 1 << "} = " << line.divisions + 1
            << " Using Progression " << line.growth << ";\n";
    }
    for (std::size_t p = 0; p < pieces.size(); ++p) {
        const scene::Region& region = pieces[p].region;
        geo << "Line Loop(" << p + 1 << ") = {";
        for (std::size_t k = 0; k < outline.loops[p].size(); ++k) {
            geo << (k == 0 ? "" : ", ") << outline.loops[p][k];
        }
        geo << "};\nPlane Surface(" << p + 1 << ") = {" << p + 1 << "};\n";
        if (region.mesh == scene::RegionMesh::block) {
            geo << "Transfinite Surface {" << p + 1 << "} = {";
            for (std::size_t k = 0; k < 4; ++k) {
                const Vec2& corner = region.polygon[region.corners[k]];
                const auto nearest = std::ranges::min_element(
                    outline.points, {}, [&](const Vec2& x) { return (x - corner).norm(); });
                geo << (k == 0 ? "" : ", ") << nearest - outline.points.begin() + 1;
            }
            geo << "};\n";
        }
    }
    write_regions(geo, pieces);
    return geo.str();
}

/// Waits for a child process; ends it if `stop` returns true.
int status_of(pid_t child, const StopQuestion& stop) {
    constexpr timespec between_looks{0, 5'000'000};  // 5 ms; a signal ends it early
    int status = 0;
    while (waitpid(child, &status, WNOHANG) == 0) {
        if (stop()) {
            kill(child, SIGKILL);  // it has nothing to save
            waitpid(child, &status, 0);
            throw MeshingStopped();
        }
        nanosleep(&between_looks, nullptr);
    }
    if (stop()) throw MeshingStopped();  // a signal may have ended both
    return status;
}

/// Runs a program on the PATH with its output in `log`; returns its exit code.
int run_program(std::vector<std::string> words, const std::filesystem::path& log,
                const StopQuestion& stop) {
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
    const int status = status_of(child, stop);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

Mesh mesh_with_gmsh(const scene::Section& section, const std::filesystem::path& folder,
                    const StopQuestion& stop) {
    const std::vector<Piece> pieces = pieces_of(section);
    Outline outline = outline_of(pieces);
    std::vector<fault::Fault> faults;
    for (std::size_t p = 0; p < pieces.size(); ++p) {
        if (pieces[p].region.mesh == scene::RegionMesh::block) {
            divide_block(outline, pieces, p, faults);
        }
    }
    divide_unstructured(outline, pieces, faults);
    if (!faults.empty()) throw fault::BadInput("scene", std::move(faults));
    const auto geo = folder / "mesh.geo", msh = folder / "mesh.msh", log = folder / "gmsh.log";
    for (std::size_t attempt = 0;; ++attempt) {
        exchange::publish_text(geo, geo_text(outline, pieces, recipes[attempt]));
        const int code = run_program({"gmsh", "-2", geo.string(), "-o", msh.string()}, log, stop);
        const bool last = attempt + 1 == recipes.size();
        // Recipes fail in two ways: gmsh itself, or triangles that read_msh refuses.
        if (code != 0 && last) {
            throw fault::IoError("gmsh failed with exit code " + std::to_string(code) + ": see " +
                                 log.string());
        }
        if (code != 0) continue;
        try {
            return read_msh(msh, section);
        } catch (const fault::BadInput&) {
            if (last) throw;  // another recipe may succeed
        }
    }
}

}  // namespace breach::fem
