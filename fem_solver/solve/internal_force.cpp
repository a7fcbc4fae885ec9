// Three passes (strains, laws, forces) and not one per element: a law then takes all points of a
// zone together, which PM4Sand needs for its lanes.
#include "fem_solver/solve/internal_force.hpp"

#include <algorithm>
#include <cmath>

#include "fem_solver/solve/ranges.hpp"
#include "fem_solver/solve/viscosity.hpp"

namespace breach::fem {

using mechanics::Matrix4;

namespace {

Eigen::Matrix3d in_plane(const Matrix4& D) {
    static constexpr int at[3] = {0, 1, 3};
    Eigen::Matrix3d C;
    for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 3; ++i) C(i, j) = D(at[i], at[j]);
    }
    return C;
}

/// A law whose points have their own undrained strength.
template <class Law>
struct OfPoints {
    const Law& law;
    const std::vector<double>& s_u;  ///< [points] [Pa]
};

template <class Law>
const Law& at(const Law& law, std::size_t /*point*/) {
    return law;
}
template <class Law>
auto at(const OfPoints<Law>& laws, std::size_t point) {
    return materials::ready(materials::undrained(laws.law, laws.s_u[point]));
}

Voigt strain_of(const StrainOperator& B, const Dofs8& d_u) {
    const Eigen::Vector3d e = B * d_u;
    return {e[0], e[1], 0.0, e[2]};
}

}  // namespace

InternalForce::InternalForce(const Model& model, Seconds& seconds,
                             std::shared_ptr<numerics::Team> team)
    : model_(model),
      points_(model.points_per_element),
      team_(std::move(team)),
      seconds_(seconds),
      memory_(model, team_) {
    d_epsilon_.resize(model.points());
    tangent_.resize(model.points());
    d_q_.resize(model.hourglass.size());
    // One thread adds to the nodes at once. Several fill this first, and the sum has the same
    // order.
    if (team_->threads() > 1) nodal_.resize(model.mesh.quads.size());
    for (const Zone& zone : model.zones) {
        const double G = materials::elasticity(zone.law).shear_modulus();
        elastic_c_s_.insert(elastic_c_s_.end(), d_q_.empty() ? 0 : zone.count, 4.0 * G);
    }
}

std::string InternalForce::why_degenerate() const { return in_words(memory_.refusal()); }

void InternalForce::strain_pass(const Motion& old, const Motion& trial) {
    for_ranges(model_.mesh.quads.size(), *team_, [&](std::size_t begin, std::size_t end) {
        for (std::size_t e = begin; e < end; ++e) small_strains(e, old, trial);
    });
}

void InternalForce::small_strains(std::size_t element, const Motion& old, const Motion& trial) {
    const Quad& quad = model_.mesh.quads[element];
    const Dofs8 d_u = gather(quad, trial.u) - gather(quad, old.u);
    for (std::size_t g = 0; g < points_; ++g) {
        d_epsilon_[element * points_ + g] = strain_of(model_.reference[element].B[g], d_u);
    }
    if (!d_q_.empty()) d_q_[element] = hourglass_amplitude(model_.hourglass[element], d_u);
    if (!model_.is_absent(element)) return;
    // Absent soil has nodes that move with their neighbours; its laws must see nothing of it.
    for (std::size_t g = 0; g < points_; ++g) d_epsilon_[element * points_ + g].setZero();
    if (!d_q_.empty()) d_q_[element].setZero();
}

template <class Law>
Geometry InternalForce::integrate_zone(const Law& law, std::size_t z, const Motion& old,
                                       Motion& trial) {
    const Zone& zone = model_.zones[z];
    const std::size_t first = zone.first * points_;
    for_ranges(zone.count * points_, *team_, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = first + begin; p < first + end; ++p)
            trial.points[p] = materials::integrate(at(law, p), old.points[p], d_epsilon_[p]).state;
    });
    return Geometry::sound;
}

