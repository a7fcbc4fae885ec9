// `motion`: intensity measures of earthquake records, and results of a study of several of them.
#pragma once

#include <optional>

#include "services/cli/commands.hpp"
#include "services/cli/http/server.hpp"

namespace breach::cli {

struct MotionOptions {
    std::filesystem::path file;   ///< one record, or a folder of records
    std::string run;              ///< instead of `file`: a run of several motions
    std::filesystem::path scene;  ///< write a study that applies each record to this scene
    std::vector<double> pga_g;    ///< scaled to each of these; empty: as recorded
    std::optional<double> scale_to_pga_g;
    bool corrected = false;  ///< apply a baseline correction first
};

fault::ExitCode show_motion(Server& server, const MotionOptions& options, const Console& console);

}  // namespace breach::cli
