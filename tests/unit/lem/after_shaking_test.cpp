// lem_tool on a snapshot: where its soil has not liquefied, and where all of it has, the factor is
// that of the same section with these strengths in the scene.
#include "lem_tool/after_shaking.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "core/exchange/temporary_folder.hpp"
#include "core/fault/fault.hpp"
#include "lem_tool/snapshot_strength.hpp"
#include "small_scenes.hpp"

namespace breach::lem {
namespace {

using nlohmann::json;
using scene::Vec2;

constexpr int columns = 12, rows = 6;
const std::string peak = R"({"type": "undrained", "s_u_kPa": 40})";
const std::string residual = R"({"type": "undrained", "s_u_kPa": 15})";

/// The slope of small::two_layers; its fill is of a material with this strength, 0: two strengths.
json slope(const std::string& alone = {}) {
    json scene = small::two_layers(small::some_search());
    json& fill = scene["materials"]["fill"];
    fill["law"].erase("c_kPa");
    fill["law"].erase("phi_deg");
    fill["strength"] = alone.empty()
                           ? json{{"peak", json::parse(peak)}, {"residual", json::parse(residual)}}
                           : json{{"peak", json::parse(alone)}};
    return scene;
}

/// The fill as a mesh of quads that follows the slope; r_u_max by element.
exchange::MeshSnapshot mesh_of_fill(const std::function<double(const Vec2&)>& r_u) {
    exchange::MeshSnapshot mesh;
    mesh.time = 4.0;
    mesh.regions = {"fill"};
    mesh.materials_of_regions = {"fill"};
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= columns; ++i) {
            const double y = 10.0 * j / rows;
            mesh.position_0.emplace_back((40.0 - 2.0 * y) * i / columns, y);
        }
    const std::size_t nodes = mesh.position_0.size();
    for (auto* field : {&mesh.displacement, &mesh.velocity, &mesh.acceleration})
        field->assign(nodes, Vec2::Zero());
    mesh.nodal_mass.assign(nodes, 1.0);
    for (auto* field : {&mesh.pore_pressure, &mesh.pore_pressure_0, &mesh.excess_pressure_max})
        field->assign(nodes, 0.0);
    mesh.sigma_v0.assign(nodes, 100e3);
    mesh.gauss_per_element = 1;
    mesh.gauss_positions = {Vec2::Zero()};
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            const int n = j * (columns + 1) + i;
            mesh.quads.push_back({n, n + 1, n + columns + 2, n + columns + 1});
            mesh.region_of_element.push_back(0);
            mesh.density.push_back(2000.0);
            const Vec2 centre =
                liquefied::undeformed_corners(mesh, mesh.quads.size() - 1).rowwise().mean();
            mesh.r_u_max.push_back(r_u(centre));
        }
    const std::size_t points = mesh.quads.size();
    mesh.shear_strain_max.assign(points, 0.0);
    for (auto* field : {&mesh.stress, &mesh.strain})
        field->assign(points, mechanics::Voigt::Zero());
    for (auto* field : {&mesh.epsilon_q, &mesh.epsilon_q_plastic}) field->assign(points, 0.0);
    return mesh;
}

scene::Scene with_transfer(const json& text) {
    scene::Scene scene = small::parsed(text);
    scene.transfer = scene::Transfer{.points_per_direction = 2,
                                     .interpolation = scene::Interpolation::local,
                                     .neighbours = 40,
                                     .largest_mass_loss = 1.0,
                                     .largest_momentum_loss = 1.0};
    scene.transfer->liquefied = scene::LiquefiedZone{.regions = {1},
                                                     .r_u = 0.7,
                                                     .when = scene::LiquefiedWhen::ever,
                                                     .by = scene::LiquefiedBy::point,
                                                     .layers = {}};
    return scene;
}

double least_factor(const scene::Scene& scene, const Model& model) {
    return search(model, *scene.lem->search).critical->bishop.factor_of_safety;
}

/// Least factor with the snapshot's strengths.
double factor_where(const std::function<double(const Vec2&)>& r_u) {
    const exchange::TemporaryFolder folder("after_shaking_");
    const auto file = folder.path() / "snapshot_4.000000.vtkhdf";
    exchange::write_mesh_snapshot(file, mesh_of_fill(r_u), {});
    const scene::Scene scene = with_transfer(slope());
    return least_factor(scene, shaken(make_model(scene), scene, file).model);
}

double factor_of(const std::string& strength) {
    const scene::Scene scene = small::parsed(slope(strength));
    return least_factor(scene, make_model(scene));
}

TEST(AfterShaking, SoundSoilHasItsPeakAndLiquefiedSoilItsResidualStrength) {
    EXPECT_NEAR(factor_where([](const Vec2&) { return 0.2; }), factor_of(peak), 1e-9);
    EXPECT_NEAR(factor_where([](const Vec2&) { return 0.9; }), factor_of(residual), 1e-9);
}

TEST(AfterShaking, ALiquefiedPartLowersTheFactorByItsPart) {
    const double sound = factor_of(peak), weak = factor_of(residual);
    const double deep = factor_where([](const Vec2& at) { return at.y() < 3.0 ? 0.9 : 0.2; });
    EXPECT_LT(deep, 0.99 * sound);
    EXPECT_GT(deep, 1.01 * weak);
    // Far behind the surfaces nothing changes.
    EXPECT_NEAR(factor_where([](const Vec2& at) { return at.x() < 1.0 ? 0.9 : 0.2; }), sound, 1e-9);
}

TEST(AfterShaking, APlaceHasTheStrengthOfItsElement) {
    const auto mesh = mesh_of_fill([](const Vec2& at) { return at.y() < 5.0 ? 0.9 : 0.2; });
    const scene::Scene scene = with_transfer(slope());
    const SnapshotStrength strength(mesh, liquefied::SoilMap(mesh, scene, "mesh"));
    EXPECT_EQ(strength.at({10.0, 4.9})->c, 15e3);
    EXPECT_EQ(strength.at({10.0, 5.1})->c, 40e3);
    EXPECT_EQ(strength.at({29.9, 5.01})->c, 40e3) << "just inside the face";
    EXPECT_EQ(strength.at({30.1, 5.01}), nullptr) << "just outside it";
    EXPECT_EQ(strength.at({-1.0, 5.0}), nullptr);
    EXPECT_EQ(strength.at({10.0, -0.1}), nullptr) << "the base is not in the mesh";
}

TEST(AfterShaking, ASeriesNamesItsSnapshots) {
    const exchange::TemporaryFolder folder("after_shaking_");
    const auto series = folder.path() / "frames.vtkhdf.series";
    std::ofstream(series)
        << R"({"files": [{"name": "a.vtkhdf", "time": 1}, {"name": "b.vtkhdf"}]})";
    const auto found = snapshots_of(series);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[1], folder.path() / "b.vtkhdf");
    EXPECT_EQ(snapshots_of(found[0]), std::vector{found[0]});
    for (const char* text : {"", "{}", "[1]", R"({"files": [{"time": 1}]})"}) {
        std::ofstream(series, std::ios::trunc) << text;
        EXPECT_THROW(snapshots_of(series), fault::BadInput) << text;
    }
    EXPECT_THROW(snapshots_of(folder.path() / "none.series"), fault::IoError);
}

}  // namespace
}  // namespace breach::lem
