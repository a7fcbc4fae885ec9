// `import`: a section drawn elsewhere becomes a scene file. Reads and writes files; what is done with
// the drawing is services/import's affair, and no server is asked.
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
    std::vector<std::string> map = {}, layers = {};
    std::string unit = "", name = "";
    double tolerance = 0.05;
    std::optional<double> flatten = {};
    bool confirmed = false;  ///< --yes
};

/// At a terminal, asks whether sizes that look like a slip are meant. Writes the scene and tells what was healed, guessed and passed over. With faults only the picture
/// is written; they are told on the side and the exit code is bad_input.
fault::ExitCode import_drawing(const ImportOptions& options, const Console& console);

}  // namespace breach::cli
