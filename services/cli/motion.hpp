// `motion`: intensity measures of earthquake records, and results of a study of several of them.
#pragma once

#include <optional>

#include "services/cli/commands.hpp"
#include "services/cli/http/server.hpp"

namespace breach::cli {

struct MotionOptions {
    std::filesystem::path file;   ///< or a folder of them
    std::string run;              ///< instead: of a study of motions
    std::filesystem::path scene;  ///< write a study that applies each record to it
    std::vector<double> pga_g;    ///< scaled to each of these; empty: as recorded
    std::optional<double> scale_to_pga_g;
    bool corrected = false;  ///< baseline correction first
};

fault::ExitCode show_motion(Server& server, const MotionOptions& options, const Console& console);

}  // namespace breach::cli
