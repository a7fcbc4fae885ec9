#include "transfer_tool/soils.hpp"

#include <algorithm>

namespace breach::transfer {

using exchange::StressMeasure;

namespace {

void assign_strengths(const SoilMap& map, Points& points) {
    const auto has_profile = [](const SoilOfPoints& soil) { return soil.strength.has_value(); };
    if (std::ranges::none_of(map.soils(), has_profile)) return;
    exchange::StrengthOfPoints& s = points.state.strength;
    for (auto* values : {&s.c, &s.tan_phi, &s.c_residual, &s.tan_phi_residual})
        values->resize(points.state.size());
    for (std::size_t e = 0; e + 1 < points.first.size(); ++e) {
        for (std::size_t p = points.first[e]; p < points.first[e + 1]; ++p) {
            const materials::PointStrength of = map.strength_at(e, points.xi[p]);
            s.c[p] = of.c;
            s.tan_phi[p] = of.tan_phi;
            s.c_residual[p] = of.c_residual;
            s.tan_phi_residual[p] = of.tan_phi_residual;
        }
    }
}

}  // namespace

void assign_soils(const SoilMap& map, Points& points) {
    exchange::ParticleState& s = points.state;
    s.regions.clear();
    s.materials_of_regions.clear();
    for (const SoilOfPoints& soil : map.soils()) {
        s.regions.push_back(soil.region);
        s.materials_of_regions.push_back(soil.material);
        // Without water total and effective stress are equal, and the file does not name a measure.
        if (!s.pore_pressure.empty() || map.water().is_there())
            s.stress_of_regions.push_back(soil.stress);
    }
    for (std::size_t e = 0; e + 1 < points.first.size(); ++e)
        for (std::size_t p = points.first[e]; p < points.first[e + 1]; ++p)
            s.region[p] = map.at(e, points.xi[p]);
    assign_strengths(map, points);
}

void start_at_state(const SoilMap& map, Points& points) {
    for (std::size_t e = 0; e + 1 < points.first.size(); ++e)
        for (std::size_t p = points.first[e]; p < points.first[e + 1]; ++p)
            if (const auto soil = map.state_at(e, points.xi[p]); soil && !soil->collapsed)
                points.state.epsilon_q_plastic[p] = 0.0;
}

std::optional<CollapseReport> collapse_report(const SoilMap& map, const Points& points) {
    CollapseReport report{.epsilon_q = map.collapse().strain()};
    bool any = false;
    for (std::size_t e = 0; e + 1 < points.first.size(); ++e) {
        if (!map.collapses_in(e)) continue;
        any = true;
        report.points += points.first[e + 1] - points.first[e];
        for (std::size_t p = points.first[e]; p < points.first[e + 1]; ++p) {
            const auto soil = map.collapse().at(e, points.xi[p]);
            if (!soil) continue;
            ++report.saturated;
            if (soil->past_line) ++report.past_line;
            if (!soil->collapsed) continue;
            ++report.collapsed;
            report.mass += points.state.mass[p];
        }
    }
    if (!any) return std::nullopt;
    return report;
}

mechanics::Voigt stress_of(const SoilOfPoints& soil, const mechanics::Voigt& sigma_effective,
                           double u, double p) {
    if (soil.stress == StressMeasure::effective) return sigma_effective;
    const double still = soil.stress == StressMeasure::buoyant ? p : 0.0;
    return sigma_effective + (still - u) * mechanics::Voigt(1.0, 1.0, 1.0, 0.0);
}

void settle_stress(const SoilMap& map, Points& points) {
    exchange::ParticleState& s = points.state;
    for (std::size_t p = 0; p < s.size(); ++p)
        s.stress[p] = stress_of(map.soils()[s.region[p]], points.effective_stress[p],
                                s.pore_pressure.empty() ? 0.0 : s.pore_pressure[p],
                                map.still_pressure(s.position[p]));
}

std::vector<SoilShare> shares_of_soils(const SoilMap& map, const exchange::ParticleState& state) {
    std::vector<SoilShare> shares(map.soils().size());
    for (std::size_t i = 0; i < shares.size(); ++i) shares[i].soil = i;
    for (std::size_t p = 0; p < state.size(); ++p) {
        ++shares[state.region[p]].points;
        shares[state.region[p]].mass += state.mass[p];
    }
    std::erase_if(shares, [](const SoilShare& each) { return each.points == 0; });
    return shares;
}

}  // namespace breach::transfer