template <class Law>
Geometry InternalForce::integrate_zone_with_tangent(const Law& law, std::size_t z,
                                                    const Motion& old, Motion& trial) {
    const Zone& zone = model_.zones[z];
    const std::size_t first = zone.first * points_;
    for_ranges(zone.count * points_, *team_, [&](std::size_t begin, std::size_t end) {
        Matrix4 D;
        for (std::size_t p = first + begin; p < first + end; ++p) {
            trial.points[p] =
                materials::integrate(at(law, p), old.points[p], d_epsilon_[p], D).state;
            tangent_[p] = in_plane(D);
        }
    });
    return Geometry::sound;
}

template <materials::Remembers Law>
Geometry InternalForce::integrate_zone(const Law& law, std::size_t z, const Motion& old,
                                       Motion& trial) {
    const Zone& zone = model_.zones[z];
    const std::span all(d_epsilon_);
    const std::span d_epsilon = all.subspan(zone.first * points_, zone.count * points_);
    return memory_.integrate(law, z, d_epsilon, old, trial) == MemoryPass::Answer::done
               ? Geometry::sound
               : Geometry::degenerate;
}

/// The stiffer elastic tangent of the step's two ends. It is symmetric positive definite, which
/// keeps the matrix quasi-definite, and rather too stiff, so that iterations do not oscillate when
/// soil near zero mean stress is compressed again.
template <materials::Remembers Law>
Geometry InternalForce::integrate_zone_with_tangent(const Law& law, std::size_t z,
                                                    const Motion& old, Motion& trial) {
    if (integrate_zone(law, z, old, trial) == Geometry::degenerate) return Geometry::degenerate;
    const auto& before = std::get<materials::ZoneMemory<Law>>(old.memory[z]).points;
    const auto& after = std::get<materials::ZoneMemory<Law>>(trial.memory[z]).points;
    const std::size_t begin = model_.zones[z].first * points_;
    for (std::size_t i = 0; i < after.size(); ++i) {
        const bool stiffens = shear_modulus(law, after[i]) > shear_modulus(law, before[i]);
        tangent_[begin + i] = in_plane(elastic_tangent(law, stiffens ? after[i] : before[i]));
    }
    return Geometry::sound;
}

Geometry InternalForce::law_pass(const std::vector<materials::Law>& laws, const Motion& old,
                                 Motion& trial, Wanted wanted) {
    const Stopwatch watch(seconds_, &Seconds::law);
    for (std::size_t z = 0; z < model_.zones.size(); ++z) {
        const auto integrate = [&](const auto& law) {
            return wanted == Wanted::stress ? integrate_zone(law, z, old, trial)
                                            : integrate_zone_with_tangent(law, z, old, trial);
        };
        const bool of_points =
            !model_.s_u.empty() && model_.s_u[model_.zones[z].first * points_] > 0.0;
        const auto pass = [&]<class Law>(const Law& parameters) {
            if constexpr (!materials::Remembers<Law>)
                if (of_points) return integrate(OfPoints<Law>{parameters, model_.s_u});
            return integrate(materials::ready(parameters));
        };
        if (std::visit(pass, laws[z]) == Geometry::degenerate) return Geometry::degenerate;
    }
    return Geometry::sound;
}

void InternalForce::accumulate_strain(std::size_t begin, std::size_t end, const Motion& old,
                                      Motion& trial) const {
    for (std::size_t p = begin * points_; p < end * points_; ++p)
        trial.strain[p] = old.strain[p] + d_epsilon_[p];
}

/// Q += c_s H dq with the modulus of the last accepted step: the tangent is exact and symmetric,
/// and the force is continuous when the modulus changes.
void InternalForce::advance_hourglass(std::size_t begin, std::size_t end, const Motion& old,
                                      Motion& trial) const {
    for (std::size_t e = begin; e < end; ++e) {
        const Hourglass& before = old.hourglass[e];
        Hourglass& after = trial.hourglass[e];
        const Vec2 last = before.force + before.c_s * (model_.hourglass[e].H * d_q_[e]);
        after.energy = before.energy + 0.5 * (before.force + last).dot(d_q_[e]);
        after.force = last;
        after.c_s = next_hourglass_modulus(e, before.c_s, old, trial);
    }
}

