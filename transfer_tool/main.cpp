#include "core/process/phase.hpp"
#include "transfer_tool/run.hpp"

int main(int argc, char** argv) {
    return breach::process::run_phase(
        argc, argv,
        {.name = "transfer_tool",
         .purpose = "From a FEM snapshot to material points, with a ledger of what was kept",
         .inputs = {1, 1, "a FEM snapshot (.vtkhdf)"},
         .plan = breach::transfer::plan,
         .run = breach::transfer::run});
}
