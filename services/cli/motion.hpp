// `motion`: what records of earthquakes are measured by, and what a study of several of them says.
#pragma once

#include <optional>

#include "services/cli/commands.hpp"
#include "services/cli/http/server.hpp"

namespace breach::cli {

struct MotionOptions {
    std::filesystem::path file;   ///< or a folder of them
    std::string run;              ///< instead: of a study of motions
    std::filesystem::path scene;  ///< write a study that shakes it by each record
    std::vector<double> pga_g;    ///< scaled to each of these; empty: as recorded
    std::optional<double> scale_to_pga_g;
    bool corrected = false;  ///< the baseline first
};

fault::ExitCode show_motion(Server& server, const MotionOptions& options, const Console& console);

}  // namespace breach::cli
