// Figures of lem_tool: factor of safety against liquefied depth, section and critical circles.
#pragma once

#include "services/report/chart/figure.hpp"

namespace breach::report {

/// folder: holds result.json and scene.completed.json. Throws IoError or BadInput.
std::vector<Figure> stability_figures(const std::filesystem::path& folder);

}  // namespace breach::report
