#include "core/materials/mohr_coulomb/principal_return.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace breach::materials {

Cone make_cone(double c, double tan_phi, double tan_psi, const Tension& tension) {
    // sqrt(k) = tan phi + sec phi
    const double root_k = tan_phi + std::sqrt(1.0 + tan_phi * tan_phi);
    const double root_m = tan_psi + std::sqrt(1.0 + tan_psi * tan_psi);
    const double apex = tan_phi > 0.0 ? c / tan_phi : std::numeric_limits<double>::infinity();
    const double q = 2.0 * c * root_k;
    const double cutoff = std::max(tension.cutoff, tension.share * q);
    const Cone::Tip tip = cutoff < apex ? Cone::Tip::cut_off : Cone::Tip::apex;
    return {root_k * root_k, root_m * root_m, q, std::min(cutoff, apex), tip};
}

namespace {

/// Plastic strain D^-1 (trial - sigma), from deviator and volume: no loss of digits for nu -> 0.5.
Triple plastic_strain(const Moduli& moduli, const Triple& trial, const Triple& sigma) {
    const Triple removed = trial - sigma;
    const double mean = removed.sum() / 3.0;
    return (removed.array() - mean) / (2.0 * moduli.G) + mean / (3.0 * moduli.K);
}

/// a : D^-1 b, from deviator and volume.
double compliance_product(const Moduli& moduli, const Triple& a, const Triple& b) {
    const double mean_a = a.sum() / 3.0;
    const double mean_b = b.sum() / 3.0;
    const Triple deviator_a = a.array() - mean_a;
    const Triple deviator_b = b.array() - mean_b;
    return deviator_a.dot(deviator_b) / (2.0 * moduli.G) + mean_a * mean_b / moduli.K;
}

struct Line {
    Triple base;
    Triple direction;       ///< of the line on which both planes are satisfied
    Triple flow_direction;  ///< normal to both flow vectors
};

Line edge_major(const Cone& cone) {
    return {{0.0, 0.0, -cone.q}, {1.0, 1.0, cone.k}, {1.0, 1.0, cone.m}};
}
Line edge_minor(const Cone& cone) {
    return {{0.0, -cone.q, -cone.q}, {1.0, cone.k, cone.k}, {1.0, cone.m, cone.m}};
}

/// Point on the line from which the flow vectors lead to the trial point.
Triple on_line(const Moduli& moduli, const Line& line, const Triple& trial) {
    const double t = compliance_product(moduli, line.flow_direction, trial - line.base) /
                     compliance_product(moduli, line.flow_direction, line.direction);
    return line.base + t * line.direction;
}

/// The return to one facet, and by how much it violates that facet's conditions [Pa].
struct Candidate {
    PrincipalReturn point;
    double violation;
};

/// Returns of a trial point to the facets of a cone, one candidate after another.
class Candidates {
  public:
    Candidates(const Cone& cone, const Moduli& moduli, const Triple& trial)
        : cone_(cone), moduli_(moduli), trial_(trial), two_G_(2.0 * moduli.G) {}

    Candidate cone_plane() const {
        const double k = cone_.k;
        const double m = cone_.m;
        const double volumetric = moduli_.lambda * (m - 1.0);
        const double f = k * trial_[0] - trial_[2] - cone_.q;
        const double multiplier =
            f / (moduli_.lambda * (k - 1.0) * (m - 1.0) + two_G_ * (k * m + 1.0));
        Triple sigma =
            trial_ - multiplier * Triple(volumetric + two_G_ * m, volumetric, volumetric - two_G_);
        sigma[0] = (cone_.q + sigma[2]) / k;  // exactly on the plane, for any distance of the trial
        const double violation =
            std::max({sigma[1] - sigma[0], sigma[2] - sigma[1], sigma[0] - cone_.T, -f});
        return {{sigma, {multiplier * m, 0.0, -multiplier}, Facet::cone_plane}, violation};
    }

    Candidate cone_edge_major() const {
        Candidate each =
            from_stress(on_line(moduli_, edge_major(cone_), trial_), Facet::cone_edge_major);
        const Triple& e = each.point.d_epsilon_plastic;
        each.violation = std::max({each.point.sigma[0] - cone_.T, -two_G_ * e[0], -two_G_ * e[1]});
        return each;
    }

    Candidate cone_edge_minor() const {
        Candidate each =
            from_stress(on_line(moduli_, edge_minor(cone_), trial_), Facet::cone_edge_minor);
        const Triple& e = each.point.d_epsilon_plastic;
        each.violation = std::max({each.point.sigma[0] - cone_.T, two_G_ * e[1], two_G_ * e[2]});
        return each;
    }

    Candidate cut_plane() const {
        const double e = (trial_[0] - cone_.T) / (moduli_.lambda + two_G_);
        const Triple sigma(cone_.T, trial_[1] - moduli_.lambda * e, trial_[2] - moduli_.lambda * e);
        const double violation = std::max({-two_G_ * e, sigma[1] - cone_.T, Q() - sigma[2]});
        return {{sigma, {e, 0.0, 0.0}, Facet::cut_plane}, violation};
    }

    Candidate cut_edge() const {
        const double sum =
            (trial_[0] + trial_[1] - 2.0 * cone_.T) / (2.0 * moduli_.lambda + two_G_);
        const double difference = (trial_[0] - trial_[1]) / two_G_;
        const Triple e(0.5 * (sum + difference), 0.5 * (sum - difference), 0.0);
        const Triple sigma(cone_.T, cone_.T, trial_[2] - moduli_.lambda * sum);
        const double violation = std::max({-two_G_ * e[1], sigma[2] - cone_.T, Q() - sigma[2]});
        return {{sigma, e, Facet::cut_edge}, violation};
    }

