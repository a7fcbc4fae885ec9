// What was drawn elsewhere, before it is soil: polylines by layer, each with its place in the file.
// Knows nothing of materials, tolerances or scenes.
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

/// Which line of which file says it, and as what ("LWPOLYLINE 2F").
struct Origin {
    std::size_t line = 0;
    std::string entity;
};

struct Outline {
    std::string layer;
    std::vector<Vec2> points;  ///< [m]; a closed one does not repeat the first
    bool closed;
    Origin origin;
};

/// A layer that nobody said anything about, with where it is first drawn on.
struct UnknownLayer {
    std::size_t entities = 0;
    Vec2 first;  ///< [m]
    Origin origin;
};

struct Drawing {
    std::vector<Outline> outlines;  ///< of layers that mean something
    std::map<std::string, UnknownLayer> unknown;
    std::set<std::string> layers;  ///< all on which something is drawn
    std::vector<Fault> faults;
    std::vector<std::string> remarks;  ///< what was passed over or assumed
    std::string unit = "m";            ///< that its coordinates were in
    bool knows_unit = true;
    bool says_unit = false;  ///< in a table's header
};

/// Outlines and their points that are taken: more are no section.
constexpr std::size_t most_outlines = 2000, most_points = 4000;

/// "line 12"
std::string at_line(std::size_t line);
/// "LWPOLYLINE 2F on layer CLAY"
std::string named(const Outline& outline);
/// "(12.5, -3)", as the faults' drawing reads it.
std::string text(const Vec2& place);
/// "0.013 m"
std::string metres(double length);
/// "45.7 m", "1250 m"
std::string extent(double length);
/// "1200.5 m2"
std::string square_metres(double area);
/// Bytes of whatever code page as UTF-8: what is none is taken for Latin-1.
std::string as_utf8(std::string_view bytes);
std::string lower(std::string text);

}  // namespace breach::importing
