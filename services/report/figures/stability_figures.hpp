// Figures of lem_tool: factor of safety against liquefied depth, section and critical circles.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "services/report/chart/figure.hpp"

namespace breach::report {

/// folder: contains result.json and scene.completed.json. Throws IoError or BadInput.
std::vector<Figure> stability_figures(const std::filesystem::path& folder);

/// Through [[x, y], ...].
Series line_of(const nlohmann::json& points, const std::string& name);

/// The critical surface of a result; nothing: it has none.
std::optional<Series> critical_surface(const nlohmann::json& scene, const nlohmann::json& result);

}  // namespace breach::report