/// 4 G_secant of the step: G_s = s.d / (2 d.d) with d = (e_xx - e_yy, gamma_xy) and the stress
/// increment s = (s_xx - s_yy, 2 s_xy). Without shear the modulus stays. A floor of 2 % of the
/// elastic one controls the hourglass modes in flowing soil.
double InternalForce::next_hourglass_modulus(std::size_t e, double now, const Motion& old,
                                             const Motion& trial) const {
    if (model_.hourglass_modulus == HourglassModulus::elastic) return now;
    constexpr double floor = 0.02, no_strain = 1e-12;
    const Vec2 d(d_epsilon_[e][0] - d_epsilon_[e][1], d_epsilon_[e][3]);
    if (d.squaredNorm() < no_strain * no_strain) return now;
    const Voigt d_sigma = trial.points[e].sigma - old.points[e].sigma;
    const Vec2 s(d_sigma[0] - d_sigma[1], 2.0 * d_sigma[3]);
    const double elastic = elastic_c_s_[e];
    return std::clamp(2.0 * s.dot(d) / d.squaredNorm(), floor * elastic, elastic);
}

/// Computes total strains, hourglass forces and nodal forces from the stresses.
void InternalForce::force_pass(const Motion& old, Motion& trial) {
    const std::size_t elements = model_.mesh.quads.size();
    trial.force.setZero();
    const auto add = [&](std::size_t e, const Dofs8& f) {
        for (int k = 0; k < 4; ++k) {
            const auto d = 2 * static_cast<Eigen::Index>(model_.mesh.quads[e][k]);
            trial.force.segment<2>(d) += f.segment<2>(2 * k);
        }
    };
    // Strains, hourglass and forces of one range together: its data are then still in the cache.
    const auto range = [&](std::size_t begin, std::size_t end, const auto& take) {
        accumulate_strain(begin, end, old, trial);
        if (!d_q_.empty()) advance_hourglass(begin, end, old, trial);
        visit_nodal_forces(begin, end, trial, take);
    };
    if (team_->threads() == 1) return range(0, elements, add);
    for_ranges(elements, *team_, [&](std::size_t begin, std::size_t end) {
        range(begin, end, [&](std::size_t e, const Dofs8& f) { nodal_[e] = f; });
    });
    for (std::size_t e = 0; e < elements; ++e) add(e, nodal_[e]);
}

template <class Take>
void InternalForce::visit_nodal_forces(std::size_t begin, std::size_t end, const Motion& trial,
                                       const Take& take) const {
    for (std::size_t e = begin; e < end; ++e) {
        const Quadrature& q = model_.reference[e];
        Dofs8 f = Dofs8::Zero();
        for (std::size_t g = 0; g < points_; ++g) {
            const Voigt& s = trial.points[e * points_ + g].sigma;
            const Eigen::Vector3d sigma = q.weight[g] * Eigen::Vector3d(s[0], s[1], s[3]);
            f.noalias() += q.B[g].transpose() * sigma;
        }
        if (!d_q_.empty()) f += hourglass_forces(model_.hourglass[e], trial.hourglass[e].force);
        if (model_.is_absent(e)) f.setZero();
        take(e, f);
    }
}

void InternalForce::stiffness_pass(const Motion& old, LinearSystem& A) const {
    const bool symmetric = A.symmetry() == Symmetry::symmetric;
    for (std::size_t e = 0; e < model_.mesh.quads.size(); ++e) {
        if (model_.is_absent(e)) continue;
        const Quadrature& q = model_.reference[e];
        Stiffness K = Stiffness::Zero();
        for (std::size_t g = 0; g < points_; ++g) {
            Tangent C = q.weight[g] * tangent_[e * points_ + g];
            // LDL^T stores one triangle. The symmetrised tangent converges more slowly, not to
            // another state.
            if (symmetric) C = (0.5 * (C + C.transpose())).eval();
            const StrainOperator CB = C * q.B[g];
            K.noalias() += q.B[g].transpose() * CB;
        }
        if (!d_q_.empty()) K += hourglass_stiffness(model_.hourglass[e], old.hourglass[e].c_s);
        A.add_element(e, K);
    }
}

