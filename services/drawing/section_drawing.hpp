// Draws a scene's cross-section before any run: regions and materials, water, supports, loads, the
// motion, the search of the LEM, the MPM's grid and terrain, and the places of faults. Results of
// runs are drawn by the report, the Python module and the page.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/check/check.hpp"

namespace breach::drawing {

/// The scene of a document: the document itself, or a study's scene with the study's overrides for
/// all variants.
struct BaseScene {
    nlohmann::json scene;
    std::vector<std::string> overrides;
    std::string pointer;  ///< of the scene in the document: "" or "/scene"
};
/// Throws BadInput for a study without its scene inside.
BaseScene base_scene_of(const nlohmann::json& document);

/// A scene that was read and checked, with its faults.
struct Draft {
    BaseScene base;  ///< with the overrides applied
    scene::Scene scene;
    std::vector<fault::Fault> faults;  ///< pointers are those of the scene
};
/// `checked`: base.scene with base.overrides, checked by a caller that has access to its files.
Draft draft_of(BaseScene base, check::Checked checked);

/// A FEM's mesh for drawing.
struct DrawnMesh {
    std::vector<mechanics::Vec2> nodes;  ///< [m]
    std::vector<std::array<std::int32_t, 4>> quads;
};

struct Additions {
    std::optional<DrawnMesh> mesh = {};
    std::vector<std::string> foot = {};  ///< lines below the picture: the expected cost
    std::vector<fault::Fault> faults =
        {};  ///< of the study around the scene; pointers into the document
    std::vector<fault::Flag> warnings = {};  ///< likewise
};

/// Whether there is a region with a polygon, or a fault with a place.
bool can_be_drawn(const Draft& draft);

/// One SVG without script or style sheet, on white. Each region is one path of class "region". Each
/// fault is marked in red at its places and listed, with its pointer into the document in the
/// attribute data-pointer. Needs can_be_drawn.
std::string as_svg(const Draft& draft, const Additions& additions);

}  // namespace breach::drawing
