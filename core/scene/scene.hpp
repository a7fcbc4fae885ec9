// The scene: one physical problem, read from JSON, checked whole, held as plain structs in SI and
// radians. Every field's meaning, unit, range and default is in workflows/schema/scene.schema.json.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/fault/fault.hpp"
#include "core/fault/flag.hpp"
#include "core/geometry/section.hpp"
#include "core/grid/scheme.hpp"
#include "core/materials/law.hpp"
#include "core/materials/strength/profile.hpp"

namespace breach::scene {

using geometry::Box;
using geometry::Polygon;
using mechanics::Vec2;

/// Strength at failure.
struct LimitStrength {
    double c;    ///< [Pa]
    double phi;  ///< [rad]
};

/// Width of a shear band under nonlocal softening, in nonlocal lengths, for any cells [-].
constexpr double band_in_nonlocal_lengths = 2.5;

struct Material {
    std::string name;
    double density;  ///< [kg/m3]
    materials::Law law;
    double viscosity = 0.0;  ///< Newtonian stress beside the law's, 2 eta dev D [Pa s]
    /// mpm: its softening strains are averaged over this length [m]
    std::optional<double> nonlocal_length{};
    std::optional<double> void_ratio{};                   ///< fem with water [-]
    std::optional<std::array<double, 2>> permeability{};  ///< hydraulic conductivity, x, y [m/s]
    std::optional<LimitStrength> limit_strength{};        ///< lem: instead of the law's
    /// For every phase that has no entry of its own for this soil
    std::optional<materials::StrengthProfile> strength{};
};

/// lem: limit_strength, or a law with c_kPa and phi_deg, comes before the profile.
inline bool lem_takes_profile(const Material& material) {
    const bool law_has_own = materials::traits(material.law).c_and_phi &&
                             !materials::has_strength_of_points(material.law);
    return material.strength && !material.limit_strength && !law_has_own;
}

/// How a region is meshed: a block mapped between four of its vertices, or unstructured quads.
enum class RegionMesh { block, unstructured };

/// Structured strips at the far ends of a region, their columns widening away from the rest.
struct MeshGrading {
    std::optional<double> left_of;   ///< x where the left strip ends [m]
    std::optional<double> right_of;  ///< x where the right strip begins [m]
    double largest = 0.0;            ///< width of the farthest column [m]
    bool any() const { return left_of || right_of; }
};

struct Region {
    std::string name;
    std::size_t material;  ///< index into Scene::materials
    Polygon polygon;       ///< counter-clockwise, first vertex not repeated
    RegionMesh mesh = RegionMesh::block;
    std::array<std::size_t, 4> corners{};  ///< block: indices into polygon, counter-clockwise
    std::array<int, 2> divisions{};  ///< block: elements along corner 0-1 and along corner 1-2; 0:
                                     ///< from element_size
    double element_size = 0.0;       ///< wanted edge length [m]
    MeshGrading grading{};
};

struct Section {
    std::vector<Region> regions;