Geometry InternalForce::evaluate(const std::vector<materials::Law>& laws, const Motion& old,
                                 Motion& trial) {
    {
        const Stopwatch watch(seconds_, &Seconds::assembly);
        strain_pass(old, trial);
    }
    // No forces then: `trial` has stresses of some zones only, and the caller discards it.
    if (law_pass(laws, old, trial, Wanted::stress) == Geometry::degenerate) {
        return Geometry::degenerate;
    }
    const Stopwatch watch(seconds_, &Seconds::assembly);
    force_pass(old, trial);
    return Geometry::sound;
}

Geometry InternalForce::evaluate(const std::vector<materials::Law>& laws, const Motion& old,
                                 Motion& trial, LinearSystem& A) {
    {
        const Stopwatch watch(seconds_, &Seconds::assembly);
        strain_pass(old, trial);
    }
    if (law_pass(laws, old, trial, Wanted::stress_and_tangent) == Geometry::degenerate) {
        return Geometry::degenerate;
    }
    const Stopwatch watch(seconds_, &Seconds::assembly);
    force_pass(old, trial);
    stiffness_pass(old, A);
    return Geometry::sound;
}

Stiffness elastic_stiffness(const Quadrature& quadrature, const mechanics::Elasticity& elasticity) {
    const Eigen::Matrix3d C = in_plane(mechanics::elastic_stiffness(elasticity));
    Stiffness K = Stiffness::Zero();
    for (std::size_t g = 0; g < gauss_points; ++g) {
        K += quadrature.weight[g] * quadrature.B[g].transpose() * C * quadrature.B[g];
    }
    return K;
}

Stiffness elastic_stiffness(const Model& model, std::size_t element,
                            const mechanics::Elasticity& elasticity) {
    Stiffness K = elastic_stiffness(model.reference[element], elasticity);
    if (!model.hourglass.empty()) {
        K += hourglass_stiffness(model.hourglass[element], 4.0 * elasticity.shear_modulus());
    }
    return K;
}

void InternalForce::add_elastic_stiffness(double factor, LinearSystem& A) const {
    for (const Zone& zone : model_.zones) {
        const mechanics::Elasticity& elasticity = materials::elasticity(zone.law);
        for (std::size_t e = zone.first; e < zone.first + zone.count; ++e) {
            if (!model_.is_absent(e))
                A.add_element(e, factor * elastic_stiffness(model_, e, elasticity));
        }
    }
}

/// Calls visit(element, its operators, eta) for each element with viscosity.
template <typename Visit>
void InternalForce::visit_viscous_elements(Visit visit) const {
    for (const Zone& zone : model_.zones) {
        if (zone.viscosity == 0.0) continue;
        for (std::size_t e = zone.first; e < zone.first + zone.count; ++e) {
            if (model_.is_absent(e)) continue;
            visit(e,
                  ElementOperators{model_.reference[e], points_,
                                   d_q_.empty() ? nullptr : &model_.hourglass[e]},
                  zone.viscosity);
        }
    }
}

bool InternalForce::is_viscous() const {
    return std::ranges::any_of(model_.zones, [](const Zone& zone) { return zone.viscosity > 0.0; });
}

void InternalForce::add_viscous_force(double factor, const Eigen::VectorXd& v,
                                      Eigen::VectorXd& f) const {
    visit_viscous_elements([&](std::size_t e, const ElementOperators& element, double eta) {
        const Quad& quad = model_.mesh.quads[e];
        const Dofs8 local = viscous_forces(element, factor * eta, gather(quad, v));
        for (int k = 0; k < 4; ++k) {
            f.segment<2>(2 * static_cast<Eigen::Index>(quad[k])) += local.segment<2>(2 * k);
        }
    });
}

void InternalForce::add_viscous_damping(double factor, LinearSystem& A) const {
    visit_viscous_elements([&](std::size_t e, const ElementOperators& element, double eta) {
        A.add_element(e, viscous_damping(element, factor * eta));
    });
}

double InternalForce::viscous_work(const Eigen::VectorXd& v, const Eigen::VectorXd& d_u) const {
    double work = 0.0;
    visit_viscous_elements([&](std::size_t e, const ElementOperators& element, double eta) {
        if (e >= model_.body.elements) return;
        const Quad& quad = model_.mesh.quads[e];
        work += gather(quad, d_u).dot(viscous_forces(element, eta, gather(quad, v)));
    });
    return work;
}

}  // namespace breach::fem
