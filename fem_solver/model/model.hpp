// Constants of an analysis (mesh, unknowns, masses, weights, laws) and its variables (motion of the
// nodes, state of the Gauss points).
// build_model makes the Model; set_stage, set_permeability and close_to_flow change it when a stage
// begins; during steps it is constant.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "core/motion/series.hpp"
#include "core/scene/scene.hpp"
#include "fem_solver/model/free_field.hpp"
#include "fem_solver/model/porous_element.hpp"

namespace breach::fem {

using materials::State;
using mechanics::Voigt;

/// Consecutive elements of a region with the same law and density.
struct Zone {
    std::size_t first;
    std::size_t count;
    double density;  ///< [kg/m3]
    materials::Law law;
    double viscosity = 0.0;  ///< eta of the additional Newtonian stress in dynamic stages [Pa s]
    std::optional<materials::StrengthCurve> dynamic_strength{};  ///< see Model::s_u
    double nonlocal_length = 0.0;                                ///< of softening; 0: local [m]
    double softening_scale = 1.0;  ///< of softening strains, with a nonlocal length
};

/// Damping matrix C = mass M + stiffness K_elastic.
struct Rayleigh {
    double mass = 0.0;       ///< [1/s]
    double stiffness = 0.0;  ///< [s]
};

/// Elastic half-space below the mesh. Shear traction on the base: rho V_s (2 w - v), w the upgoing
/// velocity, v that of the base (Lysmer & Kuhlemeyer 1969, Joyner & Chen 1975). An outcrop motion
/// is 2 w, so its force is c v_outcrop. Motions recorded *within* the ground are not allowed.
struct AbsorbingBase {
    Eigen::VectorXd dashpot;  ///< c = rho V_s A per dof, x of base nodes; empty: no base [N s/m]
    motion::Series outcrop;   ///< outcrop velocity; empty: rest [m/s]

    bool any() const { return dashpot.size() > 0; }
    /// Adds the force at time t [s] to f [N].
    void add_force(double t, Eigen::VectorXd& f) const {
        if (!outcrop.values.empty()) f += motion::value_at(outcrop, t) * dashpot;
    }
};

/// Stiffness of the hourglass force of the single-point quad.
enum class HourglassModulus {
    current,  ///< c_s from the secant shear modulus of the last step; continuous force
    elastic,  ///< c_s = 4 G, as in OpenSees
};

class NonlocalSoftening;

struct Model {
    Mesh mesh;
    std::vector<Zone> zones;
    double thickness;               ///< of the body [m]
    double column_thickness = 1.0;  ///< thickness of free-field columns over that of the body [-]
    Body body{};                    ///< nodes and elements without the columns
    Constraints constraints;
    PoreWater water;
    AbsorbingBase base;
    std::vector<double> nodal_mass;  ///< lumped by row sums [kg]
    Eigen::VectorXd mass;            ///< per dof [kg]
    Eigen::VectorXd external_force;  ///< weight and other constant loads, per dof [N]
    /// Weight of a dof's force and mass in the sum over its tie; empty: 1. A column of the body's
    /// thickness would load the edge like the ground beyond: that is 1 / `column_thickness` of the
    /// force on the inner nodes of the thick column. With this weight, level ground moves uniformly
    /// for any thickness.
    Eigen::VectorXd row_weight;
    std::size_t points_per_element = gauss_points;
    std::vector<Quadrature> reference;   ///< of the undeformed elements
    std::vector<SspGeometry> hourglass;  ///< for single-point quads; else empty
    HourglassModulus hourglass_modulus = HourglassModulus::current;
    std::vector<double> volume;  ///< of the undeformed elements [m3]
    /// Shared by copies, as it does not change; empty: no zone softens over a length.
    std::shared_ptr<const NonlocalSoftening> nonlocal;
    Rayleigh rayleigh;
    // Absent elements keep their places in all arrays: numbers of elements never change.
    std::vector<char> absent;  ///< [elements] not placed yet or removed; empty: all are present
    /// Force per dof withheld at the beginning of a stage [N], from when and over which time it is
    /// released [s]; empty: none.
    Eigen::VectorXd withheld;
    double withheld_from = 0.0, withheld_for = 0.0;
    /// [points] undrained strength from the first dynamic stage on; 0: the law's own strength.
    /// Empty: before that stage, or no zone has one [Pa]
    std::vector<double> s_u;
    /// [nodes] with unknown pore pressure in an undrained static stage; else empty
    std::vector<bool> undrained;
    /// Prescribed displacements of fixed nodes over the load of a static stage [m].
    struct Driven {
        Eigen::Index dof;
        double by;
    };
    std::vector<Driven> driven;

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

/// Laws of the zones: linear elastic (each with its own E and nu), or the scene's.
std::vector<materials::Law> laws_for(const Model& model, scene::StageLaws laws);

/// Hourglass state of a single-point quad.
struct Hourglass {
    Vec2 force;     ///< Q, work-conjugate to the amplitude q [N]
    double c_s;     ///< modulus for the next increment: dQ = c_s H dq [Pa]
    double energy;  ///< integral of Q dq [J]
};

/// The variables of a time step.
/// Two exist during a step: the accepted one that it starts from, and the trial of its end.
struct Motion {
    Eigen::VectorXd u;          ///< displacement [m], per dof
    Eigen::VectorXd v;          ///< [m/s], per dof
    Eigen::VectorXd a;          ///< [m/s2], per dof
    Eigen::VectorXd force;      ///< internal force [N], per dof
    Eigen::VectorXd p;          ///< pore pressure [Pa], per node; empty if dry
    Eigen::VectorXd p_rate;     ///< [Pa/s]
    std::vector<State> points;  ///< [elements * Gauss points]
    std::vector<Voigt> strain;  ///< total, sum of increments [-]
    /// [zones] memory of the points besides State; empty if no law has one, and in elastic stages
    std::vector<materials::LawMemory> memory;
    std::vector<Hourglass> hourglass;  ///< [elements] of single-point quads; else empty
};

/// Rest without stress; pressures as prescribed.
Motion at_rest(const Model& model);

Dofs8 gather(const Quad& quad, const Eigen::VectorXd& values);
Corners displaced_corners(const Model& model, std::size_t element, const Eigen::VectorXd& u);

}  // namespace breach::fem