    /// For the queries of core/geometry/section.hpp.
    operator geometry::Outlines() const { return geometry::outlines_of(regions, &Region::polygon); }
};

// ---------------------------------------------------------------- lem_tool

struct Circle {
    Vec2 center;
    double radius;
};

struct SlipSearch {
    std::array<double, 2> entry;  ///< x range of the upper end of the surface [m]
    std::array<double, 2> exit;   ///< x range of the lower end [m]
    int entry_points;
    int exit_points;
    int depths;                            ///< circles per pair of ends, from shallow to deep
    double minimum_depth;                  ///< least depth of sliding mass below ground [m]
    std::optional<double> lowest_level{};  ///< no surface reaches below [m]
};

/// Vertical crack at the upper end of every surface: as deep as `depth`, or down to `level`.
struct TensionCrack {
    std::optional<double> depth;  ///< below ground [m]
    std::optional<double> level;  ///< y of its foot [m]
    double filled;                ///< share of its height under water [-]
};

/// Slices to which the limit on m_alpha applies, and how a given circle below it is treated.
enum class MAlphaSlices { frictional, all };
enum class SmallMAlpha { answered, refused };

/// m_alpha = cos a + sin a tan phi / F of a slice must not be below `least`.
struct MAlphaLimit {
    double least = 0.2;  ///< Whitman & Bailey (1967) [-]
    MAlphaSlices slices = MAlphaSlices::frictional;
    SmallMAlpha given_circle = SmallMAlpha::answered;
};

/// Surfaces of straight pieces, by Spencer's method.
struct NonCircular {
    std::vector<Vec2> given;  ///< ascending in x; empty: none [m]
    int vertices;             ///< of the optimised surface; 0: nothing is optimised
};

/// u below the phreatic line: gamma_w times the depth, or that times cos^2 of its inclination.
enum class PhreaticCorrection { none, cos2 };

/// Hydrostatic water below (and, where it lies above ground, free water above) a line.
struct Water {
    std::vector<Vec2> line;  ///< ascending in x, level beyond its ends [m]
    double density;          ///< [kg/m3]
    PhreaticCorrection correction;
    std::vector<std::size_t> regions;  ///< whose pores it fills, indices into the section's; empty:
                                       ///< all that no other line names
};

struct PorePressureRatio {
    std::size_t region;  ///< index into the section's regions
    double r_u;          ///< u over the vertical total stress of the soil [-]
};

/// Vertical pressure on the ground for x in [from, to].
struct Surcharge {
    double from;      ///< [m]
    double to;        ///< [m]
    double pressure;  ///< [Pa]
};

/// Force on the ground per metre of slope.
struct LineLoad {
    double x;      ///< [m]
    double down;   ///< [N/m]
    double right;  ///< [N/m]
};

/// s = constant + coefficient (sigma'_v0 / p_a)^exponent, p_a = 101.325 kPa; phi = 0.
struct UndrainedStrength {
    double constant;      ///< [Pa]
    double coefficient;   ///< [Pa]
    double exponent;      ///< [-]
    double factor = 1.0;  ///< on the profile's or the law's where the entry takes that [-]
    std::optional<materials::OnPath> on_path{};  ///< instead, the material's law says it
    std::shared_ptr<const materials::UndrainedByPlace>
        by_state{};  ///< from the law, where it is needed

