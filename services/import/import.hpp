// A section drawn elsewhere (DXF, CSV) becomes a scene: read, healed, cut into layers, checked. Pure:
// texts in, a scene or its faults out. Files, options and pictures are the command line's and the
// service's affair.
//
// The namespace is not called `import`, which is a word of C++20.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/fault/fault.hpp"
#include "core/scene/scene.hpp"

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
        {};  ///< "REGION=5,10,15": by depth below the phreatic line [m]
    std::optional<Sent> phreatic = {}, terrain = {}, ground = {};  ///< CSV with x, y
    std::string unit =
        "";  ///< empty: what the drawing or the CSV's header says, else metres for CSV
    double tolerance = 0.05;             ///< nearer is meant to touch [m]
    std::optional<double> flatten = {};  ///< arcs become chords that are off by so much [m]
    std::string name = "";               ///< of the scene; empty: of the file
    bool confirmed = false;              ///< sizes that look like a slip are meant
};

struct Imported {
    nlohmann::json scene;  ///< null when there are faults
    /// unit, unit_from ("asked", "drawing", "header", "default"), size [length, height, m], tolerance, healed,
    /// areas, guessed, remarks; slope {crest, toe} where there is one; other_units
    nlohmann::json report;
    /// What looks like a slip and is not confirmed; they are faults as well.
    std::vector<fault::Fault> to_confirm;
    std::vector<fault::Fault> faults;  ///< pointers: "line 12", an option's name, or into the scene
    scene::Scene sketch;  ///< to be drawn: the scene, or the outlines as they were sent
};

/// Never throws for what was sent.
Imported import_section(const Request& request);

/// The report for people, one thing a line; of `healed` the first `most`.
std::vector<std::string> lines_of(const nlohmann::json& report, std::size_t most);

}  // namespace breach::importing
