// Healed soils and lines as a scene document, with the guessed entries.
#pragma once

#include <nlohmann/json.hpp>

#include "services/import/guess.hpp"

namespace breach::importing {

/// Lines of the section, from left to right; empty: not drawn.
struct Lines {
    std::vector<Vec2> phreatic, terrain, ground;
};

struct Document {
    nlohmann::json scene;
    nlohmann::json guessed;  ///< [{pointer, value, from}]
    std::vector<std::string> remarks;
    std::optional<Slope> slope;
};

/// The materials of a scene, or of a document that is nothing but materials.
const nlohmann::json& materials_in(const nlohmann::json& document);

/// given: what materials_in reads. Always /section; /lem if the ground has a slope; /mpm if a terrain was drawn, with cells of this
/// share of an element.
Document document_of(const std::string& name, const nlohmann::json& given,
                     const std::vector<Soil>& soils, const Lines& lines, double share = 1.0);

nlohmann::json as_json(const Vec2& place);

}  // namespace breach::importing