    /// Has no strength of its own: the residual strength of the material's profile applies, if any.
    bool is_of_profile() const { return constant == 0.0 && coefficient == 0.0 && !on_path; }
};

struct UndrainedRegion {
    std::size_t region;  ///< index into the section's regions
    UndrainedStrength strength;
    std::optional<std::array<double, 2>> levels{};  ///< of the part concerned, low to high [m]
};

/// Which surface the variations of a parameter are analysed on.
enum class VariedSurface { fixed, searched };

struct Sensitivity {
    double change;  ///< share of each strength parameter [-]
    VariedSurface surface;
    std::size_t layers_liquefied;
};

enum class Parameter {
    cohesion,
    friction_angle,
    density,
    undrained_strength,
    residual_strength,
    seismic_coefficient
};
enum class Distribution { normal, lognormal };

/// `of` counts the materials, or the entries of Lem::undrained or Lem::liquefaction.
struct RandomVariable {
    Parameter parameter;
    std::size_t of;
    Distribution distribution;
    double variation;  ///< standard deviation over mean [-]
};

struct Probability {
    int samples;
    std::uint64_t seed;
    VariedSurface surface;
    std::size_t layers_liquefied;
    std::vector<RandomVariable> variables;
};

struct Lem {
    std::optional<Circle> circle;
    std::optional<SlipSearch> search;
    int slices;
    std::optional<Water> water;
    std::vector<Water> piezometric_lines;  ///< pore pressure of their regions; never free water
    std::vector<PorePressureRatio> pore_pressure_ratios;
    double seismic_coefficient;  ///< k_h, towards the slide [-]
    std::vector<Surcharge> surcharge;
    std::vector<LineLoad> line_loads;
    std::vector<Vec2> floor;  ///< ascending in x, level beyond its ends; empty: none [m]
    std::optional<TensionCrack> tension_crack;
    MAlphaLimit m_alpha;
    std::optional<NonCircular> non_circular;
    std::vector<UndrainedRegion> undrained;
    std::vector<UndrainedRegion> liquefaction;  ///< from the top down, one more per stage
    /// Regions whose weight came too fast to consolidate the soil below: sigma'_v0 is without it
    std::vector<std::size_t> unconsolidated;
    std::optional<Sensitivity> sensitivity;
    std::optional<Probability> probability;
};

// ---------------------------------------------------------------- fem_solver

enum class Kinematics { small_strain, updated_lagrangian };

/// bbar: 2 x 2 Gauss points, mean dilatation. ssp: one point, stabilised.
enum class ElementKind { bbar, ssp };
/// Modulus of the ssp quad's stabilisation: the soil's current one, or always the elastic one.
enum class HourglassKind { current, elastic };
/// Effect of a folded corner on an analysis: it ends, or notes an event. Small strain computes on
/// the undeformed mesh and can continue.
enum class AtEntanglement { stop, go_on };

struct MeshSource {
    std::optional<std::filesystem::path> msh_file;  ///< absolute; otherwise meshed from the regions
};

/// Nodes on the segment from-to are held in x, y or both.
struct Support {
    std::string name;
    Vec2 from;
    Vec2 to;
    bool fixes_x;
    bool fixes_y;
};

enum class StageKind { static_equilibrium, dynamic };
enum class StageLaws { elastic, scene };
/// free_drainage: 1 m/s everywhere; scene: the materials' own.
enum class StagePermeability { free_drainage, scene };

/// Nodes on the segment have the pressure of water standing at `level`; without one p = 0.
struct PressureBoundary {
    std::string name;
    Vec2 from;
    Vec2 to;
    std::optional<double> level;  ///< [m]
};

/// Nodes on the segment are held in the given directions, and moved so far over a stage.
struct Displacement {
    std::string name;
    Vec2 from;
    Vec2 to;
    std::optional<double> x;  ///< [m]
    std::optional<double> y;  ///< [m]
};

/// Pressure on the soil's outer edges that lie on the segment.
struct EdgePressure {
    std::string name;
    Vec2 from;
    Vec2 to;
    double pressure;  ///< into the soil [Pa]
};

/// A force on the node next to a place.
struct NodeForce {
    std::string name;
    Vec2 at;
    double within;  ///< farthest that the node may be from the place [m]
    Vec2 force;     ///< per metre of thickness [N/m]
};

/// Creep of a region: strain without stress, at constant volume in the plane.
struct Creep {
    std::size_t region;
    double epsilon_q;  ///< sqrt(2/3 e:e), along the present deviator in the plane [-]
};

struct Stage {
    std::string name;
    StageKind kind;
    StageLaws laws;
    StagePermeability permeability = StagePermeability::scene;
    int load_steps = 1;            ///< static: equal parts of gravity
    double duration = 0.0;         ///< dynamic [s]
    double time_step = 0.0;        ///< dynamic, largest [s]
    double least_time_step = 0.0;  ///< dynamic: below this the run ends [s]
    std::optional<double> S{};     ///< additional softening, where the stage says [-]
    /// [regions] the same of a region alone, drained or not; empty: of none
    std::vector<std::optional<double>> S_of_region{};
    std::vector<std::size_t> activates{};  ///< regions that are there from this stage on
    std::vector<std::size_t> removes{};    ///< regions that are gone from this stage on
    std::vector<std::size_t> releases{};   ///< supports that are removed
    /// From this stage on, instead of the earlier surcharges
    std::optional<std::vector<Surcharge>> surcharge{};
    /// static: from this stage on, instead of the one before; ascending in x [m]
    std::optional<std::vector<Vec2>> phreatic_line{};
    /// static: from this stage on, instead of those before
    std::optional<std::vector<PressureBoundary>> water_boundaries{};
    /// static: regions whose water does not flow in this stage
    std::vector<std::size_t> undrained{};
    /// From this stage on, instead of the earlier one
    std::optional<double> seismic_coefficient{};  ///< horizontal body force over weight [-]
    std::optional<std::vector<EdgePressure>> pressures{};
    std::optional<std::vector<NodeForce>> forces{};
    std::vector<Displacement> displacements{};  ///< static: held from this stage on
    std::vector<Creep> creep{};                 ///< static: over the stage
    double ramp = 0.0;              ///< dynamic: unbalanced forces are applied over this time [s]
    bool goes_on_at_limit = false;  ///< static: a limit point ends the stage, not the run

