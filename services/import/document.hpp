// Builds a scene document from healed soils and lines, with a list of guessed entries.
#pragma once

#include <nlohmann/json.hpp>

#include "services/import/guess.hpp"

namespace breach::importing {

/// Lines of the section, from left to right; empty: missing in the drawing.
struct Lines {
    std::vector<Vec2> phreatic, terrain, ground;
};

struct Document {
    nlohmann::json scene;
    nlohmann::json study = nullptr;  ///< of static liquefaction, without the scene; else null
    nlohmann::json guessed;          ///< [{pointer, value, from}]
    std::vector<std::string> remarks;
    std::optional<Slope> slope;
};

/// The materials of a scene, or of a document that contains only materials.
const nlohmann::json& materials_in(const nlohmann::json& document);

/// given: the document with the materials. Always writes /section; /lem if the ground has a slope;
/// /mpm if there is a terrain, with cells of this share of an element.
Document document_of(const std::string& name, const nlohmann::json& given,
                     const std::vector<Soil>& soils, const Lines& lines, double share = 1.0);

nlohmann::json as_json(const Vec2& place);
nlohmann::json as_json(const std::vector<Vec2>& line);

}  // namespace breach::importing
