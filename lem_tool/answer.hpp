// One answer: the least valid factor of safety of all surfaces that were analysed, with its method
// and its surface.
#pragma once

#include <nlohmann/json.hpp>

#include "lem_tool/crack.hpp"

namespace breach::lem {

/// Bishop's circle of the search, and over the line of each thin weak layer.
struct Families {
    Searched circles;
    std::vector<Searched> composites;  ///< those that found a surface

    /// That with the least factor by Bishop's method.
    const Searched& least() const;
};
Families search_families(const scene::Scene& scene, const Model& model,
                         const scene::SlipSearch& ranges, int threads);

/// The given circle in the search's place. Throws BadInput where it has no answer.
Families given_family(const scene::Scene& scene, const Model& model);

/// "the critical circle" for a surface's name in the result.
std::string in_words(const std::string& surface);

/// Everything about the least surface of a family.
nlohmann::json facts_of(const Searched& searched);

/// The facts of all analysed surfaces by name: "bishop", "composite", "non_circular" of the search,
/// and whatever `given` holds. On top those of the least valid one, with "factor_of_safety",
/// "method" and "surface".
nlohmann::json answer(const scene::Scene& scene, const Families& families,
                      const nlohmann::json& given = nlohmann::json::object());

/// Of a scene with a thick weak layer, a surface of straight pieces that nobody asked for: where it has
/// a factor more than 3 % lower, which circles cannot reach. The search costs some tenths of a second.
std::vector<fault::Flag> flags_of_weak_layer(const scene::Scene& scene, const Families& families,
                                             const nlohmann::json& answer);

/// What a reader must know of lower factors that are not valid.
std::vector<fault::Flag> flags_of_answer(const nlohmann::json& answer, const scene::Lem& lem);

}  // namespace breach::lem
