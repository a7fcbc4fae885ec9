// Element tests and calibrations, which `fem_solver element-test` and `fem_solver calibrate` start.
#include <string_view>

#include "core/process/phase.hpp"
#include "element_bench/run.hpp"

int main(int argc, char** argv) {
    const std::string_view command = argc > 1 ? argv[1] : "";
    const bool calibrates = command == "calibrate";
    // The command's word is ours; run_phase() reads the rest like any phase's arguments.
    const int skipped = calibrates || command == "element-test" ? 1 : 0;
    return breach::process::run_phase(argc - skipped, argv + skipped,
                                      calibrates ? breach::element_bench::calibrate_phase()
                                                 : breach::element_bench::element_test_phase());
}
