// A small run with known numbers: two wet elements, four points, two variants, telemetry that
// crosses the thresholds at known times.
#pragma once

#include <filesystem>
#include <string>

namespace breach::report {

/// Writes it as `breach export` does; `scene_name` decides whether a paper belongs to it.
void write_wet_run(const std::filesystem::path& folder, const std::string& scene_name);

}  // namespace breach::report
