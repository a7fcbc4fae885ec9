// The constants of an analysis: mesh, unknowns, masses, weights and the laws of the zones; and its
// variables: the motion of the nodes and the state of the Gauss points.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/motion/series.hpp"
#include "core/scene/scene.hpp"
#include "fem_solver/model/free_field.hpp"
#include "fem_solver/model/porous_element.hpp"

namespace breach::fem {

using materials::State;
using mechanics::Voigt;

/// Consecutive elements of one region: one law, one density.
struct Zone {
    std::size_t first;
    std::size_t count;
    double density;  ///< [kg/m3]
    materials::Law law;
    double viscosity = 0.0;  ///< eta beside the law's stress while it moves [Pa s]
};

/// Damping matrix C = mass M + stiffness K_elastic.
struct Rayleigh {
    double mass = 0.0;       ///< [1/s]
    double stiffness = 0.0;  ///< [s]
};

/// Elastic half-space below the mesh. Shear traction on the base: rho V_s (2 w - v), w the up-going
/// velocity, v the base's own (Lysmer & Kuhlemeyer 1969, Joyner & Chen 1975). An outcrop motion is
/// 2 w, so its force is c v_outcrop, once, not twice. A motion recorded *within* the ground must
/// not be used here.
struct AbsorbingBase {
    Eigen::VectorXd dashpot;  ///< c = rho V_s A per dof, x of the base's nodes; empty: no base
                              ///< [N s/m]
    motion::Series outcrop;   ///< outcrop velocity; empty: rest [m/s]

    bool any() const { return dashpot.size() > 0; }
    /// Adds the force at time t [s] to f [N].
    void add_force(double t, Eigen::VectorXd& f) const {
        if (!outcrop.values.empty()) f += motion::value_at(outcrop, t) * dashpot;
    }
};

/// Stiffness of the hourglass force of the single-point quad.
enum class HourglassModulus {
    current,  ///< c_s from the secant shear modulus of the last step, force continuous
    elastic,  ///< c_s = 4 G always, as in OpenSees
};

struct Model {
    Mesh mesh;
    std::vector<Zone> zones;
    double thickness;               ///< of the body [m]
    double column_thickness = 1.0;  ///< of free-field columns over the body's [-]
    Body body{};                    ///< nodes and elements without the columns
    Constraints constraints;
    PoreWater water;
    AbsorbingBase base;
    std::vector<double> nodal_mass;  ///< lumped by row sums [kg]
    Eigen::VectorXd mass;            ///< the same, one entry per dof [kg]
    Eigen::VectorXd external_force;  ///< weight and any other constant load, per dof [N]
    /// Weight of a dof's force and mass in the sum over its tie; empty: all 1. A column of the
    /// body's own thickness would press on the edge as the ground beyond does: that is a share of 1
    /// / `column_thickness` of the force on the thick column's inner nodes. With this weight, level
    /// ground moves uniformly for any thickness.
    Eigen::VectorXd row_weight;
    std::size_t points_per_element = gauss_points;
    std::vector<Quadrature> reference;   ///< of the undeformed elements
    std::vector<SspGeometry> hourglass;  ///< the same of single-point quads; otherwise empty
    HourglassModulus hourglass_modulus = HourglassModulus::current;
    std::vector<double> volume;  ///< of the undeformed elements [m3]
    scene::Kinematics kinematics = scene::Kinematics::small_strain;
    Rayleigh rayleigh;
    std::vector<char> absent;  ///< [elements] not placed yet or removed; empty: all are there
    /// Force per dof that a stage withholds at first [N], and its release [s]; empty: nothing
    Eigen::VectorXd withheld;
    double withheld_from = 0.0, withheld_for = 0.0;
    /// [nodes] with unknown pore pressure in an undrained static stage; empty in all other stages
    std::vector<bool> undrained;
    /// Prescribed displacements of held nodes over the load of a static stage [m].
    struct Driven {
        Eigen::Index dof;
        double by;
    };
    std::vector<Driven> driven;
    /// Creep of a static stage: epsilon_q over its load, per element, and the strain of this load
    /// step, per point; empty: none [-]
    std::vector<double> creep;
    std::vector<Voigt> creep_step;

    bool is_absent(std::size_t element) const { return !absent.empty() && absent[element] != 0; }
    std::size_t points() const { return mesh.quads.size() * points_per_element; }
    double thickness_of(std::size_t element) const {
        return element < body.elements ? thickness : column_thickness * thickness;
    }
    Unknowns unknowns(Solved solved) const {
        return number_unknowns(
            constraints, solved == Solved::displacement_and_pressure ? undrained : water.is_unknown,
            solved);
    }
    Eigen::Index dofs() const { return static_cast<Eigen::Index>(2 * mesh.nodes.size()); }
};

/// The zones' laws with every region linear elastic (its own E and nu), or the scene's.
std::vector<materials::Law> laws_for(const Model& model, scene::StageLaws laws);

/// Hourglass state of a single-point quad.
struct Hourglass {
    Vec2 force;     ///< Q, work-conjugate to the amplitude q [N]
    double c_s;     ///< modulus for the next increment: dQ = c_s H dq [Pa]
    double energy;  ///< integral of Q dq [J]
};

/// The variables of a time step.
struct Motion {
    Eigen::VectorXd u;          ///< displacement [m], per dof
    Eigen::VectorXd v;          ///< velocity [m/s]
    Eigen::VectorXd a;          ///< acceleration [m/s2]
    Eigen::VectorXd force;      ///< internal force of the stresses [N]
    Eigen::VectorXd p;          ///< pore pressure, per node; empty in a dry scene [Pa]
    Eigen::VectorXd p_rate;     ///< [Pa/s]
    std::vector<State> points;  ///< element by element, Gauss point by Gauss point
    std::vector<Voigt> strain;  ///< total, accumulated over the increments [-]
    /// [zones] memory of the points beside State; empty if no law has one, and in the elastic
    /// stages before
    std::vector<materials::LawMemory> memory;
    /// [points] rotation of the axes of a point's memory [rad]; empty on a mesh that does not move,
    /// and without memory
    std::vector<double> turned;
    std::vector<Hourglass> hourglass;  ///< [elements] of single-point quads; otherwise empty
};

/// A model at rest without stress; pressures as prescribed.
Motion at_rest(const Model& model);

Dofs8 gather(const Quad& quad, const Eigen::VectorXd& values);
/// Corners of an element displaced by u.
Corners displaced_corners(const Model& model, std::size_t element, const Eigen::VectorXd& u);

}  // namespace breach::fem
