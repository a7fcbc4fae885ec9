// `import`: converts a section drawing to a scene file with services/import. Needs no server.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/fault/fault.hpp"
#include "services/cli/console.hpp"

namespace breach::cli {

struct ImportOptions {
    std::filesystem::path drawing, materials, output;
    std::filesystem::path picture = {};  ///< empty: none
    std::filesystem::path phreatic = {}, terrain = {}, ground = {};
    std::vector<std::string> map = {}, layers = {}, liquefied = {};
    std::string unit = "", name = "";
    double tolerance = 0.05;
    std::optional<double> flatten = {};
    bool confirmed = false;  ///< --yes
    bool with_fem = false;   ///< study.json and motion.csv are written beside the scene; with
                             ///< liquefied the study alone
    std::optional<double> pga = {}, shaking = {};  ///< of the synthetic motion [g, s]
    bool force = false;                            ///< overwrite existing files
};

/// Asks at a terminal whether sizes that look like a wrong unit are intended. Writes the scene and
/// prints the corrections, guesses and skipped objects. With faults it writes only the picture,
/// prints the faults as notes and returns bad_input.
fault::ExitCode import_drawing(const ImportOptions& options, const Console& console);

}  // namespace breach::cli
