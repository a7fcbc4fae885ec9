// Mandel's problem: the pressure first rises above its initial value, then falls; needs full
// coupling of skeleton and water.
#include "tests/verification/fem/wet.hpp"

namespace breach::fem::mandel_test {
namespace {

using bench::expect_error;
using bench::Steps;
using nlohmann::json;
using std::numbers::pi;

constexpr double a = 10.0, height = 2.0, E = 1e7, nu = 0.2, K_f = 2.2e9, n = 0.4;
constexpr double mobility = 1e-5 / 9806.65, force = 1e6;

struct Poroelastic {
    double G = E / (2 * (1 + nu)), K = E / (3 * (1 - 2 * nu));
    double K_u = K + K_f / n;
    double nu_u = (3 * K_u - 2 * G) / (2 * (3 * K_u + G)), B = K_f / n / K_u;
    double c = mobility / (n / K_f + 1 / (K + 4 * G / 3));
    double p_0 = force * B * (1 + nu_u) / (3 * a);
};

/// p / p_0 at x and t (Mandel 1953; Cheng & Detournay 1988, for grains that are incompressible).
double mandel(double x, double t) {
    const Poroelastic soil;
    const double ratio = (1 - nu) / (soil.nu_u - nu);
    double sum = 0.0;
    for (int i = 0; i < 60; ++i) {
        double low = i * pi + 1e-9, high = i * pi + 0.5 * pi - 1e-9;  // of tan(alpha) = ratio alpha
        for (int k = 0; k < 200; ++k) {
            const double middle = 0.5 * (low + high);
            (std::tan(middle) < ratio * middle ? low : high) = middle;
        }
        const double alpha = 0.5 * (low + high), s = std::sin(alpha), o = std::cos(alpha);
        sum += s / (alpha - s * o) * (std::cos(alpha * x / a) - o) *
               std::exp(-alpha * alpha * soil.c * t / (a * a));
    }
    return 2.0 * sum;
}

/// A quarter of the strip between rigid smooth plates; drained at x = a.
Model quarter(const char* element, scene::PressureIntegration integration) {
    json scene =
        bench::scene_of({.width = a,
                         .height = height,
                         .columns = 40,
                         .rows = 4,
                         .law = {{"type", "linear_elastic"}, {"E_MPa", E / 1e6}, {"nu", nu}},
                         .gravity = 0.0});
    json& supports = scene["fem"]["supports"];
    supports.erase(1);
    supports[1]["fixes"] = "y";
    scene["fem"]["element"] = element;
    Model model = bench::model_of(bench::parse(scene));
    std::int32_t plate = -1;
    Wetness wetness{.fluids = {Fluid{.bulk_modulus = K_f,
                                     .density = 1000.0,
                                     .mobility = Vec2(mobility, mobility),
                                     .porosity = n,
                                     .integration = integration}},
                    .wet = std::vector<bool>(model.mesh.quads.size(), true),
                    .prescribed = {},
                    .body = Vec2::Zero()};
    for (std::size_t i = 0; i < model.mesh.nodes.size(); ++i) {
        const Vec2& x = model.mesh.nodes[i];
        wetness.prescribed.push_back(x.x() > a - 1e-9 ? std::optional<double>(0.0) : std::nullopt);
        if (x.y() < height - 1e-9) continue;
        const auto dof = static_cast<std::int32_t>(2 * i + 1);
        if (plate < 0) {
            plate = dof;
        } else {
            tie(model.constraints.master, plate, dof);
        }
    }
    model.external_force[plate] = -force;
    model.water = build_pore_water(model, std::move(wetness));
    return model;
}

TEST(Mandel, PressureRisesAboveItsInitialValueAndFalls) {
    const Poroelastic soil;
    const double T = a * a / soil.c;
    EXPECT_GT(mandel(0.0, 0.05 * T), 1.02) << "the effect is there to be met";
    using scene::PressureIntegration;
    struct Case {
        const char* element;
        PressureIntegration integration;
        const char* name;
    };
    for (const Case& c : {Case{"ssp", PressureIntegration::full, "ssp"},
                          Case{"ssp", PressureIntegration::one_point, "ssp, one point"},
                          Case{"bbar", PressureIntegration::full, "bbar"}}) {
        Steps steps(quarter(c.element, c.integration));
        double worst = 0.0;
        for (const double share : {0.02, 0.05, 0.1, 0.3, 1.0}) {
            steps.advance(share * T, 200);
            for (const double x : {0.0, 2.5, 5.0, 7.5}) {
                const auto node = nearest_node(steps.model.mesh, {x, 0.0});
                const double p = steps.now.p[static_cast<Eigen::Index>(node)] / soil.p_0;
                worst = std::max(worst, std::abs(p - mandel(x, share * T)));
            }
        }
        expect_error(std::string(c.name) + ": largest |p - Mandel| / p_0", worst, 0.01);
    }
}

}  // namespace
}  // namespace breach::fem::mandel_test
