// `draw`: draws the section of a scene and prints its cost before a run. Draws locally; asks a
// server only for the cost of earlier runs.
#pragma once

#include "services/cli/commands.hpp"

namespace breach::cli {

struct DrawOptions {
    std::filesystem::path document;  ///< a scene, or a study
    std::filesystem::path picture;   ///< output file; empty: none
    std::vector<std::string> overrides = {};
    bool mesh = false;  ///< mesh the section and draw the mesh
};

/// Draws and prints the cost. Faults of the scene are drawn and printed as notes, and the exit code
/// is bad_input. Throws BadInput where there is nothing to draw.
fault::ExitCode draw(Server& server, const DrawOptions& options, const Console& console);

}  // namespace breach::cli
