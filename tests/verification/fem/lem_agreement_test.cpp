// LEM and FEM of one section: pore pressure and initial vertical effective stress agree for any
// phreatic line in the mesh.
#include "fem_solver/snapshot.hpp"
#include "lem_tool/search.hpp"
#include "tests/verification/fem/wet.hpp"

namespace breach::fem::lem_agreement_test {
namespace {

using bench::expect_error;
using bench::json;
using bench::WetColumn;

/// A section of 20 m by 10 m in square elements, with the same line in both parts.
json wet_section(const char* element, const char* above, const json& line, double size) {
    const WetColumn section{
        .H = 10.0,
        .width = 20.0,
        .gravity = 9.81,
        .rows = static_cast<int>(10.0 / size),
        .columns = static_cast<int>(20.0 / size),
        .element = element,
        .stages = json::array({{{"type", "static"}, {"name", "gravity"}, {"laws", "elastic"}}})};
    json scene = section.scene();
    scene["materials"]["soil"]["law"] = {
        {"type", "mohr_coulomb"}, {"E_MPa", 10}, {"nu", 0.25}, {"c_kPa", 10}, {"phi_deg", 30}};
    scene["fem"]["water"]["line"] = line;
    scene["fem"]["water"]["above"] = above;
    scene["lem"] = {{"circle", {{"center", {10, 30}}, {"radius", 25}}},
                    {"water", {{"line", line}}}};
    return scene;
}

/// Stresses of the LEM at a slice's base [Pa].
struct AtBase {
    double u, sigma_v0;
};

AtBase lem_at(const lem::Model& model, const Vec2& at) {
    const lem::Strata& strata = model.strata;
    const lem::Strip& strip = strata.strips[lem::strip_at(strata, at.x())];
    std::size_t k = strip.first;
    while (k + 1 < strip.last && strata.layers[k + 1].top.at(at.x()) > at.y()) ++k;
    const lem::Layer& layer = strata.layers[k];
    const double total =
        layer.weight_above.at(at.x()) + layer.gamma * (layer.top.at(at.x()) - at.y());
    const std::size_t line = *model.soils[layer.region].line;
    const double u = strata.pressures[strip.pressures + line].at(at.x(), at.y());
    return {u, total - u};
}

/// Means over an element [Pa].
struct InElement {
    Vec2 centre;
    AtBase lem;
    double fem_sigma_v0;
};

struct Compared {
    double largest_u;  ///< largest difference at a node [Pa]
    std::vector<InElement> elements;
};

Compared compared(const json& scene) {
    bench::Run run(scene);
    const Course& a = run.go();
    const lem::Model slices = lem::make_model(run.session().scene());
    const Mesh& mesh = a.model.mesh;
    const exchange::MeshSnapshot state =
        snapshot_of(run.session().scene(), a.model, a.motion, a.beginning, {}, 0.0, 0);
    Compared result{0.0, {}};
    for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
        result.largest_u = std::max(
            result.largest_u, std::abs(state.pore_pressure[i] - lem_at(slices, mesh.nodes[i]).u));
    const std::size_t points = a.model.points_per_element;
    for (std::size_t e = 0; e < mesh.quads.size(); ++e) {
        const Corners x = corners_of(mesh, e);
        const double low = x.row(1).minCoeff(), height = x.row(1).maxCoeff() - low;
        InElement here{{x.row(0).mean(), x.row(1).mean()}, {0.0, 0.0}, 0.0};
        constexpr int n = 200;
        for (int i = 0; i < n; ++i) {
            const AtBase at = lem_at(slices, {here.centre.x(), low + height * (i + 0.5) / n});
            here.lem.u += at.u / n;
            here.lem.sigma_v0 += at.sigma_v0 / n;
        }
        for (std::size_t g = 0; g < points; ++g)
            here.fem_sigma_v0 -=
                a.motion.points[e * points + g].sigma[1] / static_cast<double>(points);
        result.elements.push_back(here);
    }
    return result;
}

double away_from_sides(const Compared& all, double margin) {
    double largest = 0.0;
    for (const InElement& each : all.elements)
        if (std::abs(each.centre.x() - 10.0) < 10.0 - margin)
            largest = std::max(largest, std::abs(each.fem_sigma_v0 / each.lem.sigma_v0 - 1.0));
    return largest;
}

const json sloping = {{0, 8.5}, {20, 6.5}};

TEST(LemAndFem, AgreeOnPressureAndVerticalStressOnElementsOfTwoMetres) {
    for (const char* element : {"ssp", "bbar"}) {
        for (const char* above : {"drained", "dry"}) {
            for (const double level : {6.4, 7.5, 8.3}) {
                const Compared all = compared(wet_section(element, above, {{0, level}}, 2.0));
                const std::string what =
                    std::string(element) + ", " + above + ", line at " + std::to_string(level);
                expect_error(what + ": u [Pa]", all.largest_u, 1.0);
                expect_error(what + ": sigma'_v0, relative", away_from_sides(all, 0.0), 0.01);
            }
            const Compared all = compared(wet_section(element, above, sloping, 2.0));
            const std::string what = std::string(element) + ", " + above + ", line 1 in 10";
            expect_error(what + ": u [Pa]", all.largest_u, 1.0);
            expect_error(what + ": sigma'_v0 4 m off the sides, relative",
                         away_from_sides(all, 4.0), 0.01);
        }
    }
}

/// Mean sigma'_v0 of the elements in a square of 2 m [Pa].
struct InSquare {
    double lem = 0.0, fem = 0.0;
};

InSquare in_square(const Compared& all, const Vec2& low) {
    InSquare sum;
    double count = 0.0;
    for (const InElement& each : all.elements) {
        const Vec2 from_low = each.centre - low;
        if (from_low.minCoeff() < 0.0 || from_low.maxCoeff() > 2.0) continue;
        sum.lem += each.lem.sigma_v0;
        sum.fem += each.fem_sigma_v0;
        count += 1.0;
    }
    return {sum.lem / count, sum.fem / count};
}

// Water under an inclined line exerts a horizontal force on the soil, carried by shear. A smooth
// side carries no shear: towards it the shear decreases, which shifts weight between neighbouring
// columns.
TEST(LemAndFem, DifferAtSmoothSidesByWhatElementsOfAnySizeShow) {
    const Compared coarse = compared(wet_section("ssp", "drained", sloping, 2.0));
    const Compared fine = compared(wet_section("ssp", "drained", sloping, 0.5));
    double of_mesh = 0.0, of_side = 0.0;
    for (const double x : {0.0, 18.0}) {
        for (double y = 0.0; y < 10.0; y += 2.0) {
            const InSquare now = in_square(coarse, {x, y}), finer = in_square(fine, {x, y});
            of_mesh = std::max(of_mesh, std::abs(now.fem / finer.fem - 1.0));
            of_side = std::max(of_side, std::abs(finer.fem / finer.lem - 1.0));
        }
    }
    expect_error("sigma'_v0 beside the sides, 2 m over 0.5 m elements", of_mesh, 3e-3);
    expect_error("... FEM over LEM", of_side, 0.025);
    EXPECT_GT(of_side, 0.015) << "no difference is left: compare at the sides, too";
}

}  // namespace
}  // namespace breach::fem::lem_agreement_test
