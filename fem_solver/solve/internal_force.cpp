#include "fem_solver/solve/internal_force.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <atomic>
#include <cmath>

#include "fem_solver/solve/ranges.hpp"
#include "fem_solver/solve/viscosity.hpp"

namespace breach::fem {

using mechanics::Matrix2;
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
    if (model.kinematics == scene::Kinematics::updated_lagrangian) {
        half_angle_.resize(model.points());
        current_.resize(model.mesh.quads.size());
        gradients_.resize(model.mesh.quads.size());
        hourglass_ = model.hourglass;
    }
    d_q_.resize(model.hourglass.size());
    if (team_->threads() > 1) nodal_.resize(model.mesh.quads.size());
    for (const Zone& zone : model.zones) {
        const double G = materials::elasticity(zone.law).shear_modulus();
        elastic_c_s_.insert(elastic_c_s_.end(), d_q_.empty() ? 0 : zone.count, 4.0 * G);
    }
}

std::string InternalForce::why_degenerate() const {
    if (folded_) return "element " + std::to_string(*folded_) + " turned inside out";
    return in_words(memory_.refusal());
}

const std::vector<Quadrature>& InternalForce::quadratures() const {
    return current_.empty() ? model_.reference : current_;
}

const std::vector<SspGeometry>& InternalForce::hourglasses() const {
    return hourglass_.empty() ? model_.hourglass : hourglass_;
}

Geometry InternalForce::strain_pass(const Motion& old, const Motion& trial) {
    const std::size_t elements = model_.mesh.quads.size();
    folded_.reset();
    if (model_.kinematics == scene::Kinematics::updated_lagrangian) {
        // The first one, for any number of threads: nothing behind a known one counts.
        std::atomic<std::size_t> first = elements;
        for_ranges(elements, *team_, [&](std::size_t begin, std::size_t end) {
            for (std::size_t e = begin; e < end && e < first; ++e) {
                if (moving_strains(e, old, trial) == Geometry::sound) continue;
                std::size_t known = first;
                while (e < known && !first.compare_exchange_weak(known, e)) {
                }
            }
        });
        if (first == elements) return Geometry::sound;
        folded_ = first;
        return Geometry::degenerate;
    }
    for_ranges(elements, *team_, [&](std::size_t begin, std::size_t end) {
        for (std::size_t e = begin; e < end; ++e) small_strains(e, old, trial);
    });
    return Geometry::sound;
}

void InternalForce::small_strains(std::size_t element, const Motion& old, const Motion& trial) {
    const Quad& quad = model_.mesh.quads[element];
    const Dofs8 d_u = gather(quad, trial.u) - gather(quad, old.u);
    for (std::size_t g = 0; g < points_; ++g) {
        d_epsilon_[element * points_ + g] = strain_of(model_.reference[element].B[g], d_u);
    }
    // Strain without creep.
    for (std::size_t g = 0; g < points_ && !model_.creep_step.empty(); ++g)
        d_epsilon_[element * points_ + g] -= model_.creep_step[element * points_ + g];
    if (!d_q_.empty()) d_q_[element] = hourglass_amplitude(model_.hourglass[element], d_u);
    if (!model_.is_absent(element)) return;
    for (std::size_t g = 0; g < points_; ++g) d_epsilon_[element * points_ + g].setZero();
    if (!d_q_.empty()) d_q_[element].setZero();
}

/// Strain increment and rotation from the mid-configuration, exact for rigid rotation (Hughes &
/// Winget 1980, with the exact angle). Leaves the quadrature of the end configuration for the
/// forces.
Geometry InternalForce::moving_strains(std::size_t element, const Motion& old,
                                       const Motion& trial) {
    const Quad& quad = model_.mesh.quads[element];
    const Dofs8 d_u = gather(quad, trial.u) - gather(quad, old.u);
    const Corners end = displaced_corners(model_, element, trial.u);
    const Corners middle = end - 0.5 * Eigen::Map<const Corners>(d_u.data());
    Gradients& gradients = gradients_[element];
    Quadrature& current = current_[element];
    if (evaluate_element(element, middle) == Geometry::degenerate) return Geometry::degenerate;
    if (!d_q_.empty()) d_q_[element] = hourglass_amplitude(hourglass_[element], d_u);
    for (std::size_t g = 0; g < points_; ++g) {
        const std::size_t p = element * points_ + g;
        d_epsilon_[p] = strain_of(current.B[g], d_u);
        const Matrix2 L = Eigen::Map<const Corners>(d_u.data()) * gradients.dN[g].transpose();
        const Matrix2 half = 0.5 * L;
        const Matrix2 F = (Matrix2::Identity() - half).inverse() * (Matrix2::Identity() + half);
        half_angle_[p] = 0.5 * mechanics::rotation_angle(F);
    }
    return evaluate_element(element, end);
}

