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

/// Columns series, x, y (with the axes' labels as heads), one row per point, every digit. A chart with a field instead:
/// x and y of each corner and the value, one row per place; series drawn over it are not data. If a point is less than
/// certain, a further column has the certainty of each; if an error is known, another has it; if a band is known, the
/// last two have its ends.
std::string as_csv(const Chart& chart);
/// A CSV cell of text.
std::string quoted(const std::string& text);
/// Writes name.svg and name.csv. Throws IoError; BadInput if the name would leave the folder.
void write_figures(const std::filesystem::path& folder, const std::vector<Figure>& figures);

}  // namespace breach::report
