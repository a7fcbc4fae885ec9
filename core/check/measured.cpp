#include "core/check/measured.hpp"

#include <algorithm>

#include "core/check/section.hpp"

namespace breach::check {

namespace {

/// Tests the laws that the FEM uses; the MPM may use others for the same soil.
bool some_soil(const scene::Scene& scene, bool (*is)(const materials::Law&)) {
    return std::ranges::any_of(scene.section.regions, [&](const scene::Region& region) {
        const scene::Material* material = material_of(scene, region);
        return material && is(material->law);
    });
}

bool softens(const materials::Law& law) { return materials::softening(law) != nullptr; }

}  // namespace

std::optional<NotMeasured> why_not_measured(const scene::Scene& scene, telemetry::Needs needs) {
    using enum telemetry::Needs;
    if (needs == softening && !some_soil(scene, softens))
        return NotMeasured{"no soil of the FEM loses strength by softening",
                           "give a law with softening, or ask for another column"};
    if ((needs == state_parameter || needs == looks_at_strength) &&
        !some_soil(scene, materials::has_state_parameter))
        return NotMeasured{"no soil of the FEM is of the law " +
                               materials::types_of_laws_that(materials::has_state_parameter),
                           "give a region that law, or ask for another column"};
    if (needs == looks_at_strength && !scene.fem->strength_interval)
        return NotMeasured{"the strength is not used", "say in /fem/strength_interval how often"};
    if (needs == damping && !(scene.fem->rayleigh_stiffness > 0.0))
        return NotMeasured{"the FEM is not damped", "give /fem/damping, or ask for another column"};
    if (needs == water && !scene.fem->water)
        return NotMeasured{"the scene has no pore water",
                           "give /fem/water, or ask for another column"};
    if (needs == watched_ground && !(scene.fem->water && scene.fem->liquefaction))
        return NotMeasured{"no soil is watched", "say in /fem/liquefaction which soil can liquefy"};
    return std::nullopt;
}

std::vector<fault::Fault> unmeasured(const std::vector<std::string>& fields,
                                     const scene::Scene& scene, const std::string& pointer) {
    std::vector<fault::Fault> found;
    for (const std::string& field : fields) {
        const telemetry::Column* column = telemetry::column_named(field);
        const auto why = column ? why_not_measured(scene, column->needs) : std::nullopt;
        if (!why) continue;
        found.push_back(
            {pointer, "asks for " + field + ", which is not measured: " + why->cause, why->remedy});
    }
    return found;
}

}  // namespace breach::check