/// Gradients and quadrature on the moving mesh.
Geometry InternalForce::evaluate_element(std::size_t element, const Corners& x) {
    Gradients& gradients = gradients_[element];
    evaluate_gradients(x, model_.thickness_of(element), gradients);
    for (const double weight : gradients.weight) {
        if (!(weight > 0.0)) return Geometry::degenerate;
    }
    if (hourglass_.empty()) {
        evaluate_quadrature(gradients, current_[element]);
    } else {
        evaluate_ssp(x, model_.thickness_of(element), hourglass_[element]);
        use_centre_only(hourglass_[element], gradients, current_[element]);
    }
    return Geometry::sound;
}

template <class Law>
Geometry InternalForce::integrate_zone(const Law& law, std::size_t z, const Motion& old,
                                       Motion& trial) {
    const Zone& zone = model_.zones[z];
    const std::size_t first = zone.first * points_;
    const auto still = [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = first + begin; p < first + end; ++p)
            trial.points[p] = materials::integrate(law, old.points[p], d_epsilon_[p]).state;
    };
    const auto turning = [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = first + begin; p < first + end; ++p) {
            State turned = old.points[p];
            turned.sigma = mechanics::rotated_stress(turned.sigma, half_angle_[p]);
            turned = materials::integrate(law, turned, d_epsilon_[p]).state;
            turned.sigma = mechanics::rotated_stress(turned.sigma, half_angle_[p]);
            trial.points[p] = turned;
        }
    };
    if (half_angle_.empty())
        for_ranges(zone.count * points_, *team_, still);
    else
        for_ranges(zone.count * points_, *team_, turning);
    return Geometry::sound;
}

