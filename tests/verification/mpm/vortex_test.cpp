// A manufactured solution, the generalised vortex: a ring shears between its two fixed edges under
// the necessary body force. The computed motion must converge to the prescribed one with the cells.
#include "core/grid/kernel.hpp"
#include "tests/unit/mpm/bodies.hpp"
#include "tests/verification/mpm/report.hpp"

namespace breach::mpm::test::vortex_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double E = 1e6;       // [Pa]
constexpr double nu = 0.3;      // [-]
constexpr double rho = 1000.0;  // [kg/m3]
constexpr double G = E / 2.0 / (1.0 + nu);
constexpr double inner = 0.75;  // edges of the ring [m]
constexpr double outer = 1.25;
const mechanics::Vec2 centre{1.5, 1.5};

/// Every point keeps its radius R and rotates by the angle g(t) h(R), g = A sin(pi t), h = (1 - 4
/// s^2)^2, s = (R - R_m) / (R_o - R_i): h and h' vanish at both edges (de Vaucorbeil et al. 2020,
/// with a smaller rotation). The published solution is for a neo-Hookean solid. Ours is rate-type:
/// the stress rotates with the spin and grows by 2 G dev D. A point's shear strain is gamma = R g
/// h'; its velocity gradient in the rotating frame (e_r, e_theta) is pure shear of rate d gamma /
/// dt in e_theta, for which the law gives (tr D = 0)
///     s_r_theta = G sin gamma,  s_theta_theta = -s_rr = G (1 - cos gamma).
/// It softens beyond gamma = pi / 2, where no solution is stable; A = 0.1 stays at 0.63.
struct Vortex {
    double A;

    struct Profile {
        double h, dh, ddh;
    };
    static Profile profile(double R) {
        const double per_width = 1.0 / (outer - inner);
        const double s = (R - 0.5 * (inner + outer)) * per_width;
        const double b = 1.0 - 4.0 * s * s;
        return {b * b, -16.0 * s * b * per_width, (-16.0 + 192.0 * s * s) * per_width * per_width};
    }
    double g(double t) const { return A * std::sin(pi * t); }
    double dg(double t) const { return A * pi * std::cos(pi * t); }
    double ddg(double t) const { return -A * pi * pi * std::sin(pi * t); }

    static mechanics::Vec2 turned(const mechanics::Vec2& r, double angle) {
        const double c = std::cos(angle);
        const double s = std::sin(angle);
        return {c * r.x() - s * r.y(), s * r.x() + c * r.y()};
    }
    mechanics::Vec2 place(const mechanics::Vec2& X, double t) const {
        const mechanics::Vec2 from_centre = X - centre;
        const double angle = g(t) * profile(from_centre.norm()).h;
        return centre + turned(from_centre, angle);
    }
    mechanics::Vec2 velocity(const mechanics::Vec2& x, double t) const {
        const mechanics::Vec2 r = x - centre;
        const double R = r.norm();
        if (R <= inner || R >= outer) return {0.0, 0.0};
        return dg(t) * profile(R).h * mechanics::Vec2{-r.y(), r.x()};
    }
    /// b = a - div sigma / rho [m/s2].
    mechanics::Vec2 body_force(const mechanics::Vec2& x, double t) const {
        const mechanics::Vec2 from_centre = x - centre;
        const double R = from_centre.norm();
        if (R <= inner || R >= outer) return {0.0, 0.0};
        const auto [h, dh, ddh] = profile(R);
        const double gamma = R * g(t) * dh;
        const double dgamma = g(t) * (dh + R * ddh);
        const double div_r = -G * std::sin(gamma) * dgamma - 2.0 * G * (1.0 - std::cos(gamma)) / R;
        const double div_theta = G * std::cos(gamma) * dgamma + 2.0 * G * std::sin(gamma) / R;
        const double b_r = -R * h * h * dg(t) * dg(t) - div_r / rho;
        const double b_theta = R * h * ddg(t) - div_theta / rho;
        const mechanics::Vec2 e_r = from_centre / R;
        return b_r * e_r + b_theta * mechanics::Vec2{-e_r.y(), e_r.x()};
    }
    /// In the axes of the plane; zz stays 0.
    mechanics::Voigt stress(const mechanics::Vec2& x, double t) const {
        const mechanics::Vec2 from_centre = x - centre;
        const double R = from_centre.norm();
        const double gamma = R * g(t) * profile(R).dh;
        mechanics::Matrix2 turn;
        turn << from_centre.x(), -from_centre.y(), from_centre.y(), from_centre.x();
        turn /= R;
        mechanics::Matrix2 s;
        s << -G * (1.0 - std::cos(gamma)), G * std::sin(gamma), G * std::sin(gamma),
            G * (1.0 - std::cos(gamma));
        s = (turn * s * turn.transpose()).eval();
        return {s(0, 0), s(1, 1), 0.0, s(0, 1)};
    }
};

struct Errors {
    double displacement;  ///< root mean square over the largest displacement [-]
    double stress;        ///< root mean square over G times the largest strain [-]
};

scene::Scene ring(double h) {
    scene::Scene scene =
        one_soil(elastic(E, nu), rho, rectangle(0.25, 0.25, 2.75, 2.75), h, 3.0, 3.0);
    scene.mpm->fill_points = 2;
    scene.mpm->anti_locking = scene::AntiLocking::off;  // nu = 0.3 does not lock
    return scene;
}

bool in_ring(double x, double y) {
    const double R = std::hypot(x - centre.x(), y - centre.y());
    return R > inner && R < outer;
}