    bool moves_the_water() const { return phreatic_line || water_boundaries; }
    bool changes_the_body() const {
        return !activates.empty() || !removes.empty() || !releases.empty() || surcharge ||
               moves_the_water() || !undrained.empty() || seismic_coefficient || pressures ||
               forces || !displacements.empty() || !creep.empty();
    }
};

/// Soil above the phreatic line: p = 0 at its nodes, or no pore water at all.
enum class AboveWater { drained, dry };

/// How the ssp quad integrates storage and conduction: at one point, which is blind to a pressure
/// that alternates from node to node, or fully.
enum class PressureIntegration { full, one_point };

/// Pore water below a phreatic line.
struct GroundWater {
    std::vector<Vec2> line;  ///< ascending in x, level beyond its ends [m]
    double density;          ///< [kg/m3]
    double bulk_modulus;     ///< K_f [Pa]
    AboveWater above;
    double pressure_stabilisation;  ///< alpha over h^2 / (K + 4G/3) [-]
    PressureIntegration pressure_integration;
    std::vector<PressureBoundary> boundaries;
    std::string boundaries_at = "/fem/water/boundaries";  ///< their entry in the scene
};

/// Type of a motion from below: of the rock's free surface (twice the up-going wave), or that wave.
enum class MotionAt { outcrop, upgoing };
/// tied: the base moves as one in x.
enum class BaseNodes { tied, free };

/// Elastic half-space below the mesh.
struct ElasticBase {
    double density;  ///< [kg/m3]
    double V_s;      ///< [m/s]
    MotionAt motion_at;
    BaseNodes nodes;
};

enum class Baseline { as_recorded, corrected };

struct BaseMotion {
    std::filesystem::path file;            ///< absolute
    std::optional<double> scale_to_pga_g;  ///< [g]
    Baseline baseline;
};

enum class FreeFieldSides { left, right, both };

struct FreeField {
    double width;             ///< [m]
    double thickness_factor;  ///< over the section's thickness [-]
    FreeFieldSides sides;
};

/// How deep liquefaction reaches: the deepest node with r_u above the threshold.
struct LiquefactionWatch {
    std::vector<std::size_t> regions;  ///< whose nodes count
    std::array<double, 2> x;           ///< between these [m]
    double level;                      ///< where depth is zero [m]
    double r_u;                        ///< threshold [-]
    double least_stress;  ///< nodes with less sigma'_v0 have no ratio [Pa, compression positive]
};

struct Fem {
    Kinematics kinematics;
    ElementKind element;
    HourglassKind hourglass;  ///< ssp only
    MeshSource mesh;
    std::vector<Support> supports;
    std::vector<Stage> stages;
    std::optional<GroundWater> water;
    std::optional<ElasticBase> base;
    std::optional<BaseMotion> motion;
    std::optional<FreeField> free_field;
    std::vector<Surcharge> surcharge;
    double largest_step_error;  ///< 0: steps follow the iterations alone [m]
    double newmark_beta;
    double newmark_gamma;
    double rayleigh_mass;                       ///< alpha [1/s]
    double rayleigh_stiffness;                  ///< beta [s]
    std::optional<double> damping_frequency{};  ///< at which the ratio was given [Hz]
    double force_tolerance;                     ///< residual norm over reference force norm [-]
    int largest_iterations;
    double least_jacobian_ratio;  ///< entangled below this [-]
    AtEntanglement at_entanglement;
    Vec2 crest;               ///< monitored point; nearest node is used [m]
    double strain_threshold;  ///< averages are over elements with epsilon_q above this [-]
    std::optional<LiquefactionWatch> liquefaction;
    double failure_strain;               ///< bands of elements above this are failure surfaces [-]
    double failure_separation;           ///< places of the ground closer than this are one [m]
    std::vector<double> snapshot_times;  ///< ascending; steps are cut to meet them [s]
    double snapshot_interval;            ///< no step is cut for these; 0: none [s]
    double telemetry_interval;           ///< [s]
    std::optional<double> strength_interval;  ///< of undrained strength by state; none: never [s]

