// A block of soil with yield strength c and viscosity eta that slumps over a rough floor, slowly
// and far: its front and middle against lubrication theory (Bingham fluid in a thin layer). The
// layer is not thin in the first seconds, so displacements from 30 s on are compared, with four to
// five cells over the depth.
#include <algorithm>
#include <cmath>

#include "mpm_solver/measure/runout.hpp"
#include "tests/unit/mpm/bodies.hpp"
#include "tests/verification/mpm/report.hpp"

namespace breach::mpm::test::bingham_slump_test {
namespace {

constexpr double rho = 1800.0;
constexpr double g = 9.81;
constexpr double c = 1e3;
constexpr double eta = 2e4;
constexpr double length = 24.0;
constexpr double height = 4.0;
constexpr double width = 88.0;
constexpr double from = 30.0;
constexpr double to = 100.0;

/// x of 50 and 99 % of the soil [m].
struct Reach {
    double half;
    double front;
};

/// dh/dt + dq/dx = 0 with q = G Y^2 (3 h - Y) / (6 eta), G = rho g |dh/dx|; the layer below Y = h -
/// c / G is sheared. Explicit, on cells of 0.1 m.
class ThinLayer {
  public:
    ThinLayer() : h_(static_cast<std::size_t>(width / dx), 0.0), q_(h_.size() + 1, 0.0) {
        std::fill_n(h_.begin(), static_cast<std::size_t>(length / dx), height);
    }

    void advance(double duration) {
        const double D = rho * g * std::pow(height, 3) / (3.0 * eta);
        const auto steps = static_cast<int>(std::ceil(duration / (0.2 * dx * dx / D)));
        for (int k = 0; k < steps; ++k) step(duration / steps);
    }

    Reach reach() const { return {within(0.5), within(0.99)}; }

  private:
    void step(double dt) {
        for (std::size_t i = 1; i < h_.size(); ++i) {
            const double slope = (h_[i] - h_[i - 1]) / dx;
            const double G = rho * g * std::abs(slope);
            const double h = 0.5 * (h_[i] + h_[i - 1]);
            const double Y = G * h > c ? h - c / G : 0.0;
            q_[i] = -std::copysign(G * Y * Y * (3.0 * h - Y) / (6.0 * eta), slope);
        }
        for (std::size_t i = 0; i < h_.size(); ++i) h_[i] -= dt / dx * (q_[i + 1] - q_[i]);
    }
    double within(double share) const {
        double left = share * length * height;
        std::size_t i = 0;
        while (left > h_[i] * dx) left -= h_[i++] * dx;
        return dx * (static_cast<double>(i) + left / (h_[i] * dx));
    }

    static constexpr double dx = 0.1;
    std::vector<double> h_, q_;
};

Reach reach_of(const Points& points) {
    const Runout runout = runout_of(points, {1}, 0.0);
    return {runout.beyond_50, runout.all};
}

TEST(BinghamSlump, RunsAsLubricationSays) {
    scene::Scene scene = one_soil(sand(1e7, 0.49, c, 0.0), rho, rectangle(0.0, 0.0, length, height),
                                  0.8, width, 4.8);
    scene.gravity = g;
    scene.materials[0].viscosity = eta;
    scene.mpm->left = scene::Wall::roller;
    scene.mpm->floor.friction[0].coefficient = 5.0;
    scene.mpm->blending_rate = 0.1;
    scene.mpm->cfl = 0.8;
    scene.mpm->fill_points = 4;
    scene.mpm->fill_stress = scene::FillStress::overburden;
    Body body = filled_body(scene);
    ThinLayer layer;
    advance(body, scene, from);
    layer.advance(from);
    const Reach begin = reach_of(body.points), layer_begin = layer.reach();
    advance(body, scene, to - from);
    layer.advance(to - from);
    const Reach end = reach_of(body.points), layer_end = layer.reach();
    std::printf("    at %.0f s: half within %.2f m (thin layer %.2f), front at %.2f m (%.2f)\n", to,
                end.half, layer_end.half, end.front, layer_end.front);
    expect_error_within("front at the end / thin layer - 1", end.front / layer_end.front - 1.0,
                        0.05);
    expect_error_within("its way from 30 to 100 s / thin layer - 1",
                        (end.front - begin.front) / (layer_end.front - layer_begin.front) - 1.0,
                        0.10);
    expect_error_within("way of the middle / thin layer - 1",
                        (end.half - begin.half) / (layer_end.half - layer_begin.half) - 1.0, 0.10);
}

}  // namespace
}  // namespace breach::mpm::test::bingham_slump_test
