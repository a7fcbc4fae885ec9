// `motion`: what a record of an earthquake is measured by.
#pragma once

#include <optional>

#include "services/cli/commands.hpp"

namespace breach::cli {

struct MotionWish {
    std::filesystem::path file;
    std::optional<double> scale_to_pga_g;
    bool corrected = false;  ///< the baseline first
};

fault::ExitCode show_motion(const MotionWish& wish, const Console& console);

}  // namespace breach::cli
