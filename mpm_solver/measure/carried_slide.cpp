// Under "stiffness_scale": "auto" damping is lower than at full stiffness; a block that 5 % more
// friction than critical should have held slid 1.1 m without any flag.
#include "mpm_solver/measure/carried_slide.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/words/number.hpp"

namespace breach::mpm {

namespace {

using words::text_of;

constexpr double least_slide = 0.2;  // cells
constexpr double alike = 0.35;       // share of the slide
constexpr double by_friction = 0.5;  // share of the released energy
// Of friction on the way. Blocks that slide with a coefficient of 0.9 tan theta have 0.01 to 0.04,
// those that waves carry 0.08 to 0.35.
constexpr double least_lack = 0.06;

/// Smallest coefficient of the floor below the mobile soil and its way; infinite: no slip.
double least_friction(const scene::Scene& scene, const Body& body, const FlowView& view,
                      double slide) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (scene.mpm->floor.friction.empty()) return infinity;
    double low = infinity, high = -infinity;
    for (std::size_t p = 0; p < body.points.size(); ++p) {
        if (!view.mobile[body.points.region[p]]) continue;
        low = std::min(low, body.points.x[p]);
        high = std::max(high, body.points.x[p]);
    }
    const Grid& grid = body.grid;
    const auto column = [&](double x) {
        return std::clamp(static_cast<std::int32_t>(grid.xi(x)), 0, grid.columns - 1);
    };
    // The way covers where the soil was before: `slide` upstream of its present ends.
    const auto first = grid.friction.begin() + column(low - std::max(slide, 0.0));
    const auto last = grid.friction.begin() + column(high - std::min(slide, 0.0));
    return *std::min_element(first, last + 1);
}

/// Settings that damp the waves: the scene's stiffness, and a viscosity as large as the time step
/// allows at it; twice the present one if there is already more.
std::string remedy(const scene::Scene& scene, const Body& body, const FlowView& view) {
    const scene::Mpm& mpm = *scene.mpm;
    std::string settings;
    if (mpm.wave_speed_limit || mpm.stiffness_scale != 1.0)
        settings = "--set /mpm/stiffness_scale=1 ";
    const auto mass = [&](const Zone& zone) {
        double sum = 0.0;
        for (std::size_t p = zone.begin; p < zone.end; ++p)
            if (view.mobile[body.points.region[p]]) sum += body.points.m[p];
        return sum;
    };
    const Zone& heaviest = *std::ranges::max_element(body.zones, {}, mass);
    const scene::Material& soil =
        *std::ranges::find(scene.materials, heaviest.material, &scene::Material::name);
    const double viscosity = std::max(
        largest_free_viscosity(materials::elasticity(soil.law), soil.density, mpm.cell_size),
        2.0 * soil.viscosity);
    const double digit = std::pow(10.0, std::floor(std::log10(viscosity)) - 1.0);
    return settings + "--set /materials/" + soil.name +
           "/viscosity=" + text_of(digit * std::round(viscosity / digit), 12);
}

}  // namespace

std::optional<fault::Flag> flag_of_carried_slide(const scene::Scene& scene, const Body& body,
                                                 const FlowView& view, const Travel& travel) {
    const double slide = travel.mean;
    const double energy = released(travel.start, travel.end), friction = travel.end.friction;
    const bool as_one = std::abs(travel.front - slide) < alike * std::abs(slide);
    if (travel.end.shaking != 0.0 || !as_one || std::abs(slide) < least_slide * view.width ||
        !(friction > by_friction * energy))
        return std::nullopt;
    const double mu = least_friction(scene, body, view, slide);
    const double weight = -body.gravity.y() * mass_of(body.points, view.mobile);
    const double lack = 1.0 - friction / (weight * mu * std::abs(slide));
    if (!(lack > least_lack)) return std::nullopt;
    return fault::Flag{
        "carried_slide", fault::Severity::questionable,
        "the soil slid " + text_of(std::abs(slide), 3) +
            " m as one body, and the floor's friction took " + text_of(100.0 * (1.0 - lack), 2) +
            " % of what its coefficient, " + text_of(mu, 3) +
            ", takes on this way: the soil slid while stress waves lifted it. So near the limit of "
            "sliding it needs more damping; compare with " +
            remedy(scene, body, view),
        "/mpm/stiffness_scale"};
}

}  // namespace breach::mpm