template <class Value>
void keep(std::vector<Value>& values, const std::vector<std::size_t>& kept) {
    if (values.empty()) return;
    std::vector<Value> left;
    for (const std::size_t p : kept) left.push_back(values[p]);
    values.swap(left);
}

/// The ring's points; the nodes outside are fixed, as in the solution.
Body ring_body(const scene::Scene& scene, const Vortex& vortex) {
    exchange::ParticleState state = fill_section(scene).state;
    std::vector<std::size_t> kept;
    for (std::size_t p = 0; p < state.size(); ++p) {
        if (in_ring(state.position[p].x(), state.position[p].y())) kept.push_back(p);
    }
    keep(state.position, kept), keep(state.region, kept);
    for_each_field(state, [&](auto, auto, auto, auto& values) { keep(values, kept); });
    const double d = 1e-6;
    for (std::size_t p = 0; p < state.size(); ++p) {
        const mechanics::Vec2 x = state.position[p];
        state.velocity[p] = vortex.velocity(x, 0.0);
        for (int k = 0; k < 2; ++k) {
            const mechanics::Vec2 dx = d * mechanics::Vec2::Unit(k);
            state.velocity_gradient[p].col(k) =
                (vortex.velocity(x + dx, 0.0) - vortex.velocity(x - dx, 0.0)) / (2.0 * d);
        }
    }
    Body body = make_body(scene, zoned_points(scene, state, "vortex"), "vortex");
    Grid& grid = body.grid;
    for (std::int32_t node = 0; node < grid.nodes(); ++node) {
        const double x = grid.origin.x() + node / grid.rows * grid.h;
        const double y = grid.origin.y() + node % grid.rows * grid.h;
        if (!in_ring(x, y)) grid.conditions[node] |= condition::hold_x | condition::hold_y;
    }
    return body;
}

/// Maps m b of every point to its nodes, with the weights of its momentum.
void add_body_force(Body& body, const Vortex& vortex, double t) {
    Grid& grid = body.grid;
    const GimpKernel kernel(body.gimp_half_size);
    const Points& points = body.points;
    for (std::size_t p = 0; p < points.size(); ++p) {
        const mechanics::Vec2 x{points.x[p], points.y[p]};
        const mechanics::Vec2 f = points.m[p] * vortex.body_force(x, t);
        const auto sx = kernel(grid.xi(x.x()), grid.walls_x);
        const auto sy = kernel(grid.eta(x.y()), grid.walls_y);
        const auto first = static_cast<std::int32_t>(sx.first * grid.rows + sy.first);
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) {
                Lane& node = grid.motion[first + i * grid.rows + j];
                node[2] += sx.N[i] * sy.N[j] * f.x();
                node[3] += sx.N[i] * sy.N[j] * f.y();
            }
        }
    }
}

/// A step like step(), with the body force between the mapping and Newton's law.
void step(Body& body, const Vortex& vortex, double t, double dt) {
    keep_sorted(body);
    clear(body.grid);
    particle_to_grid(body, dt);
    add_body_force(body, vortex, t);
    update_momentum(body, dt);
    grid_to_particle(body, dt);
    update_stress(body, dt);
}

Errors errors_of(const Body& body, const std::vector<mechanics::Vec2>& X, const Vortex& vortex,
                 double t) {
    const Points& points = body.points;
    double displacement = 0.0;
    double stress = 0.0;
    double largest_displacement = 0.0;
    double largest_stress = 0.0;
    for (std::size_t p = 0; p < points.size(); ++p) {
        const mechanics::Vec2 x{points.x[p], points.y[p]};
        const mechanics::Vec2 exact = vortex.place(X[points.number[p]], t);
        displacement += (x - exact).squaredNorm();
        largest_displacement = std::max(largest_displacement, (exact - X[points.number[p]]).norm());
        const mechanics::Voigt sigma = vortex.stress(exact, t);
        const mechanics::Voigt off =
            mechanics::Voigt{points.sxx[p], points.syy[p], points.szz[p], points.sxy[p]} - sigma;
        stress += off.squaredNorm() + off[3] * off[3];
        largest_stress = std::max(largest_stress, sigma.norm());
    }
    const auto n = static_cast<double>(points.size());
    return {std::sqrt(displacement / n) / largest_displacement,
            std::sqrt(stress / n) / largest_stress};
}

/// Up to the largest rotation.
Errors run(double h, const Vortex& vortex) {
    constexpr double end = 0.5;
    const scene::Scene scene = ring(h);
    Body body = ring_body(scene, vortex);
    std::vector<mechanics::Vec2> X(body.points.size());
    for (std::size_t p = 0; p < X.size(); ++p) {
        X[body.points.number[p]] = {body.points.x[p], body.points.y[p]};
    }
    const double steps = std::ceil(end / courant_step(body, scene.mpm->cfl));
    const double dt = end / steps;
    for (int n = 0; n < steps; ++n) step(body, vortex, n * dt, dt);
    return errors_of(body, X, vortex, end);
}

TEST(Vortex, Converges) {
    constexpr Vortex vortex{0.1};  // shear strains up to 0.6
    const Errors coarse = run(1.0 / 16.0, vortex);
    const Errors fine = run(1.0 / 32.0, vortex);
    const double order = std::log2(coarse.displacement / fine.displacement);
    expect_error_within("displacement, h = 1/32 m", fine.displacement, 1.5e-2);
    expect_error_within("stress, h = 1/32 m", fine.stress, 8e-2);
    std::printf("    order of the displacement %.2f, least 1.5 (of stress: %.2f)\n", order,
                std::log2(coarse.stress / fine.stress));
    EXPECT_GE(order, 1.5);
}

}  // namespace
}  // namespace breach::mpm::test::vortex_test