    Candidate cut_cone_edge() const {
        const double sum =
            (trial_[0] - cone_.T + trial_[2] - Q()) / (2.0 * moduli_.lambda + two_G_);
        const Triple sigma(cone_.T, trial_[1] - moduli_.lambda * sum, Q());
        Candidate each = from_stress(sigma, Facet::cut_cone_edge);
        Triple& e = each.point.d_epsilon_plastic;
        e[1] = 0.0;
        each.violation = std::max(
            {sigma[1] - cone_.T, Q() - sigma[1], two_G_ * e[2], -two_G_ * (e[0] + cone_.m * e[2])});
        return each;
    }

    Candidate cut_cone_corner_major() const {
        Candidate each = from_stress({cone_.T, cone_.T, Q()}, Facet::cut_cone_corner_major);
        const Triple& e = each.point.d_epsilon_plastic;
        each.violation = two_G_ * std::max({-e[0], -e[1], e[2], -(e[0] + e[1] + cone_.m * e[2])});
        return each;
    }

    Candidate cut_cone_corner_minor() const {
        Candidate each = from_stress({cone_.T, Q(), Q()}, Facet::cut_cone_corner_minor);
        const Triple& e = each.point.d_epsilon_plastic;
        each.violation = two_G_ * std::max({e[1], e[2], -(e[0] + cone_.m * (e[1] + e[2]))});
        return each;
    }

    /// At T all axes meet. Below the apex only the cut-off is active; at the apex everything.
    Candidate tip() const {
        Candidate each = from_stress(Triple::Constant(cone_.T), Facet::tip);
        const Triple& e = each.point.d_epsilon_plastic;
        const double pulled = e.cwiseMax(0.0).sum();
        const double pushed = e.cwiseMin(0.0).sum();
        each.violation = cone_.tip == Cone::Tip::apex ? -two_G_ * (pulled + cone_.m * pushed)
                                                      : -two_G_ * e.minCoeff();
        return each;
    }

  private:
    double Q() const { return cone_.k * cone_.T - cone_.q; }

    Candidate from_stress(const Triple& sigma, Facet facet) const {
        return {{sigma, plastic_strain(moduli_, trial_, sigma), facet}, 0.0};
    }

    const Cone& cone_;
    const Moduli& moduli_;
    const Triple& trial_;
    double two_G_;
};

}  // namespace

PrincipalReturn return_to_cone(const Cone& cone, const Moduli& moduli, const Triple& trial) {
    const Candidates facets(cone, moduli, trial);
    // Exactly one facet is right up to round-off; on a border, both give the same point. The order
    // only affects speed, and the least violation decides if round-off leaves none.
    const double tolerance = 1e-12 * (trial.cwiseAbs().maxCoeff() + cone.q);
    Candidate best = facets.cone_plane();
    const auto settled = [&](const Candidate& next) {
        if (next.violation < best.violation) best = next;
        return best.violation <= tolerance;
    };
    const auto on_the_edges = [&] {
        return settled(facets.cone_edge_major()) || settled(facets.cone_edge_minor());
    };
    if (best.violation <= tolerance) return best.point;
    const bool beyond_tip = best.point.sigma[0] > cone.T;
    if (!beyond_tip && on_the_edges()) return best.point;
    if (std::isfinite(cone.T)) {
        if (settled(facets.tip())) return best.point;
        if (cone.tip == Cone::Tip::cut_off &&
            (settled(facets.cut_plane()) || settled(facets.cut_edge()) ||
             settled(facets.cut_cone_edge()) || settled(facets.cut_cone_corner_major()) ||
             settled(facets.cut_cone_corner_minor()))) {
            return best.point;
        }
    }
    if (beyond_tip) on_the_edges();
    return best.point;
}

namespace {

Matrix3 elastic_matrix(const Moduli& moduli) {
    Matrix3 D = Matrix3::Constant(moduli.lambda);
    D.diagonal().array() += 2.0 * moduli.G;
    return D;
}

/// Perfect plasticity on one plane with normal n and flow g: D - (D g)(D n)^T / (n . D g).
Matrix3 plane_tangent(const Moduli& moduli, const Triple& n, const Triple& g) {
    const Matrix3 D = elastic_matrix(moduli);
    const Triple Dg = D * g;
    const Triple Dn = D * n;
    return D - Dg * Dn.transpose() / n.dot(Dg);
}

/// On a line, only the stress component along it can change.
Matrix3 line_tangent(const Moduli& moduli, const Triple& direction, const Triple& flow_direction) {
    return direction * flow_direction.transpose() /
           compliance_product(moduli, flow_direction, direction);
}

}  // namespace

Matrix3 principal_tangent(const Cone& cone, const Moduli& moduli, Facet facet) {
    switch (facet) {
        case Facet::cone_plane:
            return plane_tangent(moduli, {cone.k, 0.0, -1.0}, {cone.m, 0.0, -1.0});
        case Facet::cut_plane:
            return plane_tangent(moduli, Triple::UnitX(), Triple::UnitX());
        case Facet::cone_edge_major:
            return line_tangent(moduli, edge_major(cone).direction,
                                edge_major(cone).flow_direction);
        case Facet::cone_edge_minor:
            return line_tangent(moduli, edge_minor(cone).direction,
                                edge_minor(cone).flow_direction);
        case Facet::cut_edge:
            return line_tangent(moduli, Triple::UnitZ(), Triple::UnitZ());
        case Facet::cut_cone_edge:
            return line_tangent(moduli, Triple::UnitY(), Triple::UnitY());
        case Facet::cut_cone_corner_major:
        case Facet::cut_cone_corner_minor:
        case Facet::tip:
            break;
    }
    return Matrix3::Zero();
}

}  // namespace breach::materials
