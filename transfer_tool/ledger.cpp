#include "transfer_tool/ledger.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "core/fault/fault.hpp"
#include "transfer_tool/grid_force.hpp"

namespace breach::transfer {
namespace {

using exchange::Ledger;
using exchange::MeshSnapshot;
using exchange::ParticleState;
using mechanics::Voigt;

/// Compensated sum (Neumaier 1974): with a million equal points a plain sum would miss 1e-12.
class Sum {
  public:
    Sum& operator+=(double x) {
        const double next = value_ + x;
        lost_ += std::abs(value_) >= std::abs(x) ? (value_ - next) + x : (x - next) + value_;
        value_ = next;
        return *this;
    }
    Sum& operator+=(const Sum& other) {
        *this += other.value_;
        lost_ += other.lost_;
        return *this;
    }
    double total() const { return value_ + lost_; }

  private:
    double value_ = 0.0;
    double lost_ = 0.0;
};

/// All quantities of one region.
struct Amounts {
    Sum mass;
    Sum volume;
    Sum momentum_x;
    Sum momentum_y;
    Sum kinetic;
    Sum potential;
    Sum elastic;
    Sum momentum_scale;  ///< sum of |m v|

    Amounts& operator+=(const Amounts& other) {
        mass += other.mass;
        volume += other.volume;
        momentum_x += other.momentum_x;
        momentum_y += other.momentum_y;
        kinetic += other.kinetic;
        potential += other.potential;
        elastic += other.elastic;
        momentum_scale += other.momentum_scale;
        return *this;
    }
};

/// Input of both sides of the ledger.
/// Both use the same datum, thickness and soils, or their difference would mean nothing.
struct Books {
    const MeshSnapshot& mesh;
    const Points& points;
    const SoilMap& map;
    double gravity;
    double datum;  ///< level of the lowest node [m]
};

/// Heights above sea level would hide a loss: potential energy is compared relative to itself.
double lowest_node(const MeshSnapshot& mesh) {
    double y = mesh.position_0.front().y() + mesh.displacement.front().y();
    for (std::size_t i = 0; i < mesh.position_0.size(); ++i)
        y = std::min(y, mesh.position_0[i].y() + mesh.displacement[i].y());
    return y;
}

std::vector<double> gauss_weights(const MeshSnapshot& mesh, const std::string& file) {
    const int n = static_cast<int>(std::lround(std::sqrt(mesh.gauss_positions.size())));
    const GaussRule rule = gauss_legendre(std::max(n, 1));
    const auto weight_at = [&](double xi) {
        for (int i = 0; i < n; ++i)
            if (std::abs(rule.position[i] - xi) < 1e-9) return rule.weight[i];
        return 0.0;
    };
    std::vector<double> weights;
    double sum = 0.0;
    for (const Vec2& xi : mesh.gauss_positions) {
        weights.push_back(weight_at(xi.x()) * weight_at(xi.y()));
        sum += weights.back();
    }
    if (std::abs(sum - 4.0) > 1e-9)
        throw fault::BadInput(file, {{"/breachline/gauss/natural_coordinates",
                                      "not the points of an n x n Gauss-Legendre rule",
                                      "give a snapshot as fem_solver wrote it"}});
    return weights;
}

/// Exact integrals of the finite-element fields over element e.
Amounts on_element(const Books& books, std::size_t e) {
    const MeshSnapshot& mesh = books.mesh;
    const Eigen::Vector4d J_0 = corner_jacobians(undeformed_corners(mesh, e));
    // Rebuilt where the points' element is: the ledger audits the mapping, not the mesh.
    const Corners& x = books.points.shape[e];
    const Corners v = corner_values(mesh.velocity, mesh.quads[e]);
    const double rho_t = mesh.density[e] * mesh.thickness;
    Amounts a;
    a.mass += rho_t * J_0.sum();
    a.volume += mesh.thickness * corner_jacobians(x).sum();
    for (int i = 0; i < 4; ++i)
        for (int k = 0; k < 4; ++k) {
            const double m_ik = rho_t * integral(i, k) * J_0[k];
            a.momentum_x += m_ik * v(0, i);
            a.momentum_y += m_ik * v(1, i);
            a.potential += m_ik * books.gravity * (x(1, i) - books.datum);
            for (int j = 0; j < 4; ++j)
                a.kinetic += 0.5 * rho_t * integral(i, j, k) * J_0[k] * v.col(i).dot(v.col(j));
        }
    return a;
}

double elastic_energy_on_element(const Books& books, std::size_t e,
                                 const std::vector<double>& weights) {
    const MeshSnapshot& mesh = books.mesh;
    Eigen::Vector4d u = Eigen::Vector4d::Zero();
    if (!mesh.pore_pressure.empty()) {
        u = corner_pressure(mesh.pore_pressure, mesh.quads[e], books.points.shape[e]);
    }
    double energy = 0.0;
    for (std::size_t g = 0; g < weights.size(); ++g) {
        const Vec2& xi = mesh.gauss_positions[g];
        const double V = jacobian(books.points.shape[e], xi).determinant() * weights[g];
        const SoilOfPoints& soil = books.map.soils()[books.map.at(e, xi)];
        // The soil's measure of stress, as on the points: total and effective energies differ
        // without any loss.
        const Voigt sigma =
            stress_of(soil, mesh.stress[e * weights.size() + g], u.dot(shape_functions(xi)),
                      books.map.still_pressure(books.points.shape[e] * shape_functions(xi)));
        energy += V * mesh.thickness *
                  mechanics::elastic_energy_density(materials::elasticity(soil.law), sigma);
    }
    return energy;
}

std::vector<Amounts> on_mesh(const Books& books, const std::string& file) {
    const std::vector<double> weights = gauss_weights(books.mesh, file);
    std::vector<Amounts> regions(books.mesh.regions.size());
    for (std::size_t e = 0; e < books.mesh.quads.size(); ++e) {
        Amounts& a = regions[books.mesh.region_of_element[e]];
        a += on_element(books, e);
        a.elastic += elastic_energy_on_element(books, e, weights);
    }
    return regions;
}

/// Region of the mesh for each soil; 0 for soils of regions that the mesh lacks, which have no
/// points.
std::vector<std::size_t> mesh_regions(const Books& books) {
    std::vector<std::size_t> regions;
    for (const SoilOfPoints& soil : books.map.soils()) {
        const auto found = std::ranges::find(books.mesh.regions, soil.region);
        regions.push_back(found == books.mesh.regions.end()
                              ? 0
                              : static_cast<std::size_t>(found - books.mesh.regions.begin()));
    }
    return regions;
}

std::vector<Amounts> on_points(const Books& books) {
    const ParticleState& s = books.points.state;
    const std::vector<std::size_t> region_of_soil = mesh_regions(books);
    std::vector<Amounts> regions(books.mesh.regions.size());
    for (std::size_t p = 0; p < s.size(); ++p) {
        const std::int32_t soil = s.region[p];
        Amounts& a = regions[region_of_soil[soil]];
        const double m = s.mass[p];
        const Vec2& v = s.velocity[p];
        a.mass += m;
        a.volume += s.volume[p];
        a.momentum_x += m * v.x();
        a.momentum_y += m * v.y();
        // Momentum itself may be near zero in soil that moves to both sides.
        a.momentum_scale += m * v.norm();
        a.kinetic += 0.5 * m * v.squaredNorm();
        a.potential += m * books.gravity * (s.position[p].y() - books.datum);
        a.elastic +=
            s.volume[p] * mechanics::elastic_energy_density(
                              materials::elasticity(books.map.soils()[soil].law), s.stress[p]);
    }
    return regions;
}

/// [regions of the mesh]
std::vector<GridForce> on_grid(const Books& books, const scene::Scene& scene) {
    const std::vector<std::size_t> region_of_soil = mesh_regions(books);
    std::vector<Vec2> still;
    if (books.map.water().is_there())
        for (const Vec2& place : books.points.state.position)
            still.push_back(books.map.still_gradient(place));
    const std::vector<GridForce> soils = grid_force(scene, books.points, still);
    std::vector<GridForce> regions(books.mesh.regions.size());
    for (std::size_t i = 0; i < soils.size(); ++i) regions[region_of_soil[i]] += soils[i];
    return regions;
}

double relative(double before, double after, double scale) {
    if (after == before) return 0.0;
    // Soil at rest has a scale of 0: equal sums were answered above, a difference becomes very
    // large.
    return (after - before) / std::max(std::abs(scale), 1e-300);
}

void add_row(Ledger& ledger, const std::string& region, const char* quantity, const char* unit,
             std::array<double, 3> before_after_scale) {
    const auto [before, after, scale] = before_after_scale;
    ledger.push_back({region, quantity, unit, before, after, relative(before, after, scale)});
}

void add_rows(Ledger& ledger, const std::string& region, const Amounts& b, const Amounts& a) {
    const auto row = [&](const char* quantity, const char* unit, const Sum& before,
                         const Sum& after, const Sum& scale) {
        add_row(ledger, region, quantity, unit, {before.total(), after.total(), scale.total()});
    };
    row("mass", "kg", b.mass, a.mass, b.mass);
    row("volume", "m3", b.volume, a.volume, b.volume);
    row("momentum x", "kg m/s", b.momentum_x, a.momentum_x, a.momentum_scale);
    row("momentum y", "kg m/s", b.momentum_y, a.momentum_y, a.momentum_scale);
    row("kinetic energy", "J", b.kinetic, a.kinetic, b.kinetic);
    row("potential energy", "J", b.potential, a.potential, b.potential);
    row("elastic energy", "J", b.elastic, a.elastic, b.elastic);
}

/// Compares the FEM's lumped sums with the points.
void add_nodal_rows(Ledger& ledger, const MeshSnapshot& mesh, const Amounts& a) {
    // Lumped sums, for comparison only: refuse_losses does not know these rows.
    Amounts b;
    for (std::size_t i = 0; i < mesh.nodal_mass.size(); ++i) {
        const double m = mesh.nodal_mass[i];
        const Vec2& v = mesh.velocity[i];
        b.mass += m;
        b.momentum_x += m * v.x();
        b.momentum_y += m * v.y();
        b.kinetic += 0.5 * m * v.squaredNorm();
    }
    const auto row = [&](const char* quantity, const char* unit, const Sum& before,
                         const Sum& after, const Sum& scale) {
        add_row(ledger, "total", quantity, unit, {before.total(), after.total(), scale.total()});
    };
    row("mass of the nodes", "kg", b.mass, a.mass, b.mass);
    row("momentum x of the nodes", "kg m/s", b.momentum_x, a.momentum_x, a.momentum_scale);
    row("momentum y of the nodes", "kg m/s", b.momentum_y, a.momentum_y, a.momentum_scale);
    row("kinetic energy of the nodes", "J", b.kinetic, a.kinetic, b.kinetic);
}

}  // namespace

Ledger ledger_of(const MeshSnapshot& mesh, const Points& points, const SoilMap& map,
                 const scene::Scene& scene, const std::string& file) {
    const Books books{mesh, points, map, scene.gravity, lowest_node(mesh)};
    const std::vector<Amounts> before = on_mesh(books, file);
    const std::vector<Amounts> after = on_points(books);
    const std::vector<GridForce> balance =
        scene.mpm ? on_grid(books, scene) : std::vector<GridForce>(before.size());
    Ledger ledger;
    Amounts total_before;
    Amounts total_after;
    GridForce whole;
    const auto add_balance = [&](const std::string& region, const GridForce& f) {
        if (!scene.mpm) return;
        ledger.push_back({region, "out-of-balance force", "N", f.inertia, f.force,
                          (f.force - f.inertia) / std::max(f.weight, 1e-300)});
    };
    for (std::size_t r = 0; r < before.size(); ++r) {
        if (before[r].mass.total() == 0.0) continue;  // no elements
        add_rows(ledger, mesh.regions[r], before[r], after[r]);
        add_balance(mesh.regions[r], balance[r]);
        total_before += before[r];
        total_after += after[r];
        whole += balance[r];
    }
    add_rows(ledger, "total", total_before, total_after);
    add_balance("total", whole);
    add_nodal_rows(ledger, mesh, total_after);
    return ledger;
}

std::string as_text(const Ledger& ledger) {
    std::size_t region = 6;
    std::size_t quantity = 8;
    for (const auto& row : ledger) {
        region = std::max(region, row.region.size());
        quantity = std::max(quantity, row.quantity.size());
    }
    const int r = static_cast<int>(region);
    const int q = static_cast<int>(quantity);
    char line[512];
    std::snprintf(line, sizeof line, "%-*s  %-*s  %-6s  %16s  %16s  %10s\n", r, "region", q,
                  "quantity", "unit", "before", "after", "difference");
    std::string text = line;
    for (const auto& row : ledger) {
        std::snprintf(line, sizeof line, "%-*s  %-*s  %-6s  %16.9e  %16.9e  %10.1e\n", r,
                      row.region.c_str(), q, row.quantity.c_str(), row.unit.c_str(), row.before,
                      row.after, row.difference);
        text += line;
    }
    return text;
}

void refuse_losses(const Ledger& ledger, const scene::Transfer& settings) {
    std::string losses;
    for (const auto& row : ledger) {
        double allowed = 0.0;
        if (row.quantity == "mass" || row.quantity == "volume")
            allowed = settings.largest_mass_loss;
        else if (row.quantity == "momentum x" || row.quantity == "momentum y")
            allowed = settings.largest_momentum_loss;
        else if (row.quantity == "kinetic energy")
            allowed = settings.largest_kinetic_energy_loss;
        else
            continue;
        // A NaN does not pass.
        if (std::abs(row.difference) <= allowed) continue;
        char line[256];
        std::snprintf(line, sizeof line, "\n  %s of region \"%s\": %.3g, allowed %.3g",
                      row.quantity.c_str(), row.region.c_str(), row.difference, allowed);
        losses += line;
    }
    if (losses.empty()) return;
    throw fault::Breakdown(
        "the transfer loses more than the scene allows (relative):" + losses +
        "\n  remedy: at least 2 points_per_direction, or allow more in /transfer/largest_*_loss");
}

}  // namespace breach::transfer
