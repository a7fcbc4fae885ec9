// lem_tool: a phase without input files; it needs the scene alone.
#include "core/phases/phases.hpp"
#include "core/process/phase.hpp"
#include "lem_tool/analysis.hpp"

int main(int argc, char** argv) {
    using namespace breach;
    return process::run_phase(argc, argv,
                              {.name = breach::phases::lem.program,
                               .purpose = "Limit equilibrium: how stable is the section?",
                               .inputs = {.least = 0, .most = 0, .what = "no input file"},
                               .plan = lem::plan,
                               .run = lem::run,
                               .numerics = lem::numerics});
}
