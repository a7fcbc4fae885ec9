#include "core/materials/norsand/undrained.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace breach::materials::norsand {

double plane_shear(const State& state) { return std::hypot(0.5 * (state.xx - state.yy), state.xy); }
double simple_shear(const State& state) { return std::abs(state.xy); }

namespace {

constexpr double first_step = 1e-4, growth = 1.05, largest_step = 5e-3;  // strain
constexpr double farthest = 0.3, past = 0.9;                             // strain; of the peak
constexpr double error = 0.01;  // more than the integration's; of the peak, of critical strength
constexpr double still = 1e-3;  // of the shear stress, in a step

/// A state on its path.
struct Sheared {
    Voigt along;  ///< unit strain
    double now;   ///< shear stress
    double most, peak = now;
    double least = std::numeric_limits<double>::infinity();  ///< after a fall
    double step = first_step, gone = 0.0;
    bool falls = false;   ///< past its peak: what it regains counts no more
    bool stands = false;  ///< its last step was no fall

    bool goes_on() const { return gone < farthest && (falls ? !stands : peak < most); }
    void goes_to(double shear) {
        falls = falls || shear < past * peak;
        stands = shear > (1.0 - still) * now;
        now = shear;
        if (!falls) peak = std::max(peak, now);
        if (now < (1.0 - error) * peak) least = std::min(least, now);
        step = std::min(growth * step, largest_step);
        gone += step;
    }
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
            sheared.goes_to(way.shear(at[i]));
            if (sheared.goes_on()) going[left++] = i;
        }
        going.resize(left);
    }
    std::vector<UndrainedStrength> found;
    for (std::size_t i = 0; i < states.size(); ++i) {
        const Sheared& path = ways[i];
        const double p_c = std::max(critical_pressure(law, states[i].e), law.parameters.p_min);
        const double held = std::max(std::min(path.peak, path.most), way.shear(states[i]));
        const double critical = std::min({ratio * p_c, path.most, held});
        // Soil that turns below its critical state dilates afterwards, where it is not relied on.
        // A path at the law's least p' turns nowhere.
        const bool turned = path.least < (1.0 - error) * critical && !at[i].on_floor;
        found.push_back({held, turned ? path.least : critical});
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
