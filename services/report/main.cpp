// report: figures of what phases have written.
#include <CLI/CLI.hpp>
#include <iostream>

#include "core/fault/fault.hpp"
#include "services/report/element_test_figures.hpp"
#include "services/report/stability_figures.hpp"

int main(int argc, char** argv) {
    using namespace breach;
    CLI::App app("Figures (SVG) and their data (CSV) from the outputs of phases", "report");
    app.require_subcommand(1);
    std::filesystem::path folder, output;
    CLI::App* element = app.add_subcommand("element-test", "from fem_solver element-test");
    CLI::App* stability = app.add_subcommand("stability", "from lem_tool");
    for (CLI::App* each : {element, stability}) {
        each->add_option("folder", folder, "output folder of the phase")->required();
        each->add_option("--output", output, "folder for figures, made if absent")->required();
    }
    fault::ExitCode code = fault::ExitCode::done;
    try {
        app.parse(argc, argv);
        report::write_figures(output, *element ? report::element_test_figures(folder)
                                               : report::stability_figures(folder));
    } catch (const CLI::ParseError& error) {
        code = app.exit(error) == 0 ? fault::ExitCode::done : fault::ExitCode::usage;
    } catch (const fault::BadInput& error) {
        std::cerr << error.what() << "\n";
        code = fault::ExitCode::bad_input;
    } catch (const std::invalid_argument& error) {  // numbers that cannot be drawn
        std::cerr << folder.string() << ": " << error.what() << "\n";
        code = fault::ExitCode::bad_input;
    } catch (const std::exception& error) {
        std::cerr << error.what() << "\n";
        code = fault::ExitCode::io;
    }
    return static_cast<int>(code);
}
