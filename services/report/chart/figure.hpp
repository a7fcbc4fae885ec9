// A figure: a chart with a file name, published as SVG and its data as CSV.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "services/report/chart/chart.hpp"

namespace breach::report {

struct Figure {
    std::string name;  ///< file name without extension
    Chart chart;
    std::string caption = {};  ///< what the figure shows, in a sentence or two
};

/// Columns series, x, y (headed by the axes' labels), one row per point, all digits. Further
/// columns where known: certainty, error, and the two ends of a band. A chart with a field instead
/// has x and y of each corner and the value, one row per polygon, without the series drawn over it.
std::string as_csv(const Chart& chart);
/// A CSV cell of text.
std::string quoted(const std::string& text);
/// Writes name.svg and name.csv. Throws IoError; BadInput if the name would leave the folder.
void write_figures(const std::filesystem::path& folder, const std::vector<Figure>& figures);

}  // namespace breach::report
