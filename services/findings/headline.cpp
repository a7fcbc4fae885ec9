// One line from a run's governing result. It never gives a distance without its error or the
// words that it is unknown.
#include "services/findings/headline.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/words/number.hpp"
#include "core/words/words.hpp"
#include "services/findings/flags.hpp"

namespace breach::findings {

using nlohmann::json;

static constexpr auto words_of(Outcome) {
    using enum Outcome;
    return words::in_order<Outcome>(
        {{not_known, "not_known"}, {stands, "stands"}, {fails, "fails"}, {flows, "flows"}});
}

namespace {

constexpr int digits = 3;

/// The error is given with two digits, the distance with three. The worst of many samples has no
/// error of its own, so that its absence is not remarked on.
Headline of_soil(const Soil& soil) {
    const std::string where =
        soil.worst_of > 1 ? " in the worst of " + std::to_string(soil.worst_of) + " samples" : "";
    if (soil.stood) return {Outcome::stands, "stands" + where};
    // Short of the toe, "at least" would say the wrong thing: soil that still moves comes nearer to
    // it.
    const bool bound = soil.lower_bound && soil.farthest > 0.0;
    const std::string error = soil.error ? " \u00b1 " + words::text_of(*soil.error, 2) : "";
    const std::string distance =
        (bound ? "\u2265 " : "") + words::text_of(std::abs(soil.farthest), digits) + error + " m ";
    const std::string unknown = soil.error || soil.worst_of > 1 ? "" : " (error not known)";
    if (soil.farthest > 0.0)
        return {Outcome::flows, "flows " + distance + "beyond the toe" + unknown + where};
    return {Outcome::flows, std::string("flows, ends ") + (soil.lower_bound ? "so far " : "") +
                                distance + "short of the toe" + unknown + where};
}

/// Only of runs that analyse stability alone: where a FEM or a runout exists, they decide.
Headline of_factors(double as_built, const std::optional<double>& liquefied) {
    if (as_built < 1.0) return {Outcome::fails, "fails"};
    if (liquefied && *liquefied < 1.0)
        return {Outcome::fails, "stands as built, fails where it liquefies"};
    return {Outcome::stands, "stands"};
}

}  // namespace

/// A runout that never passes the toe has 0 beyond it; runout_largest then says how far upstream it
/// ended (negative).
std::optional<Soil> soil_of(const json& result) {
    const auto number = [&](const char* key) {
        const json value = result.is_object() ? result.value(key, json()) : json();
        return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
    };
    const auto beyond = number("runout_beyond_toe"), largest = number("runout_largest");
    if (!beyond || !largest) return std::nullopt;
    return Soil{.farthest = *beyond > 0.0 ? *beyond : *largest,
                .stood = result.value("stood", false),
                .lower_bound = still_moves(result)};
}

Headline headline_of(const HeadlineFacts& facts) {
    Headline headline;
    if (facts.soil)
        headline = of_soil(*facts.soil);
    else if (facts.stood_in_fem)
        headline = {Outcome::stands, "stands"};
    else if (facts.lem_alone && facts.factor_of_safety)
        headline = of_factors(*facts.factor_of_safety, facts.factor_of_safety_liquefied);
    if (!facts.factor_of_safety) return headline;
    // Factors of safety come after the runout and never change the outcome that it has.
    headline.text += (headline.text.empty() ? "FS " : "; FS ") +
                     words::text_of(*facts.factor_of_safety, digits) + " as built";
    if (facts.factor_of_safety_liquefied)
        headline.text +=
            ", " + words::text_of(*facts.factor_of_safety_liquefied, digits) + " liquefied";
    if (facts.factor_of_safety_post_seismic)
        headline.text += ", " + words::text_of(*facts.factor_of_safety_post_seismic, digits) +
                         " after the shaking";
    return headline;
}

json as_json(const Headline& headline) {
    return {{"outcome", words::name_of(headline.outcome)}, {"text", headline.text}};
}

}  // namespace breach::findings
