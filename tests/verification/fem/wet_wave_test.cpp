// A pressure wave in wet soil: skeleton and water move together, so a column without drainage
// vibrates with the modulus M + K_f / n. Order of convergence of the coupled step in time and mesh.
#include "tests/verification/fem/wet.hpp"

namespace breach::fem::wet_wave_test {
namespace {

using bench::expect_error;
using bench::Steps;
using bench::WetColumn;
using std::numbers::pi;

constexpr double v_top = 1e-3, H = 10.0;
/// Water about as stiff as the skeleton: both matter.
const WetColumn column{.H = H, .K_f = 1e7};

double omega() {
    return 0.5 * pi / H *
           std::sqrt((column.modulus() + column.K_f / column.porosity()) / column.density);
}

/// dp/dt for these velocities in the mesh, S p' = -Q^T v: for v = v_top sin(pi y / 2H) it is a
/// multiple of cos(pi y / 2H), given by any row.
Eigen::VectorXd pressure_rate(const Model& model, const Eigen::VectorXd& v) {
    Eigen::VectorXd shape(static_cast<Eigen::Index>(model.mesh.nodes.size()));
    for (Eigen::Index i = 0; i < shape.size(); ++i) {
        shape[i] = std::cos(0.5 * pi * model.mesh.nodes[static_cast<std::size_t>(i)].y() / H);
    }
    const std::size_t base = nearest_node(model.mesh, {0.0, 0.0});
    double expansion = 0.0, stored = 0.0;
    for (const PorousElement& each : model.water.elements) {
        const Quad& quad = model.mesh.quads[each.element];
        const Eigen::Vector4d Qv = each.Q.transpose() * gather(quad, v);
        Eigen::Vector4d s;
        for (int i = 0; i < 4; ++i) s[i] = shape[quad[i]];
        for (int i = 0; i < 4; ++i) {
            if (static_cast<std::size_t>(quad[i]) != base) continue;
            expansion += Qv[i];
            stored += each.S.row(i) * s;
        }
    }
    return -expansion / stored * shape;
}

struct Wave {
    double top;       ///< displacement of the top [m]
    double pressure;  ///< at the base [Pa]
};

/// Starts undeformed with the velocity of the first mode; to time `end`.
Wave vibrate(const char* element, double k, int rows, int steps, double end) {
    WetColumn wet = column;
    wet.rows = rows;
    wet.element = element;
    Model model = wet.model();
    model.water = bench::water_of(model, {wet.fluid(k)}, H, Vec2::Zero());
    Steps wave(std::move(model), 1e-11);
    wave.newmark = {0.25, 0.5};
    for (std::size_t i = 0; i < wave.model.mesh.nodes.size(); ++i) {
        wave.now.v[static_cast<Eigen::Index>(2 * i + 1)] =
            v_top * std::sin(0.5 * pi * wave.model.mesh.nodes[i].y() / H);
    }
    wave.now.p_rate = pressure_rate(wave.model, wave.now.v);
    wave.advance(end, steps);
    const auto top = static_cast<Eigen::Index>(2 * nearest_node(wave.model.mesh, {0.0, H}) + 1);
    return {wave.now.u[top], wave.p_at(0.0)};
}

/// Observed order of three errors, each with half the spacing of the one before; prints both.
double order(const std::string& what, const double (&error)[3]) {
    const double last = std::log2(error[1] / error[2]);
    std::printf("    %s: errors %.3e %.3e %.3e, orders %.3f %.3f\n", what.c_str(), error[0],
                error[1], error[2], std::log2(error[0] / error[1]), last);
    return last;
}

TEST(WetWave, ConvergesWithOrderTwoInTheMesh) {
    const double end = 2.2 * 2.0 * pi / omega();
    const double top = v_top / omega() * std::sin(omega() * end);
    const double pressure = -column.K_f / column.porosity() * 0.5 * pi / H * top;
    for (const char* element : {"ssp", "bbar"}) {
        double of_u[3], of_p[3];
        for (int k = 0; k < 3; ++k) {
            const Wave wave = vibrate(element, 1e-16, 8 << k, 4096, end);
            of_u[k] = std::abs(wave.top - top) / (v_top / omega());
            of_p[k] = std::abs(wave.pressure / pressure - 1.0);
        }
        const std::string name = element;
        expect_error(name + ": order in the mesh, u: |order - 2|",
                     std::abs(order(name + " u, 8, 16, 32 rows", of_u) - 2.0), 0.1);
        expect_error(name + ": order in the mesh, p: |order - 2|",
                     std::abs(order(name + " p, 8, 16, 32 rows", of_p) - 2.0), 0.1);
    }
}

TEST(WetWave, ConvergesWithOrderTwoInTheTimeStepWhileItDrains) {
    const double end = 2.2 * 2.0 * pi / omega(), k = 1e-2;
    for (const char* element : {"ssp", "bbar"}) {
        const Wave exact = vibrate(element, k, 16, 8192, end);
        const Wave tight = vibrate(element, 1e-16, 16, 8192, end);
        EXPECT_LT(std::abs(exact.pressure), 0.9 * std::abs(tight.pressure)) << "drainage counts";
        double of_u[3], of_p[3];
        for (int n = 0; n < 3; ++n) {
            const Wave wave = vibrate(element, k, 16, 128 << n, end);
            of_u[n] = std::abs(wave.top - exact.top) / (v_top / omega());
            of_p[n] = std::abs(wave.pressure / exact.pressure - 1.0);
        }
        const std::string name = element;
        expect_error(name + ": order in time, u: |order - 2|",
                     std::abs(order(name + " u, 128, 256, 512 steps", of_u) - 2.0), 0.1);
        expect_error(name + ": order in time, p: |order - 2|",
                     std::abs(order(name + " p, 128, 256, 512 steps", of_p) - 2.0), 0.1);
    }
}

}  // namespace
}  // namespace breach::fem::wet_wave_test
