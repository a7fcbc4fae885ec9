// fem_solver: the analysis, `mesh` (the mesh alone), and `element-test` and `calibrate`, which
// belong to element_bench and are reached through this name.
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <string_view>

#include "core/phases/phases.hpp"
#include "core/process/phase.hpp"
#include "fem_solver/mesh_alone.hpp"
#include "fem_solver/run.hpp"
#include "fem_solver/solve/profile.hpp"

namespace {

/// Element tests are a separate program in the same folder. Returns only if it is missing.
int become_element_bench(char** argv) {
    const auto program =
        std::filesystem::read_symlink("/proc/self/exe").parent_path() / "element_bench";
    // Replaces this process: signals, output and exit code are those of the other program.
    execv(program.c_str(), argv);
    std::perror(program.c_str());
    return static_cast<int>(breach::fault::ExitCode::io);
}

}  // namespace

int main(int argc, char** argv) {
    const std::string_view command = argc > 1 ? argv[1] : "";
    if (command == "element-test" || command == "calibrate") return become_element_bench(argv);
    if (command == "mesh")
        return breach::process::run_phase(argc - 1, argv + 1, breach::fem::mesh_phase());
    breach::process::Phase phase{
        .name = breach::phases::fem.program,
        .purpose =
            "Dynamic finite elements: from geostatic stress to the failing slope. "
            "Also: fem_solver mesh, fem_solver element-test, fem_solver calibrate",
        .inputs = {0, 0, "takes no input beside the scene"},
        .plan = breach::fem::plan,
        .run = breach::fem::run,
        .numerics = breach::fem::numerics,
        .measure = breach::fem::measure};
    phase.switches.push_back(
        {breach::fem::profile_switch, "print CPU seconds by kind of work at the end"});
    return breach::process::run_phase(argc, argv, phase);
}
