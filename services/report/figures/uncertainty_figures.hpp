// Figures of a study over distributions, from the service's statistics.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "services/report/chart/figure.hpp"

namespace breach::report {

/// The exceedance probability as steps, with its band. label: of the quantity, with its unit;
/// bound_from: least value of a sample that still moved at its end.
Figure exceedance_figure(const nlohmann::json& quantity, const std::string& label,
                         std::optional<double> bound_from);

/// One bar per parameter, the longest on top. Nothing: the surrogate was refused.
std::optional<Figure> tornado_figure(const nlohmann::json& quantity, const std::string& label);

/// p50 along x between p10 and p90; one figure per quantity of envelopes.json that has a number.
std::vector<Figure> envelope_figures(const nlohmann::json& envelopes);

}  // namespace breach::report
