// The mesh to draw, from the program that will compute with it: a mesh of our own here could
// differ. Cached by everything it depends on.
#include "services/drawing/mesh_question.hpp"

#include <filesystem>
#include <fstream>

#include "core/command/command.hpp"
#include "core/exchange/mesh_snapshot.hpp"
#include "core/exchange/publish.hpp"
#include "core/exchange/temporary_folder.hpp"
#include "core/phases/files.hpp"

namespace breach::drawing {

using nlohmann::json;
namespace fs = std::filesystem;

namespace {

/// Everything that a mesh depends on: its geometry and sizes, and the mesher with its time, as
/// another version may mesh differently.
std::string key_of(const Draft& draft, const fs::path& program) {
    const json completed = json::parse(draft.scene.completed);
    const auto& file = draft.scene.fem->mesh.msh_file;
    std::error_code error;
    const auto built = fs::last_write_time(program, error).time_since_epoch().count();
    return exchange::sha256_of_text(completed.at("section").dump() +
                                    (file ? exchange::sha256_of_file(*file) : "") +
                                    program.string() + std::to_string(built));
}

/// Ends a mesher that hangs.
constexpr auto longest_meshing = std::chrono::hours(1);

/// Throws the fault that the phase wrote.
[[noreturn]] void tell_fault(const fs::path& folder, const std::string& prefix) {
    std::ifstream stream(folder / phases::files::fault);
    const json told = json::parse(stream, nullptr, false);
    std::vector<fault::Fault> faults;
    if (told.is_object())
        for (const json& each : told.value("faults", json::array()))
            faults.push_back({prefix + each.value("pointer", ""), each.value("cause", ""),
                              each.value("remedy", "")});
    if (!faults.empty()) throw fault::BadInput("scene", std::move(faults));
    throw fault::IoError("the mesh: " + (told.is_object()
                                             ? told.value("summary", "fem_solver failed")
                                             : std::string("fem_solver mesh does not answer")));
}

/// Two requests for one mesh may make it twice; each moves its own file to the same name.
void make(const Draft& draft, const Mesher& mesher, const fs::path& file) {
    // Inside the cache, so that the mesh can be moved within one disk.
    const exchange::TemporaryFolder scratch("meshing-", mesher.cache);
    const fs::path scene = scratch.path() / "scene.json", output = scratch.path() / "mesh";
    exchange::publish_text(scene, draft.base.scene.dump());
    const auto made = command::run({mesher.fem_solver.string(), "mesh", scene.string(), "--output",
                                    output.string(), "--progress", "none"},
                                   "", longest_meshing);
    if (made.exit_code != 0) tell_fault(output, draft.base.pointer);
    fs::rename(output / phases::files::snapshot_name(0.0), file);
}

}  // namespace

DrawnMesh mesh_of(const Draft& draft, const Mesher& mesher) {
    std::error_code error;
    fs::create_directories(mesher.cache, error);
    if (error) throw fault::IoError(mesher.cache.string() + ": cannot be made: " + error.message());
    const fs::path file = mesher.cache / (key_of(draft, mesher.fem_solver) + ".vtkhdf");
    if (!fs::exists(file)) make(draft, mesher, file);
    const exchange::MeshSnapshot mesh = exchange::read_mesh_snapshot(file).snapshot;
    return {mesh.position_0, mesh.quads};
}

}  // namespace breach::drawing
