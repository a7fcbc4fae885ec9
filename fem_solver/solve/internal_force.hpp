// Stresses and nodal forces from displacements, and the tangent, in passes over strains, laws and
// forces. Small strain on the undeformed mesh.
// Called by Newton in each iteration. Everything per element and point runs on the team's threads;
// sums over nodes stay in order, so that results do not depend on them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "fem_solver/solve/linear_system.hpp"
#include "fem_solver/solve/memory.hpp"
#include "fem_solver/solve/profile.hpp"

namespace breach::fem {

enum class Geometry {
    sound,
    degenerate,  ///< a law refused the strain increment: no forces
};

class InternalForce {
  public:
    /// team: its size does not change the results.
    InternalForce(const Model& model, Seconds& seconds,
                  std::shared_ptr<numerics::Team> team = std::make_shared<numerics::Team>(1));

    /// Sets stresses, strains and nodal forces of `trial` for the displacement trial.u, starting at
    /// `old`.
    Geometry evaluate(const std::vector<materials::Law>& laws, const Motion& old, Motion& trial);
    /// The same, and adds the consistent tangent to A, symmetrised if A is symmetric.
    Geometry evaluate(const std::vector<materials::Law>& laws, const Motion& old, Motion& trial,
                      LinearSystem& A);
    /// Laws with memory: cost of their calls, reason of the last refusal.
    const MemoryPass& memory_pass() const { return memory_; }
    /// After a degenerate evaluation: the element whose law refused, and why.
    std::string why_degenerate() const;
    /// Adds `factor` times the elastic stiffness of the undeformed mesh to A.
    void add_elastic_stiffness(double factor, LinearSystem& A) const;

    /// Whether a zone has viscosity.
    bool is_viscous() const;
    /// Adds `factor` times the viscous forces of the zones at the velocity v to f [N].
    void add_viscous_force(double factor, const Eigen::VectorXd& v, Eigen::VectorXd& f) const;
    /// Adds `factor` [1/s] times their derivative by v to A.
    void add_viscous_damping(double factor, LinearSystem& A) const;
    /// Their dissipation over the displacement d_u at the velocity v [J].
    double viscous_work(const Eigen::VectorXd& v, const Eigen::VectorXd& d_u) const;

  private:
    using Tangent = Eigen::Matrix3d;  ///< rows and columns xx, yy, xy

    void strain_pass(const Motion& old, const Motion& trial);
    void small_strains(std::size_t element, const Motion& old, const Motion& trial);
    enum class Wanted { stress, stress_and_tangent };
    Geometry law_pass(const std::vector<materials::Law>& laws, const Motion& old, Motion& trial,
                      Wanted wanted);
    template <class Law>
    Geometry integrate_zone(const Law& law, std::size_t z, const Motion& old, Motion& trial);
    template <class Law>
    Geometry integrate_zone_with_tangent(const Law& law, std::size_t z, const Motion& old,
                                         Motion& trial);
    template <materials::Remembers Law>
    Geometry integrate_zone(const Law& law, std::size_t z, const Motion& old, Motion& trial);
    template <materials::Remembers Law>
    Geometry integrate_zone_with_tangent(const Law& law, std::size_t z, const Motion& old,
                                         Motion& trial);
    void accumulate_strain(std::size_t begin, std::size_t end, const Motion& old,
                           Motion& trial) const;
    void advance_hourglass(std::size_t begin, std::size_t end, const Motion& old,
                           Motion& trial) const;
    double next_hourglass_modulus(std::size_t element, double now, const Motion& old,
                                  const Motion& trial) const;
    void force_pass(const Motion& old, Motion& trial);
    /// Calls take(element, nodal forces) for the elements [begin, end), in order.
    template <class Take>
    void visit_nodal_forces(std::size_t begin, std::size_t end, const Motion& trial,
                            const Take& take) const;
    void stiffness_pass(const Motion& old, LinearSystem& A) const;
    template <typename Visit>
    void visit_viscous_elements(Visit visit) const;

    const Model& model_;
    const std::size_t points_;  ///< per element
    std::shared_ptr<numerics::Team> team_;
    Seconds& seconds_;
    // Over the whole step, from `old`: laws integrate from the accepted state in each iteration, so
    // that iterations leave no trace in their memories.
    std::vector<Voigt> d_epsilon_;  ///< [points]
    std::vector<Tangent> tangent_;  ///< [points]
    MemoryPass memory_;
    std::vector<double> elastic_c_s_;  ///< single point: [elements] 4 G [Pa]
    std::vector<Vec2> d_q_;     ///< single point: [elements] hourglass amplitude of the step [m]
    std::vector<Dofs8> nodal_;  ///< several threads: [elements] forces, then summed in order [N]
};

/// Elastic stiffness of the undeformed element: integral B^T D B dV [N/m].
Stiffness elastic_stiffness(const Quadrature& quadrature, const mechanics::Elasticity& elasticity);
/// The same with the hourglass part of a single-point quad.
Stiffness elastic_stiffness(const Model& model, std::size_t element,
                            const mechanics::Elasticity& elasticity);

}  // namespace breach::fem
