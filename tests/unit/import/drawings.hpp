// DXF texts as CAD programs write them, and a section to draw: foundation, dam and tailings that
// share borders.
#pragma once

#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "services/import/import.hpp"

namespace breach::importing::test {

using mechanics::Vec2;
using Line = std::vector<Vec2>;

inline std::string group(int code, const std::string& value) {
    return std::to_string(code) + "\n" + value + "\n";
}
inline std::string group(int code, double value) {
    std::ostringstream text;
    text.precision(17);
    text << value;
    return group(code, text.str());
}

inline std::string header(const std::string& version, std::optional<int> insunits) {
    return group(0, "SECTION") + group(2, "HEADER") + group(9, "$ACADVER") + group(1, version) +
           (insunits ? group(9, "$INSUNITS") + group(70, std::to_string(*insunits)) : "") +
           group(0, "ENDSEC");
}

/// LWPOLYLINE of R14 and later, with the subclass markers of 2000; `bulges` by vertex.
inline std::string light(const std::string& layer, const Line& line, bool closed = true,
                         const std::map<std::size_t, double>& bulges = {},
                         const std::string& more = "") {
    std::string text = group(0, "LWPOLYLINE") + group(5, "2F") + group(100, "AcDbEntity") +
                       group(8, layer) + group(100, "AcDbPolyline") +
                       group(90, std::to_string(line.size())) + group(70, closed ? "1" : "0") +
                       more;
    for (std::size_t i = 0; i < line.size(); ++i) {
        text += group(10, line[i].x()) + group(20, line[i].y());
        if (bulges.contains(i)) text += group(42, bulges.at(i));
    }
    return text;
}

/// POLYLINE, VERTEX, SEQEND of R12.
inline std::string heavy(const std::string& layer, const Line& line, bool closed = true) {
    std::string text = group(0, "POLYLINE") + group(8, layer) + group(66, "1") + group(10, 0.0) +
                       group(20, 0.0) + group(30, 0.0) + group(70, closed ? "1" : "0");
    for (const Vec2& each : line)
        text += group(0, "VERTEX") + group(8, layer) + group(10, each.x()) + group(20, each.y()) +
                group(30, 0.0);
    return text + group(0, "SEQEND") + group(8, layer);
}

/// A LINE per side.
inline std::string sides(const std::string& layer, const Line& ring) {
    std::string text;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
        text += group(0, "LINE") + group(8, layer) + group(10, a.x()) + group(20, a.y()) +
                group(30, 0.0) + group(11, b.x()) + group(21, b.y()) + group(31, 0.0);
    }
    return text;
}

inline std::string place(int code, const Vec2& at) {
    return group(code, at.x()) + group(code + 10, at.y());
}

/// HATCH of these boundary paths, with a seed point.
inline std::string hatch(const std::string& layer, const std::vector<std::string>& paths) {
    std::string text = group(0, "HATCH") + group(5, "7B") + group(8, layer) + place(10, {0, 0}) +
                       group(2, "SOLID") + group(91, std::to_string(paths.size()));
    for (const std::string& each : paths) text += each;
    return text + group(75, "0") + group(98, "1") + place(10, {9, 9});
}

/// Boundary path of a hatch.
inline std::string path(const Line& line, const std::map<std::size_t, double>& bulges = {}) {
    std::string text = group(92, "2") + group(72, bulges.empty() ? "0" : "1") + group(73, "1") +
                       group(93, std::to_string(line.size()));
    for (std::size_t i = 0; i < line.size(); ++i) {
        text += place(10, line[i]);
        if (!bulges.empty()) text += group(42, bulges.contains(i) ? bulges.at(i) : 0.0);
    }
    return text + group(97, "0");
}

inline std::string dxf(const std::string& entities, std::optional<int> insunits = 6,
                       const std::string& version = "AC1015", const std::string& tables = "") {
    return header(version, insunits) + tables + group(0, "SECTION") + group(2, "ENTITIES") +
           entities + group(0, "ENDSEC") + group(0, "EOF");
}

inline const Line rock{{0, -10}, {120, -10}, {120, 0}, {80, 0}, {20, 0}, {0, 0}};
inline const Line clay{{20, 0}, {80, 0}, {55, 12}, {50, 12}};
inline const Line tailings{{0, 0}, {20, 0}, {50, 12}, {0, 11}};

inline nlohmann::json materials() {
    const auto soil = [](double density, double c, double phi) {
        return nlohmann::json{{"density", density},
                              {"law",
                               {{"type", "mohr_coulomb"},
                                {"E_MPa", 40},
                                {"nu", 0.3},
                                {"c_kPa", c},
                                {"phi_deg", phi}}}};
    };
    return {{"rock", soil(2200, 100, 38)},
            {"clay", soil(2000, 10, 30)},
            {"tailings", soil(1900, 2, 30)}};
}

inline Request request(std::string drawing, const std::string& file = "dam.dxf") {
    return {.drawing = {file, std::move(drawing)}, .materials = materials()};
}

inline std::string told(const std::vector<fault::Fault>& faults) {
    std::string all;
    for (const fault::Fault& each : faults)
        all += each.pointer + ": " + each.cause + " | " + each.remedy + "\n";
    return all;
}

}  // namespace breach::importing::test
