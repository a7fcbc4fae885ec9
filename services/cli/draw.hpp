// `draw`: the section of a scene and its cost, before anything runs. The picture is made locally; a
// server is only asked for the cost of earlier runs.
#pragma once

#include "services/cli/commands.hpp"

namespace breach::cli {

struct DrawOptions {
    std::filesystem::path document;  ///< a scene, or a study
    std::filesystem::path picture;   ///< output file; empty: none
    std::vector<std::string> overrides = {};
    bool mesh = false;  ///< mesh the section for it
};

/// Draws and prints the cost. A scene with faults is drawn with them; the faults are printed as notes
/// and the exit code is bad_input. Throws BadInput where there is nothing to draw.
fault::ExitCode draw(Server& server, const DrawOptions& options, const Console& console);

}  // namespace breach::cli
