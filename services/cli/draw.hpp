// `draw`: the section of a scene and what it will cost, before anything runs. The picture is made here;
// a server is asked only for what earlier runs took.
#pragma once

#include "services/cli/commands.hpp"

namespace breach::cli {

struct DrawOptions {
    std::filesystem::path document;  ///< a scene, or a study
    std::filesystem::path picture;   ///< to be written; empty: none
    std::vector<std::string> overrides = {};
    bool mesh = false;  ///< mesh the section for it
};

/// Draws and prints the cost. A scene with faults is drawn with them; the faults are told on the side
/// and the exit code is bad_input. Throws BadInput where there is nothing to draw.
fault::ExitCode draw(Server& server, const DrawOptions& options, const Console& console);

}  // namespace breach::cli
