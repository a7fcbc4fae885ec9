// Incident waves: a Ricker pulse through a layer over a half-space, and the factor between outcrop
// and upgoing motion.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <numbers>

#include "tests/verification/fem/bench.hpp"

namespace breach::fem::wave_test {
namespace {

using bench::expect_error;
using nlohmann::json;
using std::numbers::pi;

constexpr double H = 20.0, V_s = 200.0, rho = 1900.0, V_rock = 760.0, rho_rock = 2400.0;
constexpr double dt = 1e-3, length = 3.0, f_0 = 2.0, amplitude = 0.1;

double ricker(double t) {
    const double a = std::pow(pi * f_0 * (t - 1.2 / f_0), 2);
    return amplitude * (1.0 - 2.0 * a) * std::exp(-a);
}

/// A shear column over rock, as a scene: all u_y fixed, so both sides have the same motion without
/// ties.
json column(const std::filesystem::path& motion, const char* at, double V_base, double rho_base) {
    const double G = rho * V_s * V_s, nu = 0.3;
    json scene = bench::scene_of(
        {.width = 1.0,
         .height = H,
         .rows = 20,
         .law = {{"type", "linear_elastic"}, {"E_MPa", 2.0 * G * (1 + nu) / 1e6}, {"nu", nu}},
         .density = rho,
         .gravity = 0.0,
         .stages = {{{"type", "dynamic"},
                     {"name", "pulse"},
                     {"laws", "elastic"},
                     {"duration", length},
                     {"time_step", dt}}}});
    json& fem = scene["fem"];
    for (int side = 0; side < 2; ++side) fem["supports"][side]["fixes"] = "y";
    fem["element"] = "ssp";
    fem["newmark_beta"] = 0.25;
    fem["newmark_gamma"] = 0.5;
    fem["telemetry_interval"] = 0.0;
    fem["force_tolerance"] = 1e-10;
    fem["crest"] = {0, H};
    fem["base"] = {{"density", rho_base}, {"V_s", V_base}, {"motion_at", at}};
    fem["motion"] = {{"file", motion.string()}};
    return scene;
}

struct Histories {
    std::vector<double> surface, base;
};

/// The pulse as a file that a scene can name.
std::filesystem::path pulse_in(const bench::Folder& folder) {
    const auto file = folder.path() / "pulse.csv";
    std::ofstream out(file);
    out << "time_s,velocity_m_s\n" << std::setprecision(17);
    for (int i = 0; i <= std::lround(length / dt); ++i)
        out << i * dt << ',' << ricker(i * dt) << '\n';
    return file;
}

/// The phase runs the scene; a second run monitors the base, whose velocity follows from the
/// radiation.
Histories shake(const char* at, double V_base, double rho_base) {
    const bench::Folder folder;
    const auto file = pulse_in(folder);
    const auto velocity = [&](double level) {
        json scene = column(file, at, V_base, rho_base);
        scene["fem"]["crest"] = {0, level};
        bench::Run run(scene);
        const Course& a = run.go();
        // Displacement history by the trapezoidal rule's inverse: the scheme's own velocity.
        std::vector<double> v{0.0};
        double before = 0.0;
        for (std::size_t n = 1; n < a.history.size(); ++n) {
            const double u = a.history[n].crest_dx;
            v.push_back(2.0 * (u - before) / dt - v.back());
            before = u;
        }
        return v;
    };
    return {velocity(H), velocity(0.0)};
}

/// Exact: surface and base velocity of a layer over a half-space as sums of delayed pulses. With R
/// = (1 - a) / (1 + a), a = impedance ratio, an outcrop pulse v gives v_surface(t) = 2 / (1 + a)
/// sum R^n ... of both travel directions.
double exact_surface(double t, double a) {
    const double travel = H / V_s, T = 1.0 / (1.0 + a), R = (1.0 - a) / (1.0 + a);
    // The upgoing wave v/2 is transmitted with 2/(1 + a), doubled at the surface, and reflected at
    // the base with -R (softer over stiffer).
    double v = 0.0, strength = 2.0 * T;
    for (int n = 0; n < 60; ++n, strength *= -R) v += strength * ricker(t - (2 * n + 1) * travel);
    return v;
}

double exact_base(double t, double a) {
    const double travel = H / V_s, T = 1.0 / (1.0 + a), R = (1.0 - a) / (1.0 + a);
    double v = T * ricker(t), strength = T * (1.0 - R);
    for (int n = 1; n < 60; ++n, strength *= -R) v += strength * ricker(t - 2 * n * travel);
    return v;
}

template <class Exact>
double relative_l2(const std::vector<double>& reached, Exact exact) {
    double difference = 0.0, norm = 0.0;
    for (std::size_t n = 0; n < reached.size(); ++n) {
        const double v = exact(dt * static_cast<double>(n));
        difference += (reached[n] - v) * (reached[n] - v);
        norm += v * v;
    }
    return std::sqrt(difference / norm);
}

TEST(RickerPulse, PassesALayerOverAHalfSpace) {
    const double a = rho * V_s / (rho_rock * V_rock);
    const Histories h = shake("outcrop", V_rock, rho_rock);
    // OpenSees on the same mesh and step: 1.7e-3 at the surface, 1.4e-3 at the base.
    expect_error("surface velocity, relative L2 against the exact transfer",
                 relative_l2(h.surface, [&](double t) { return exact_surface(t, a); }), 3e-3);
    expect_error("base velocity, relative L2 against the exact transfer",
                 relative_l2(h.base, [&](double t) { return exact_base(t, a); }), 3e-3);
}

TEST(RickerPulse, PassesAStageWithARampThatBringsNothing) {
    const bench::Folder folder;
    const auto file = pulse_in(folder);
    json scene = column(file, "outcrop", V_rock, rho_rock);
    bench::Run whole(scene);
    json& stages = scene["fem"]["stages"];
    stages.push_back(stages[0]);
    stages[0]["duration"] = 0.65;
    stages[1]["duration"] = length - 0.65;
    stages[1]["name"] = "on";
    stages[1]["ramp"] = 1.0;
    bench::Run split(scene);
    const auto& one = whole.go().history;
    const auto& two = split.go().history;
    double apart = 0.0, largest = 0.0;
    for (const Reading& each : two) {
        const auto same = std::ranges::find_if(
            one, [&](const Reading& of) { return std::abs(of.time - each.time) < 0.1 * dt; });
        ASSERT_NE(same, one.end());
        apart = std::max(apart, std::abs(each.crest_dx - same->crest_dx));
        largest = std::max(largest, std::abs(same->crest_dx));
    }
    expect_error("crest of a split run with a ramp, over the largest", apart / largest, 1e-7);
}

TEST(RickerPulse, LeavesThroughABaseOfTheSameRock) {
    const Histories h = shake("outcrop", V_s, rho);
    expect_error("surface is the outcrop motion, H / V_s later",
                 relative_l2(h.surface, [](double t) { return ricker(t - H / V_s); }), 3e-3);
    const Histories twice = shake("upgoing", V_s, rho);
    double error = 0.0;
    for (std::size_t n = 0; n < h.surface.size(); ++n) {
        error = std::max(error, std::abs(twice.surface[n] - 2.0 * h.surface[n]));
    }
    expect_error("the same numbers as up-going motion: twice as much [m/s]", error, 1e-12);
}

}  // namespace
}  // namespace breach::fem::wave_test
