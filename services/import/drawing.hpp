// A drawing before it becomes soil: polylines by layer, each with its place in the file.
// Independent of materials, tolerances and scenes.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/fault/fault.hpp"
#include "core/mechanics/tensor.hpp"

namespace breach::importing {

using fault::Fault;
using mechanics::Vec2;

/// Line of the file and entity ("LWPOLYLINE 2F").
struct Origin {
    std::size_t line = 0;
    std::string entity;
};

struct Outline {
    std::string layer;
    std::vector<Vec2> points;  ///< [m]; a closed one does not repeat the first
    bool closed;
    Origin origin;
    bool fills = false;  ///< an area (HATCH, SOLID): may repeat an outline of its layer
};

/// A layer without a meaning, and the first place on it.
struct UnknownLayer {
    std::size_t entities = 0;
    Vec2 first;  ///< [m]
    Origin origin;
};

struct Drawing {
    std::vector<Outline> outlines;  ///< of layers with a meaning
    std::map<std::string, UnknownLayer> unknown;
    std::set<std::string> layers;  ///< all layers with drawn objects
    std::vector<Fault> faults;
    std::vector<std::string> remarks;  ///< skipped objects and assumptions
    std::string unit = "m";            ///< unit of its coordinates
    bool knows_unit = true;
    bool says_unit = false;  ///< whether a table's header gives it
};

/// Limits on outlines and points: no section has more.
constexpr std::size_t most_outlines = 2000, most_points = 4000;

/// "line 12"
std::string at_line(std::size_t line);
/// "LWPOLYLINE 2F on layer CLAY"
std::string named(const Outline& outline);
/// "(12.5, -3)", in the form that the drawing of faults reads.
std::string text(const Vec2& place);
/// "0.013 m"
std::string metres(double length);
/// "45.7 m", "1250 m"
std::string extent(double length);
/// "1200.5 m2"
std::string square_metres(double area);
/// Converts bytes of any code page to UTF-8: bytes that are not UTF-8 are read as Latin-1.
std::string as_utf8(std::string_view bytes);
std::string lower(std::string text);

}  // namespace breach::importing
