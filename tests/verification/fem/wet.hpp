// Wet columns for tests of pore water: as scenes, and as models that scenes cannot describe.
#pragma once

#include <cmath>
#include <numbers>

#include "fem_solver/model/pore_water.hpp"
#include "fem_solver/solve/step.hpp"
#include "tests/verification/fem/bench.hpp"

namespace breach::fem::bench {

/// A column of quads, wet throughout, drained at the top, in a smooth box.
struct WetColumn {
    double H = 10.0, width = 1.0, E = 1e7, nu = 0.25, k = 1e-5, K_f = 2.2e9, density = 2000.0;
    double gravity = 0.0, void_ratio = 0.8;
    int rows = 20, columns = 1;
    const char* element = "ssp";
    json stages = json::array({{{"type", "static"}, {"name", "gravity"}}});

    double modulus() const { return E * (1 - nu) / ((1 + nu) * (1 - 2 * nu)); }
    double porosity() const { return void_ratio / (1 + void_ratio); }
    /// 1/M + n/K_f: volume of water per volume of soil and pressure [1/Pa].
    double storage() const { return 1.0 / modulus() + porosity() / K_f; }
    /// Initial pressure due to a load of 1 Pa [-].
    double share() const { return 1.0 / (modulus() * storage()); }
    static constexpr double unit_weight = 1000.0 * 9.80665;
    double time_of(double T_v) const { return T_v * H * H * storage() * unit_weight / k; }
    Fluid fluid(double conductivity) const {
        const double mobility = conductivity / unit_weight;
        return {K_f, 1000.0, Vec2(mobility, mobility), porosity()};
    }
    json scene() const {
        json scene = scene_of({.width = width,
                               .height = H,
                               .columns = columns,
                               .rows = rows,
                               .law = {{"type", "linear_elastic"}, {"E_MPa", E / 1e6}, {"nu", nu}},
                               .density = density,
                               .gravity = gravity,
                               .stages = stages});
        scene["materials"]["soil"]["void_ratio"] = void_ratio;
        scene["materials"]["soil"]["permeability"] = {k, k};
        scene["fem"]["element"] = element;
        scene["fem"]["water"] = {{"line", {{0, H}}}, {"bulk_modulus_MPa", K_f / 1e6}};
        scene["fem"]["force_tolerance"] = 1e-10;
        return scene;
    }
    Model model() const { return model_of(parse(scene())); }
};

/// Water of one fluid per zone in all elements; p = 0 from `level` up.
inline PoreWater water_of(const Model& model, std::vector<std::optional<Fluid>> fluids,
                          double level, const Vec2& body) {
    Wetness wetness{.fluids = std::move(fluids),
                    .wet = std::vector<bool>(model.mesh.quads.size(), true),
                    .prescribed = {},
                    .body = body};
    for (const Vec2& x : model.mesh.nodes) {
        wetness.prescribed.push_back(x.y() > level - 1e-9 ? std::optional<double>(0.0)
                                                          : std::nullopt);
    }
    return build_pore_water(model, std::move(wetness));
}

/// Steps of a model without analysis.
struct Steps {
    Model model;
    Seconds seconds;
    Newton newton;
    Prediction prediction;
    Motion now, trial;
    double time = 0.0;
    Newmark newmark{4.0 / 9, 5.0 / 6};

    explicit Steps(Model built, double tolerance = 1e-10)
        : model(std::move(built)),
          newton(model, Solved::motion_and_pressure, {tolerance, 20}, Symmetry::symmetric, seconds),
          prediction(prediction_for(model)),
          now(at_rest(model)),
          trial(now) {}
    Steps(const Steps&) = delete;

    void advance(double end, int steps) {
        const double dt = (end - time) / steps;
        const auto laws = laws_for(model, scene::StageLaws::elastic);
        for (int n = 0; n < steps; ++n) {
            time += dt;
            const auto outcome =
                dynamic_step(newton, model, laws, newmark, {}, dt, time, now, prediction, trial);
            ASSERT_EQ(outcome.end, NewtonOutcome::End::converged);
            std::swap(now, trial);
        }
    }
    void load_top(double H, double q) {
        for (std::size_t i = 0; i < model.mesh.nodes.size(); ++i) {
            if (model.mesh.nodes[i].y() < H - 1e-9) continue;
            model.external_force[static_cast<Eigen::Index>(2 * i + 1)] = -0.5 * q;
        }
    }
    double p_at(double y) const {
        return now.p[static_cast<Eigen::Index>(nearest_node(model.mesh, {0.0, y}))];
    }
};

/// Terzaghi (1925): p / p_0 at height y above an impervious base, drained at H.
inline double terzaghi(double y, double H, double T_v) {
    double p = 0.0;
    for (int m = 0; m < 400; ++m) {
        const double M = 0.5 * std::numbers::pi * (2 * m + 1);
        p += 2.0 / M * std::sin(M * (1.0 - y / H)) * std::exp(-M * M * T_v);
    }
    return p;
}

}  // namespace breach::fem::bench