    /// Whether a stage changes the body, its supports, its loads or its water.
    bool changes_the_body() const {
        for (const Stage& stage : stages)
            if (stage.changes_the_body()) return true;
        return false;
    }
    bool moves_the_water() const {
        for (const Stage& stage : stages)
            if (stage.moves_the_water()) return true;
        return false;
    }
    /// The water with the phreatic line and the boundaries that are in force in a stage.
    std::optional<GroundWater> water_in(std::size_t stage) const {
        std::optional<GroundWater> now = water;
        for (std::size_t s = 0; now && s <= stage; ++s) {
            if (stages[s].phreatic_line) now->line = *stages[s].phreatic_line;
            if (!stages[s].water_boundaries) continue;
            now->boundaries = *stages[s].water_boundaries;
            now->boundaries_at = "/fem/stages/" + std::to_string(s) + "/water_boundaries";
        }
        return now;
    }
    /// Regions [regions of the section] that are absent in a stage: yet to be placed, or removed.
    std::vector<bool> regions_gone(std::size_t regions, std::size_t stage) const {
        std::vector<bool> gone(regions, false);
        for (const Stage& each : stages)
            for (const std::size_t r : each.activates)
                if (r < regions) gone[r] = true;
        for (std::size_t s = 0; s <= stage; ++s) {
            for (const std::size_t r : stages[s].activates)
                if (r < regions) gone[r] = false;
            for (const std::size_t r : stages[s].removes)
                if (r < regions) gone[r] = true;
        }
        return gone;
    }
};

// ---------------------------------------------------------------- transfer_tool

enum class Interpolation { local, paper };
enum class SofteningStart { carried, zero };

/// The r_u that makes a node liquefied: the largest since the shaking began, or that of t_T.
enum class LiquefiedWhen { ever, at_transfer };
/// Treatment of an element that the FEM has turned inside out.
enum class Entangled { refuse, rebuild };
/// Stress for frictional laws: the effective stress, with the pore pressure beside it, or the total
/// one. All other laws (phi = 0, elastic) get the total stress.
enum class TransferredStress { total, effective };

/// Soil of a region that becomes another material in the MPM.
struct SoilMapping {
    std::size_t region;                      ///< index into the section's regions
    std::size_t material;                    ///< index into Scene::materials
    std::optional<std::size_t> saturated{};  ///< the material below the phreatic line instead
};

/// Liquefied soil with initial vertical effective stress in [from, to).
struct LiquefiedLayer {
    double from;  ///< [Pa]
    double to;    ///< [Pa]
    std::size_t material;
};

/// Soil above the line counts as liquefied at this transfer, and so does the soil left of it above
/// its left end.
struct LiquefiedLine {
    double transfer_time;        ///< [s]
    std::array<Vec2, 2> points;  ///< from left to right [m]
};

struct LiquefiedZone {
    std::vector<std::size_t> regions;  ///< whose soil can liquefy
    double r_u;                        ///< liquefied above this pore pressure ratio [-]
    LiquefiedWhen when;
    /// From 0, without gaps; the last also holds what is beyond. Empty: soil keeps its material,
    /// with the residual strength of that material's profile
    std::vector<LiquefiedLayer> layers;
    double narrowest_wall = 0.0;  ///< a narrower wall of unliquefied soil liquefies, too [m]
    std::vector<LiquefiedLine> lines{};
};

/// Which transfer times the advice is about; expressions of core/criteria over FEM telemetry.
struct AdviceWindow {
    std::string lower;  ///< the failure has developed
    std::string upper;  ///< the mesh is too distorted
    double hold;        ///< [s]
    std::string pick;   ///< "midpoint", "first" or "last_before"
};

enum class BaseDisplacement { kept, subtracted };
/// sigma_zz of the points: from the FEM, or zero, as a transfer of three components leaves it.
enum class OutOfPlaneStress { carried, zero };

struct Transfer {
    int points_per_direction;
    std::optional<int> points_per_cell{};  ///< that every filled cell of the MPM must get
    /// Moves the points along xi and eta: 0 Gauss, +-1 a point on the panel's border [-]
    std::array<double, 2> point_shift{};
    Interpolation interpolation;
    int neighbours;
    Entangled entangled = Entangled::refuse;
    TransferredStress stress = TransferredStress::total;
    std::vector<SoilMapping> mapping{};
    std::vector<Vec2> phreatic_line{};  ///< ascending in x, level beyond its ends [m]
    std::optional<LiquefiedZone> liquefied{};
    SofteningStart softening_start;
    BaseDisplacement base_displacement = BaseDisplacement::kept;
    OutOfPlaneStress sigma_zz = OutOfPlaneStress::carried;
    std::optional<std::array<double, 2>> keep_x{};  ///< points outside are left out [m]
    bool round_trip = false;                        ///< measure points back to the mesh
    double largest_mass_loss;                       ///< relative; more fails the transfer
    double largest_momentum_loss;                   ///< relative
    double largest_kinetic_energy_loss = 0.005;     ///< relative
    std::optional<AdviceWindow> window{};
};

// ---------------------------------------------------------------- mpm_solver

using Kernel = grid::KernelKind;
using grid::UpdateOrder;
/// automatic: on where the law is plastic or nu > 0.45.
enum class AntiLocking { on, off, automatic };
enum class Wall { roller, fixed, open };

/// How the ground moves during the runout.
enum class Shaking {
    off,      ///< not at all: the earthquake ends with the transfer
    goes_on,  ///< as the base of the FEM's free-field columns does; the grid moves with it
};

/// Stress of points that fill the section: none, or the weight of the soil above, sigma_h = K_0
/// sigma_v with K_0 = nu / (1 - nu).
enum class FillStress { none, overburden };

/// Coulomb friction of the floor, or of the terrain, for x in [from, to].
struct FrictionZone {
    double from;
    double to;
    double coefficient;
};

struct Floor {
    double level;                        ///< y of the floor [m]
    std::vector<FrictionZone> friction;  ///< ascending in x, empty: fixed (no slip)
};

/// Pushes overlapping soil apart: the volume rate of a point gets -rate max(0, fill - 1 -
/// tolerance).
struct OverlapCorrection {
    double rate = 0.0;       ///< 0: none [1/s]
    double tolerance = 0.1;  ///< [-]
};

struct Runout {
    Vec2 toe;
    std::vector<std::string> regions;  ///< mobile regions that count; empty: all
    double front_depth = 1.0;          ///< the front is the farthest place with this depth [m]
};

/// A place where flow depth and velocity are recorded.
struct Gauge {
    std::string name;
    double x;              ///< [m]
    double arrival_depth;  ///< the flow has arrived when it is this deep [m]
};

/// A place through which soil leaves the model: its hydrograph is recorded.
struct FlowSection {
    std::string name;
    double x;  ///< [m]
};

/// Width of the breach across the section that is modelled [m].
struct BreachWidth {
    double low;
    double best;
    double high;
};

/// Fields of a point beside position and region, by their names in the exchange files.
enum class PointField {
    velocity,
    velocity_gradient,
    mass,
    volume_0,
    volume,
    stress,
    epsilon_q,
    epsilon_q_plastic,
    gap,
    r_u,
};

struct Output {
    std::vector<PointField> fields{};  ///< of the points, in every frame
};

/// When the mobile soil is at rest. Limits that depend on the scene's size are resolved.
struct Rest {
    double change;                 ///< the front moved no more than this over the window [m]
    double window;                 ///< [s]
    double earliest;               ///< never before [s]
    double speed;                  ///< slower soil counts as still [m/s]
    double body_share = 0.005;     ///< of the mobile mass: connected bodies that may move [-]
    double kinetic_share = 0.005;  ///< of the energy released: largest kinetic energy [-]
    double peak_share = 0.05;      ///< of the largest kinetic energy so far [-]
};

struct Mpm {
    double cell_size;  ///< [m]
    bool allow_coarse_cells = false;
    std::array<double, 2> domain_x;  ///< [m]
    std::array<double, 2> domain_y;  ///< [m]
    Wall left;
    Wall right;
    Floor floor;
    /// Ascending in x, straight beyond its ends; empty: the floor [m]
    std::vector<Vec2> terrain{};
    Kernel kernel;
    double gimp_half_size;  ///< fraction of the cell [-]
    UpdateOrder order;
    double blending_rate;  ///< affine PIC rate beta [1/s]
    /// Share of critical damping of soil that does not yield, at the mobile height's frequency [-]
    double damping_ratio = 0.0;
    /// Least tensile strength over the unconfined compressive strength in force [-]
    double tension_share = 0.0;
    AntiLocking anti_locking;
    bool gap_closure;
    /// Limits open volume to the room between the neighbours; by default on where more than a tenth
    /// of the terrain is steeper than 30 degrees and debris falls on other soil
    bool gap_room = false;
    OverlapCorrection overlap_correction{};
    /// Softening strains are those of cells this long [m]
    std::optional<double> softening_length{};
    double stiffness_scale;                    ///< factor on E, reported [-]
    std::optional<double> wave_speed_limit{};  ///< of compression, soil is softer for it [m/s]
    std::optional<double> time_step;           ///< fixed [s]; otherwise by CFL
    double cfl;                                ///< [-]
    double duration;                           ///< longest [s]
    bool until_rest = false;                   ///< asked for: `duration` is the bound on it
    Rest rest;
    Runout runout;
    std::vector<Gauge> gauges{};
    double arrival_depth = 0.1;  ///< of the envelope: the flow has arrived when it is this deep [m]
    std::vector<FlowSection> sections{};
    std::optional<BreachWidth> breach_width{};
    double snapshot_interval;  ///< [s]
    Output output{};
    double telemetry_interval;   ///< [s]
    double checkpoint_interval;  ///< wall clock [s]
    double largest_energy_gain;  ///< relative to the energy released; more ends the run [-]
    int fill_points;             ///< points per cell and direction when no particles are given
    std::array<double, 2> fill_shift{};  ///< moves the squares of the filling, in squares [-]
    FillStress fill_stress = FillStress::none;
    Shaking shaking = Shaking::off;
};

struct Scene {
    std::string name;
    std::string title;
    double gravity;    ///< [m/s2], downwards
    double thickness;  ///< [m]
    std::vector<Material> materials;
    Section section;
    std::optional<Lem> lem;
    std::optional<Fem> fem;
    std::optional<Transfer> transfer;
    std::optional<Mpm> mpm;
    std::string completed;              ///< the JSON text with every default filled in, keys sorted
    std::vector<fault::Flag> warnings;  ///< entries that are possible and hardly meant
};

/// Soil of a material point: of a region, of one material.
struct Soil {
    std::size_t region;    ///< index into the section's regions
    std::size_t material;  ///< index into materials
    bool operator==(const Soil&) const = default;
};

/// All soils of this scene's points. The first ones are the section's regions, in their order, each
/// of the material that the MPM gives it; then the parts that /transfer separates: saturated parts,
/// liquefied layers.
std::vector<Soil> soils_of(const Scene& scene);

/// Reads and checks a scene; `overrides` are "/json/pointer=value". Throws BadInput with every
/// fault, IoError if the file cannot be read.
Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// The same from text; relative paths in it are taken from `folder`, `name` is used in messages.
Scene parse_scene(std::string_view text, const std::string& name,
                  const std::filesystem::path& folder = ".",
                  const std::vector<std::string>& overrides = {});

/// Throws BadInput when the scene has no part for this phase ("/mpm" missing).
const Fem& fem_of(const Scene& scene);
const Lem& lem_of(const Scene& scene);
const Transfer& transfer_of(const Scene& scene);
const Mpm& mpm_of(const Scene& scene);

}  // namespace breach::scene
