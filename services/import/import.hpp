// Converts a section drawing (DXF, CSV) to a scene: reads, heals, cuts into layers, checks. Texts
// in, a scene or its faults out; the callers handle files, options and pictures.
//
// The namespace is not `import`, a keyword of C++20.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/fault/fault.hpp"
#include "core/scene/scene.hpp"
#include "services/earthquake/earthquake.hpp"

namespace breach::importing {

struct Sent {
    std::string name;  ///< of the file, for messages
    std::string bytes;
};

struct Request {
    Sent drawing;                       ///< DXF, or CSV with region, x, y
    nlohmann::json materials;           ///< a scene's /materials, or a document that has them
    std::vector<std::string> map = {};  ///< "LAYER=material", "LAYER=phreatic|terrain|ground|none"
    std::vector<std::string> layers =
        {};  ///< "REGION=5,10,15": cut at depths below the phreatic line [m]
    std::optional<Sent> phreatic = {}, terrain = {}, ground = {};  ///< CSV with x, y
    std::string unit = "";    ///< empty: that of the drawing or of the CSV's header, else metres
    double tolerance = 0.05;  ///< points closer than this coincide [m]
    std::optional<double> flatten = {};  ///< arcs become chords with at most this error [m]
    std::string name = "";               ///< of the scene; empty: the file's name
    bool confirmed = false;              ///< sizes that look like a wrong unit are intended
    std::optional<earthquake::Motion> motion = {};  ///< shakes the section; none: no FEM
    /// "REGION=0.08,SOURCE": liquefied at rest below the phreatic line; see liquefy.hpp
    std::vector<std::string> liquefied = {};
};

struct Imported {
    nlohmann::json scene;  ///< null when there are faults; names its motion "motion.csv"
    nlohmann::json study;  ///< with a motion or liquefied soil, without the scene; else null
    std::string motion;    ///< text of motion.csv; empty: none
    /// unit, unit_from ("asked", "drawing", "header", "default"), size [length, height, m],
    /// tolerance, healed, areas, guessed, remarks; slope {crest, toe} if there is one; other_units
    nlohmann::json report;
    /// Unconfirmed sizes that look like a wrong unit; they are faults as well.
    std::vector<fault::Fault> to_confirm;
    std::vector<fault::Fault> faults;  ///< pointers: "line 12", an option's name, or into the scene
    scene::Scene sketch;               ///< for a picture: the scene, or the outlines as sent
};

/// Never throws.
Imported import_section(const Request& request);

/// The report as text lines, with at most `most` lines of `healed`.
std::vector<std::string> lines_of(const nlohmann::json& report, std::size_t most);

}  // namespace breach::importing
