// A chart as data, and its picture as self-contained SVG. Knows nothing of soils or files.
#pragma once

#include <string>
#include <vector>

#include "services/report/axis.hpp"

namespace breach::report {

enum class Style { line, points, line_and_points, area };
enum class Aspect { free, equal };  ///< equal: a unit of x is as long as a unit of y

struct Axis {
    std::string label;  ///< with its unit: "shear strain [%]"
    Scale scale = Scale::linear;
};

struct Series {
    std::string name;
    std::vector<double> x;
    std::vector<double> y;
    Style style = Style::line;
};

/// A line across the chart at one value.
struct Mark {
    enum class At { x, y } at;
    double value;
    std::string label;
};

struct Chart {
    std::string title;
    Axis x;
    Axis y;
    std::vector<Series> series;
    std::vector<Mark> marks = {};
    Aspect aspect = Aspect::free;
};

/// Axes cover all series and marks. Values are finite, and positive on a logarithmic axis: throws
/// std::invalid_argument otherwise, or when there is nothing to draw.
std::string as_svg(const Chart& chart);

}  // namespace breach::report
