// A figure: a chart with a file name, published as SVG and its data as CSV.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "services/report/chart.hpp"

namespace breach::report {

struct Figure {
    std::string name;  ///< file name without extension
    Chart chart;
};

/// Columns series, x, y (with the axes' labels as heads), one row per point, every digit.
std::string as_csv(const Chart& chart);
/// Writes name.svg and name.csv. Throws IoError; BadInput if the name would leave the folder.
void write_figures(const std::filesystem::path& folder, const std::vector<Figure>& figures);

}  // namespace breach::report
