#include <string_view>

#include "core/phases/phases.hpp"
#include "core/process/phase.hpp"
#include "fem_solver/element_bench/run.hpp"
#include "fem_solver/mesh_alone.hpp"
#include "fem_solver/run.hpp"
#include "fem_solver/solve/profile.hpp"

int main(int argc, char** argv) {
    const std::string_view command = argc > 1 ? argv[1] : "";
    if (command == "element-test") {
        return breach::process::run_phase(argc - 1, argv + 1,
                                          breach::element_bench::element_test_phase());
    }
    if (command == "calibrate") {
        return breach::process::run_phase(argc - 1, argv + 1,
                                          breach::element_bench::calibrate_phase());
    }
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
