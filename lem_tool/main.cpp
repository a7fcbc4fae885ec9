// lem_tool: the scene alone, or with the snapshots of a FEM the dam that has been shaken.
#include "core/phases/phases.hpp"
#include "core/process/phase.hpp"
#include "lem_tool/analysis.hpp"

int main(int argc, char** argv) {
    using namespace breach;
    return process::run_phase(
        argc, argv,
        {.name = breach::phases::lem.program,
         .purpose = "Limit equilibrium: how stable is the section?",
         .inputs = {.least = 0, .most = 1, .what = "none, or a FEM snapshot or series"},
         .plan = lem::plan,
         .run = lem::run,
         .numerics = lem::numerics,
         .with_input = breach::phases::post_seismic.program});
}
