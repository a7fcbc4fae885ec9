// transfer_tool: from a FEM snapshot to material points; `transfer_tool advise` is a phase of its
// own, with other inputs and another plan.
#include <string_view>

#include "core/phases/phases.hpp"
#include "core/process/phase.hpp"
#include "transfer_tool/run.hpp"

int main(int argc, char** argv) {
    const std::string_view command = argc > 1 ? argv[1] : "";
    if (command == "advise")
        return breach::process::run_phase(argc - 1, argv + 1, breach::transfer::advise_phase());
    return breach::process::run_phase(
        argc, argv,
        {.name = breach::phases::transfer.program,
         .purpose = "From a FEM snapshot to material points, with a ledger of what was kept. "
                    "Also: transfer_tool advise",
         .inputs = {1, 1, "a FEM snapshot (.vtkhdf)"},
         .plan = breach::transfer::plan,
         .run = breach::transfer::run,
         .read = breach::transfer::read,
         .numerics = breach::transfer::numerics});
}
