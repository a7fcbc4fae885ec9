#include "core/materials/norsand/undrained.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace breach::materials::norsand {

double plane_shear(const State& state) { return std::hypot(0.5 * (state.xx - state.yy), state.xy); }
double simple_shear(const State& state) { return std::abs(state.xy); }

namespace {

constexpr double first_step = 1e-4, growth = 1.05, largest_step = 5e-3;  // strain
constexpr double farthest = 0.3, past = 0.9;                             // strain; of the peak

/// A state on its path.
struct Sheared {
    Voigt along;  ///< unit strain
    double peak, most;
    double step = first_step, gone = 0.0;

    bool goes_on() const { return gone < farthest && peak < most; }
};

/// Unit strain of a kind of shear, and its shear stress.
struct Way {
    Voigt (*along)(const State&);
    double (*shear)(const State&);
};

Voigt along_deviator(const State& state) {
    const double half = 0.5 * (state.yy - state.xx);  // tension positive, like the strain
    const double size = std::hypot(half, state.xy);
    // Without an in-plane deviator: compression along y.
    const bool turned = size > 1e-7 * (state.xx + state.yy + state.zz);
    return turned ? Voigt(half / size, -half / size, 0.0, -2.0 * state.xy / size)
                  : Voigt(1.0, -1.0, 0.0, 0.0);
}
Voigt along_level(const State&) { return {0.0, 0.0, 0.0, 1.0}; }

constexpr Way in_the_plane{along_deviator, plane_shear};
constexpr Way in_simple_shear{along_level, simple_shear};

/// At the critical state, simple shear and in-plane shear have the same strength.
std::vector<UndrainedStrength> strengths(const Ready& law, const Way& way,
                                         std::span<const State> states,
                                         std::span<const double> bounds) {
    const double theta = plane_critical_angle(law);
    const double ratio = critical_ratio(law, theta) * std::cos(theta) / std::numbers::sqrt3;
    std::vector<Sheared> ways;
    std::vector<std::size_t> going;
    for (std::size_t i = 0; i < states.size(); ++i) {
        ways.push_back({way.along(states[i]), way.shear(states[i]),
                        ratio * std::max(bounds[i], law.parameters.p_min)});
        if (ways[i].goes_on()) going.push_back(i);
    }
    std::vector<State> at(states.begin(), states.end()), from;
    std::vector<Voigt> d_epsilon;
    std::vector<Update> updates;
    while (!going.empty()) {
        from.clear();
        d_epsilon.clear();
        for (const std::size_t i : going) {
            from.push_back(at[i]);
            d_epsilon.push_back(ways[i].step * ways[i].along);
        }
        updates.resize(going.size());
        integrate(law, from, d_epsilon, {}, updates);
        std::size_t left = 0;
        for (std::size_t k = 0; k < going.size(); ++k) {
            if (updates[k].outcome != Outcome::done) continue;
            const std::size_t i = going[k];
            Sheared& sheared = ways[i];
            at[i] = updates[k].state;
            const double shear = way.shear(at[i]);
            if (shear < past * sheared.peak) continue;
            sheared.peak = std::max(sheared.peak, shear);
            sheared.step = std::min(growth * sheared.step, largest_step);
            sheared.gone += sheared.step;
            if (sheared.goes_on()) going[left++] = i;
        }
        going.resize(left);
    }
    std::vector<UndrainedStrength> found;
    for (std::size_t i = 0; i < states.size(); ++i) {
        const auto& [along, peak, most, step, gone] = ways[i];
        const double p_c = std::max(critical_pressure(law, states[i].e), law.parameters.p_min);
        const double held = std::max(std::min(peak, most), way.shear(states[i]));
        found.push_back({held, std::min({ratio * p_c, most, held})});
    }
    return found;
}

}  // namespace

std::vector<UndrainedStrength> undrained_strengths(const Ready& law, std::span<const State> states,
                                                   std::span<const double> bounds) {
    return strengths(law, in_the_plane, states, bounds);
}

UndrainedStrength undrained_strength(const Ready& law, const State& state, double bound) {
    return strengths(law, in_the_plane, {&state, 1}, {&bound, 1}).front();
}

UndrainedStrength simple_shear_strength(const Ready& law, const State& state, double bound) {
    return strengths(law, in_simple_shear, {&state, 1}, {&bound, 1}).front();
}

}  // namespace breach::materials::norsand
