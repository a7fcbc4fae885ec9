// The result: the least valid factor of safety of all analysed surfaces, with its method and
// surface.
// Used for the sound slope (analysis.cpp) and for each stage of liquefaction (stages.cpp).
#pragma once

#include <nlohmann/json.hpp>

#include "lem_tool/crack.hpp"

namespace breach::lem {

/// The critical circle of the search, and one composite surface for each thin weak layer.
/// Families are searched by Bishop's method, whose factor needs no search for an inclination;
/// Spencer's is computed on the best of each.
struct Families {
    Searched circles;
    std::vector<Searched> composites;  ///< those found

    /// The one with the least factor by Bishop's method.
    const Searched& least() const;
};
Families search_families(const scene::Scene& scene, const Model& model,
                         const scene::SlipSearch& ranges, int threads);

/// The given circle, without search. Throws BadInput if it has no factor of safety.
Families given_family(const scene::Scene& scene, const Model& model);

/// "the critical circle" for a surface's name in the result.
std::string in_words(const std::string& surface);

nlohmann::json facts_of(const Searched& searched);

/// The facts of all analysed surfaces by name: "bishop", "composite", "non_circular" of the search,
/// and the entries of `given`; and those of the least valid one, with "factor_of_safety", "method"
/// and "surface".
nlohmann::json answer(const scene::Scene& scene, const Families& families,
                      const nlohmann::json& given = nlohmann::json::object());

/// Flags a thick weak layer if a polyline through it has a factor more than 3 % below that of
/// circles and the scene requests no polyline. That search takes some tenths of a second.
std::vector<fault::Flag> flags_of_weak_layer(const scene::Scene& scene, const Families& families,
                                             const nlohmann::json& answer);

/// Flags for lower factors that are not valid.
std::vector<fault::Flag> flags_of_answer(const nlohmann::json& answer, const scene::Lem& lem);

}  // namespace breach::lem
