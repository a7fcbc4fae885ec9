// Figures of a calibration of NorSand: measured values beside the law's, critical state line,
// dilatancy.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/exchange/archive.hpp"
#include "services/report/chart/figure.hpp"

namespace breach::report {

/// A column of an element-test archive; `unit`: the figure's unit in SI. Throws BadInput if it is
/// missing.
std::vector<double> curve_column(const exchange::Archive& curves, const std::string& name,
                                 double unit);

/// calibration: result.json's `norsand_calibration`; curves: the archive beside it.
std::vector<Figure> norsand_figures(const nlohmann::json& calibration,
                                    const exchange::Archive& curves);

}  // namespace breach::report
