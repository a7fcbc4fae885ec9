// Skeleton and pore water: the element against an independent code, Terzaghi's consolidation, the
// drained and undrained limits, a permeability contrast, hydrostatics, refusals.
#include <Eigen/LU>
#include <fstream>
#include <sstream>

#include "tests/verification/fem/wet.hpp"

namespace breach::fem::porous_test {
namespace {

using bench::expect_error;
using bench::Steps;
using bench::terzaghi;
using bench::WetColumn;
using nlohmann::json;

TEST(Terzaghi, AgreesWithOpenSees) {
    const std::string file =
        std::string(BREACH_SHARED) + "/reference/opensees/elements/terzaghi.csv";
    std::ifstream in(file);
    if (!in) GTEST_SKIP() << "no reference at " << file;
    const WetColumn column;  // input of tcl/terzaghi.tcl, with its alpha
    Model model = column.model();
    Fluid fluid = column.fluid(column.k);
    fluid.mobility.setConstant(column.k / 9810.0);
    fluid.alpha = 6e-9;
    fluid.integration = scene::PressureIntegration::one_point;
    model.water = bench::water_of(model, {fluid}, 10.0, Vec2::Zero());
    Steps c(std::move(model));
    const double T_1 = 100.0 * 9.81 / (1e-5 * 12000.0);
    for (int n = 1; n <= 10; ++n) {
        c.load_top(10.0, 0.1 * n * 1e5);
        c.advance(0.1 * n * 1e-5 * T_1, 1);
    }
    std::string line;
    std::getline(in, line);
    double at = 0.0, largest_p = 0.0, largest_u = 0.0;
    while (std::getline(in, line)) {
        std::ranges::replace(line, ',', ' ');
        std::istringstream row(line);
        double T_v, time, y, p, u;
        row >> T_v >> time >> y >> p >> u;
        if (time != at) c.advance(at = time, 200);
        const auto node = static_cast<Eigen::Index>(nearest_node(c.model.mesh, {0.0, y}));
        largest_p = std::max(largest_p, std::abs(c.now.p[node] / 1e3 - p) / 100.0);
        largest_u = std::max(largest_u, std::abs(c.now.u[2 * node + 1] - u));
    }
    expect_error("pressure against OpenSees, over the load (nine times)", largest_p, 1e-6);
    expect_error("settlement against OpenSees [m] (final 8.3e-2)", largest_u, 1e-7);
}

/// OpenSees' hourglass form (docs/reference/methods/up_element.md, section 3), to compare with its
/// numbers.
Matrix2 opensees_form(const Corners& x, double thickness) {
    Gradient natural;
    natural << -0.25, 0.25, 0.25, -0.25, -0.25, -0.25, 0.25, 0.25;
    const Matrix2 J = (natural * x.transpose()).transpose();  // columns d x / d xi, d x / d eta
    const Matrix2 inverse = J.inverse();
    const Vec2 g_1 = J.col(0).normalized(), g_2 = J.col(1).normalized();
    const Matrix2 I =
        4.0 / 3.0 * thickness * J.determinant() * (g_1 * g_1.transpose() + g_2 * g_2.transpose());
    const double a = inverse(0, 0), b = inverse(1, 0), c = inverse(0, 1), d = inverse(1, 1);
    const double ss = 0.25 * (I(0, 0) * b * b + I(0, 1) * a * b + I(1, 1) * a * a);
    const double tt = 0.25 * (I(0, 0) * d * d + I(0, 1) * c * d + I(1, 1) * c * c);
    const double st = 0.25 * (I(0, 0) * b * d + I(0, 1) * (b * c + a * d) + I(1, 1) * a * c);
    Matrix2 H;
    H << ss, -st, -st, tt;
    return H;
}

TEST(CoupledElement, StepsLikeAnIndependentCode) {
    // Design note 10.14 in its own units: one skewed quad, dynamic, damped, with seepage.
    json scene = bench::scene_of(
        {.law = {{"type", "linear_elastic"}, {"E_MPa", 2.6e-3}, {"nu", 0.3}}, .gravity = 0.0});
    scene["thickness"] = 0.7;
    scene["fem"]["element"] = "ssp";
    scene["fem"]["rayleigh_mass"] = 0.3;
    scene["fem"]["rayleigh_stiffness"] = 0.01;
    scene::Scene parsed = bench::parse(scene);
    parsed.materials[0].density = 2.0;  // no soil: set after the checks
    Model model = bench::model_of(parsed);
    Corners x;
    x << 0, 2, 1.8, .1, 0, .2, 1.5, 1;
    Mesh mesh = model.mesh;
    mesh.quads = {{0, 1, 2, 3}};
    mesh.nodes = {x.col(0), x.col(1), x.col(2), x.col(3)};
    model.mesh = mesh;
    Gradients gradients;
    evaluate_ssp(x, 0.7, model.hourglass[0]);
    model.hourglass[0].H = opensees_form(x, 0.7);
    use_centre_only(model.hourglass[0], gradients, model.reference[0]);
    model.constraints = unconstrained(4);
    for (std::size_t d = 0; d < 4; ++d) model.constraints.held[d] = true;
    const Vec2 body(0.5, -9.81);
    const Eigen::Vector4d share = nodal_volumes(x, 0.7);
    for (int i = 0; i < 4; ++i) {
        model.mass.segment<2>(2 * i).setConstant(2.0 * share[i]);
        model.external_force.segment<2>(2 * i) = 2.0 * share[i] * body;
    }
    model.external_force.segment<2>(4) += Vec2(10.0, -20.0);
    const Fluid fluid{.bulk_modulus = 5000.0,
                      .density = 1.0,
                      .mobility = Vec2(0.01, 0.02),
                      .porosity = 0.6 / 1.6,
                      .alpha = 1e-4,
                      .integration = scene::PressureIntegration::one_point};
    model.water =
        build_pore_water(model, {{fluid}, {true}, {std::nullopt, std::nullopt, 0.0, 0.0}, body});
    Steps c(std::move(model), 1e-13);
    c.newmark = {0.3025, 0.6};
    const Motion& now = c.now;
    const double known[3][6] = {{.010128707124, -.012410846542, -.001007468690, .003871149343,
                                 13.644106532947, 8.621758035990},
                                {.041572332033, -.044532140467, .000315100145, .021923946360,
                                 14.860658915408, 9.530678375963},
                                {.138374156448, -.124742131132, .048208649178, .108334859772,
                                 14.511572503212, 9.305530226072}};
    for (int n = 1; n <= 5; ++n) {
        c.advance(0.05 * n, 1);
        const int row = n == 1 ? 0 : n == 2 ? 1 : n == 5 ? 2 : -1;
        if (row < 0) continue;
        double of_u = 0.0, of_p = 0.0;
        for (int i = 0; i < 4; ++i) {
            of_u = std::max(of_u, std::abs(now.u[4 + i] - known[row][i]));
        }
        for (int i = 0; i < 2; ++i) {
            of_p = std::max(of_p, std::abs(now.p[i] - known[row][4 + i]));
        }
        expect_error("step " + std::to_string(n) + ": displacements (twelve decimals)", of_u,
                     2e-12);
        expect_error("step " + std::to_string(n) + ": pressures (twelve decimals)", of_p, 1e-9);
    }
}

TEST(Limits, UndrainedWaterCarriesTheLoadAndDrainedCarriesNone) {
    const double q = 1e5;
    // Low permeability, short: one step of consolidation does not reach the base.
    WetColumn tight{.k = 1e-12};
    Model closed = tight.model();
    closed.water = bench::water_of(closed, {tight.fluid(tight.k)}, tight.H, Vec2::Zero());
    Steps undrained(std::move(closed));
    undrained.load_top(tight.H, q);
    undrained.advance(50.0, 50);
    expect_error("k = 1e-12 m/s: base pressure against q / (1 + n M / K_f)",
                 std::abs(undrained.p_at(0.0) / (q * tight.share()) - 1.0), 1e-3);
    WetColumn open{.k = 1.0};
    Model drains = open.model();
    drains.water = bench::water_of(drains, {open.fluid(open.k)}, open.H, Vec2::Zero());
    Steps drained(std::move(drains));
    drained.load_top(open.H, q);
    drained.advance(50.0, 50);
    const auto top = static_cast<Eigen::Index>(nearest_node(drained.model.mesh, {0.0, open.H}));
    const double settled = q * open.H / open.modulus();
    expect_error("k = 1 m/s: settlement against q H / M",
                 std::abs(-drained.now.u[2 * top + 1] / settled - 1.0), 1e-3);
    expect_error("k = 1 m/s: pressure left over the load", std::abs(drained.p_at(0.0)) / q, 1e-3);
}

TEST(PoreWater, ExistsOnlyWhereTheSoilIsWet) {
    WetColumn column;
    const Model all = column.model();
    EXPECT_EQ(all.unknowns(Solved::motion_and_pressure).pressures(), 2 * column.rows);
    EXPECT_EQ(all.unknowns(Solved::displacement).pressures(), 0);
    json dry = column.scene();
    dry["fem"].erase("water");
    const Model none = bench::model_of(bench::parse(dry));
    EXPECT_FALSE(none.water.any());
    EXPECT_EQ(none.unknowns(Solved::motion_and_pressure).pressures(), 0);
}

TEST(PoreWater, WithoutAnyDrainIsRefused) {
    json scene = WetColumn{}.scene();
    scene["fem"]["water"]["line"] = {{0, 99}};
    EXPECT_NO_THROW(bench::model_of(bench::parse(scene))) << "ponded: the ground has its pressure";
    const Model model = WetColumn{}.model();
    EXPECT_THROW(bench::water_of(model, {WetColumn{}.fluid(1e-5)}, 99.0, Vec2::Zero()),
                 fault::BadInput);
}

TEST(PoreWater, OfASoilWithoutPermeabilityIsRefusedByName) {
    json scene = WetColumn{}.scene();
    scene["materials"]["soil"].erase("permeability");
    try {
        bench::model_of(bench::parse(scene));
        FAIL();
    } catch (const fault::BadInput& fault) {
        EXPECT_EQ(fault.faults().at(0).pointer, "/materials/soil");
    }
}

}  // namespace
}  // namespace breach::fem::porous_test
