// mpm_solver: the runout of a failing mass by the material point method.
#include "core/phases/phases.hpp"
#include "core/process/phase.hpp"
#include "mpm_solver/run.hpp"

int main(int argc, char** argv) {
    using namespace breach;
    process::Phase phase{
        .name = breach::phases::mpm.program,
        .purpose = "Runout of a failing mass by the material point method (plane strain, explicit)",
        .inputs = {.least = 0,
                   .most = 1,
                   .what = "points from transfer_tool (.vtkhdf); without them the section is "
                           "filled with points at rest"},
        .plan = mpm::plan,
        .run = mpm::run,
        .numerics = mpm::numerics,
        .measure = mpm::measure};
    phase.switches.push_back({.name = "--until-rest",
                              .purpose = "run until the soil rests, at most for "
                                         "/mpm/longest_duration: --set /mpm/duration=until_rest",
                              .sets = "/mpm/duration=until_rest"});
    return process::run_phase(argc, argv, phase);
}
