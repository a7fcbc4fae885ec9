// `mirror`: the same section drawn from the other side, so that a slide to the left can be followed
// to the right. Needs no server. Runouts, gauges and sections count to the right; one command that
// turns the scene leaves less to explain than a direction in each of them.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/fault/fault.hpp"
#include "services/cli/console.hpp"

namespace breach::cli {

struct MirrorOptions {
    std::filesystem::path scene;
    std::filesystem::path output;  ///< file to write; must not exist
};

/// x becomes -x everywhere, and the motion's sense is reversed; mirrored twice it is the same
/// scene.
/// Throws BadInput for entries that have no mirror image (mesh files, lines of liquefied soil).
nlohmann::ordered_json mirrored(nlohmann::ordered_json scene, const std::string& file);

fault::ExitCode mirror(const MirrorOptions& options, const Console& console);

}  // namespace breach::cli
