#include "core/process/phase.hpp"
#include "fem_solver/run.hpp"

int main(int argc, char** argv) {
    return breach::process::run_phase(
        argc, argv,
        {.name = "fem_solver",
         .purpose = "Dynamic finite elements: from geostatic stress to the failing slope",
         .inputs = {0, 0, "takes no input beside the scene"},
         .plan = breach::fem::plan,
         .run = breach::fem::run});
}
