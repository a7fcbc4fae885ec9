// A chart as data. draw.hpp draws it; independent of soils and files.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "services/report/chart/axis.hpp"

namespace breach::report {

/// segments: joins the points 0-1, 2-3, ... (meshes); dots: one small dot per point (clouds); bars:
/// broad segments.
enum class Style { line, points, line_and_points, area, segments, dots, bars };
enum class Aspect { free, equal };  ///< equal: a unit of x is as long as a unit of y

struct Axis {
    std::string label;  ///< with its unit: "shear strain [%]"
    Scale scale = Scale::linear;
    std::vector<std::string> names = {};  ///< of the values 0, 1, 2, ...; for y only
};

/// Certainty of a point's value. at_least: a lower bound, drawn with an arrow upwards.
enum class Certainty { certain, at_least, doubtful };
/// "lower bound": for legends and data.
const char* name_of(Certainty certainty);

struct Series {
    std::string name;
    std::vector<double> x;
    std::vector<double> y;
    Style style = Style::line;
    std::vector<Certainty> certainty = {};  ///< of each point; empty: all are certain
    /// Error bar of each point, up and down in y; NaN: unknown; empty: no error bars
    std::vector<double> error = {};
    /// Range in y of each point; NaN: unknown; empty: no ranges
    std::vector<double> low = {}, high = {};
    /// Index of an earlier series with the same colour, for computed beside measured values. Such a
    /// series has no entry in the legend.
    std::optional<std::size_t> like = {};
};

/// Polygons (or, with one corner each, dots) coloured by a value.
struct Field {
    std::string label;          ///< of the value, with its unit
    std::size_t corners;        ///< of each polygon
    std::vector<double> x;      ///< [n * corners], corner after corner
    std::vector<double> y;      ///< [n * corners]
    std::vector<double> value;  ///< [n]
    Range range;  ///< of the colours; values outside have the colour of the nearer end
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
    std::optional<Field> field = {};  ///< drawn beneath the series
};

/// Throws std::invalid_argument when related columns differ in length.
void check_columns(const Chart& chart);

}  // namespace breach::report
