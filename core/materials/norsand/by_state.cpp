// Undrained strength of level ground as a function of place: the law's path in simple shear from
// sigma'_v0, K_0 and psi_0, tabulated once.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/materials/norsand/law.hpp"

namespace breach::materials {

namespace {

constexpr double least_stress = 1e3, most_stress = 1e7;  // ends of the table [Pa]; constant beyond
constexpr int stresses = 41;                             // ten per decade
constexpr double psi_step = 0.005;

/// Position of x in an ascending table: index before it, and share of the interval.
struct Spot {
    std::size_t before;
    double share;
};
Spot spot_in(const std::vector<double>& table, double x) {
    if (table.size() == 1 || x <= table.front()) return {0, 0.0};
    if (x >= table.back()) return {table.size() - 2, 1.0};
    const auto next = std::ranges::upper_bound(table, x) - table.begin();
    const auto i = static_cast<std::size_t>(next) - 1;
    return {i, (x - table[i]) / (table[i + 1] - table[i])};
}

class StrengthByState {
  public:
    /// S, K_0 and the state parameter are those of the law.
    StrengthByState(const NorSand& law, OnPath part);

    /// tau on horizontal planes [Pa]; at most the critical tau at p' + u.
    double operator()(const Place& place, double u) const;

  private:
    /// tau / sigma'_v0 of the path from this vertical effective stress [Pa].
    double ratio_from(double psi, double sigma_v0) const;

    NorSand law_;
    OnPath part_;
    double tau_over_p_;              ///< at critical state
    std::vector<double> psi_;        ///< ascending; one value: psi is constant, or from e_0
    std::vector<double> ln_stress_;  ///< ascending
    std::vector<double> ln_ratio_;   ///< [psi][stress] of tau / sigma'_v0
};

StrengthByState::StrengthByState(const NorSand& law, OnPath part) : law_(law), part_(part) {
    const double theta = norsand::plane_critical_angle(law.ready);
    tau_over_p_ = norsand::critical_ratio(law.ready, theta) * std::cos(theta) / std::numbers::sqrt3;
    if (law.psi_0_profile) {
        const auto by_psi = [](const auto& a, const auto& b) { return a[1] < b[1]; };
        const auto [low, high] = std::ranges::minmax(law.psi_0_profile->points, by_psi);
        const int steps = std::max(1, static_cast<int>(std::ceil((high[1] - low[1]) / psi_step)));
        for (int k = 0; k <= steps; ++k) psi_.push_back(low[1] + (high[1] - low[1]) * k / steps);
    } else {
        psi_ = {law.psi_0.value_or(0.0)};
    }
    const double width = std::log(most_stress / least_stress) / (stresses - 1);
    for (int k = 0; k < stresses; ++k) ln_stress_.push_back(std::log(least_stress) + width * k);
    for (const double psi : psi_)
        for (const double ln_stress : ln_stress_)
            ln_ratio_.push_back(std::log(ratio_from(psi, std::exp(ln_stress))));
}

double StrengthByState::ratio_from(double psi, double sigma_v0) const {
    constexpr double far = 20.0;  // in units of p: more than any u except in deep water
    NorSand law = law_;
    law.psi_0_profile.reset();
    if (!law.e_0) law.psi_0 = psi;
    const double sigma_h0 = K_0(law) * sigma_v0;
    const auto begun = beginning(law, {-sigma_h0, -sigma_v0, -sigma_h0, 0.0});
    const auto found =
        norsand::simple_shear_strength(law.ready, begun.state, far * level_ground_p(law, sigma_v0));
    return (part_ == OnPath::peak ? found.peak : found.residual) / sigma_v0;
}

double StrengthByState::operator()(const Place& place, double u) const {
    const double sigma_v0 = std::max(place.sigma_v0, 0.0);
    // Below the table, the strength is that at its least stress, as p_min limits it.
    const Spot row = spot_in(psi_, psi_at(law_, place));
    const Spot column = spot_in(ln_stress_, std::log(std::max(sigma_v0, least_stress)));
    const auto of_row = [&](std::size_t i) {
        const double* ratios = ln_ratio_.data() + i * ln_stress_.size() + column.before;
        return ratios[0] + column.share * (ratios[1] - ratios[0]);
    };
    double ln_ratio = of_row(row.before);
    if (row.share > 0.0) ln_ratio += row.share * (of_row(row.before + 1) - ln_ratio);
    const double p = level_ground_p(law_, sigma_v0);
    const double most = tau_over_p_ * std::max(p + std::max(u, 0.0), law_.ready.parameters.p_min);
    return std::min(std::exp(ln_ratio) * std::max(sigma_v0, least_stress), most);
}

}  // namespace

UndrainedByPlace undrained_by_place(const NorSand& law, OnPath part) {
    return StrengthByState(law, part);
}

}  // namespace breach::materials