template <class Law>
Geometry InternalForce::integrate_zone_with_tangent(const Law& law, std::size_t z,
                                                    const Motion& old, Motion& trial) {
    const Zone& zone = model_.zones[z];
    const std::size_t first = zone.first * points_;
    const bool turns = !half_angle_.empty();
    for_ranges(zone.count * points_, *team_, [&](std::size_t begin, std::size_t end) {
        Matrix4 D;
        for (std::size_t p = first + begin; p < first + end; ++p) {
            State start = old.points[p];
            if (turns) start.sigma = mechanics::rotated_stress(start.sigma, half_angle_[p]);
            State reached = materials::integrate(law, start, d_epsilon_[p], D).state;
            if (turns) reached.sigma = mechanics::rotated_stress(reached.sigma, half_angle_[p]);
            trial.points[p] = reached;
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
    const std::span half_angles =
        half_angle_.empty()
            ? std::span<const double>()
            : std::span(half_angle_).subspan(zone.first * points_, d_epsilon.size());
    return memory_.integrate(law, z, d_epsilon, half_angles, old, trial) == MemoryPass::Answer::done
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
        const auto pass = [&](const auto& parameters) {
            const auto& law = materials::ready(parameters);
            return wanted == Wanted::stress ? integrate_zone(law, z, old, trial)
                                            : integrate_zone_with_tangent(law, z, old, trial);
        };
        if (std::visit(pass, laws[z]) == Geometry::degenerate) return Geometry::degenerate;
    }
    return Geometry::sound;
}

void InternalForce::accumulate_strain(std::size_t begin, std::size_t end, const Motion& old,
                                      Motion& trial) const {
    if (half_angle_.empty()) {
        for (std::size_t p = begin * points_; p < end * points_; ++p)
            trial.strain[p] = old.strain[p] + d_epsilon_[p];
        for (std::size_t p = begin * points_; p < end * points_ && !model_.creep_step.empty(); ++p)
            trial.strain[p] += model_.creep_step[p];
        return;
    }
    for (std::size_t p = begin * points_; p < end * points_; ++p) {
        const double half = half_angle_[p];
        const Voigt turned = mechanics::rotated_strain(old.strain[p], half) + d_epsilon_[p];
        trial.strain[p] = mechanics::rotated_strain(turned, half);
    }
}

/// Q += c_s H dq with the modulus of the last accepted step: the tangent is exact and symmetric,
/// and the force is continuous when the modulus changes. On a moving mesh Q rotates with the
/// element. H of the end configuration replaces that of the middle, as in the tangent.
void InternalForce::advance_hourglass(std::size_t begin, std::size_t end, const Motion& old,
                                      Motion& trial) const {
    const std::vector<SspGeometry>& geometries = hourglasses();
    const auto pass = [&](const auto& turned) {
        for (std::size_t e = begin; e < end; ++e) {
            const Hourglass& before = old.hourglass[e];
            Hourglass& after = trial.hourglass[e];
            const Vec2 first = turned(e, before.force);
            const Vec2 last = first + before.c_s * (geometries[e].H * d_q_[e]);
            after.energy = before.energy + 0.5 * (first + last).dot(d_q_[e]);
            after.force = turned(e, last);
            after.c_s = next_hourglass_modulus(e, before.c_s, old, trial);
        }
    };
    if (half_angle_.empty()) {
        pass([](std::size_t, const Vec2& force) { return force; });
    } else {
        pass([&](std::size_t e, const Vec2& force) -> Vec2 {
            return Eigen::Rotation2Dd(half_angle_[e]) * force;
        });
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
    Voigt d_sigma = trial.points[e].sigma - old.points[e].sigma;
    if (!half_angle_.empty()) {
        d_sigma = mechanics::rotated_stress(trial.points[e].sigma, -half_angle_[e]) -
                  mechanics::rotated_stress(old.points[e].sigma, half_angle_[e]);
    }
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
    const std::vector<Quadrature>& current = quadratures();
    const std::vector<SspGeometry>& geometries = hourglasses();
    for (std::size_t e = begin; e < end; ++e) {
        const Quadrature& q = current[e];
        Dofs8 f = Dofs8::Zero();
        for (std::size_t g = 0; g < points_; ++g) {
            const Voigt& s = trial.points[e * points_ + g].sigma;
            const Eigen::Vector3d sigma = q.weight[g] * Eigen::Vector3d(s[0], s[1], s[3]);
            f.noalias() += q.B[g].transpose() * sigma;
        }
        if (!d_q_.empty()) f += hourglass_forces(geometries[e], trial.hourglass[e].force);
        if (model_.is_absent(e)) f.setZero();
        take(e, f);
    }
}

void InternalForce::stiffness_pass(const Motion& old, const Motion& trial, LinearSystem& A) const {
    const bool symmetric = A.symmetry() == Symmetry::symmetric;
    const std::vector<Quadrature>& current = quadratures();
    const std::vector<SspGeometry>& geometries = hourglasses();
    for (std::size_t e = 0; e < model_.mesh.quads.size(); ++e) {
        if (model_.is_absent(e)) continue;
        const Quadrature& q = current[e];
        Stiffness K = Stiffness::Zero();
        for (std::size_t g = 0; g < points_; ++g) {
            const std::size_t p = e * points_ + g;
            Tangent C = q.weight[g] * tangent_[p];
            if (symmetric) C = (0.5 * (C + C.transpose())).eval();
            const StrainOperator CB = C * q.B[g];
            K.noalias() += q.B[g].transpose() * CB;
            if (current_.empty()) continue;
            const Voigt& s = trial.points[p].sigma;
            Matrix2 sigma;
            sigma << s[0], s[3], s[3], s[1];
            const Gradient& dN = gradients_[e].dN[g];
            const Eigen::Matrix4d initial = q.weight[g] * dN.transpose() * sigma * dN;
            for (int j = 0; j < 4; ++j) {
                for (int i = 0; i < 4; ++i) {
                    K(2 * i, 2 * j) += initial(i, j);
                    K(2 * i + 1, 2 * j + 1) += initial(i, j);
                }
            }
        }
        if (!d_q_.empty()) K += hourglass_stiffness(geometries[e], old.hourglass[e].c_s);
        A.add_element(e, K);
    }
}

Geometry InternalForce::evaluate(const std::vector<materials::Law>& laws, const Motion& old,
                                 Motion& trial) {
    {
        const Stopwatch watch(seconds_, &Seconds::assembly);
        if (strain_pass(old, trial) == Geometry::degenerate) return Geometry::degenerate;
    }
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
        if (strain_pass(old, trial) == Geometry::degenerate) return Geometry::degenerate;
    }
    if (law_pass(laws, old, trial, Wanted::stress_and_tangent) == Geometry::degenerate) {
        return Geometry::degenerate;
    }
    const Stopwatch watch(seconds_, &Seconds::assembly);
    force_pass(old, trial);
    stiffness_pass(old, trial, A);
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
                  ElementOperators{quadratures()[e], points_,
                                   d_q_.empty() ? nullptr : &hourglasses()[e]},
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
