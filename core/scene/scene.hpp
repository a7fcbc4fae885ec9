// The scene: one physical problem, read from JSON, checked, in SI units and radians. Meaning, unit,
// range and default of every field: workflows/schema/scene.schema.json.
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
#include "core/materials/law.hpp"
#include "core/materials/strength/profile.hpp"

namespace breach::scene {

using geometry::Box;
using geometry::Polygon;
using mechanics::Vec2;

struct LimitStrength {
    double c;    ///< [Pa]
    double phi;  ///< [rad]
};

/// Width of a shear band with nonlocal softening over the nonlocal length, independent of the cells
/// [-].
constexpr double band_in_nonlocal_lengths = 2.5;
/// The same in the FEM (tests/verification/fem/shear_band.py).
constexpr double band_in_nonlocal_lengths_of_fem = 2.7;

struct Material {
    std::string name;
    double density;  ///< [kg/m3]
    materials::Law law;
    double viscosity = 0.0;  ///< adds the Newtonian stress 2 eta dev(D) [Pa s]
    /// averaging length of the softening strains [m]
    std::optional<double> nonlocal_length{};
    std::optional<double> void_ratio{};                   ///< fem with water [-]
    std::optional<std::array<double, 2>> permeability{};  ///< hydraulic conductivity, x, y [m/s]
    std::optional<LimitStrength> limit_strength{};        ///< lem: replaces the law's strength
    /// for every phase without an entry of its own
    std::optional<materials::StrengthProfile> strength{};
    /// fem: s_u from the first dynamic stage on, by the sigma'_v0 with which it begins
    std::optional<materials::StrengthCurve> dynamic_strength{};
};

/// In the lem, limit_strength or a law with c_kPa and phi_deg takes precedence over the profile.
inline bool lem_takes_profile(const Material& material) {
    const bool law_has_own = materials::traits(material.law).c_and_phi &&
                             !materials::has_strength_of_points(material.law);
    return material.strength && !material.limit_strength && !law_has_own;
}

/// Mesh of a region: a block mapped between four of its vertices, or unstructured quads.
enum class RegionMesh { block, unstructured };

/// Structured strips at both ends of a region; their columns widen outwards.
struct MeshGrading {
    std::optional<double> left_of;   ///< x where the left strip ends [m]
    std::optional<double> right_of;  ///< x where the right strip begins [m]
    double largest = 0.0;            ///< width of the outermost column [m]
    bool any() const { return left_of || right_of; }
};

struct Region {
    std::string name;
    std::size_t material;  ///< index into Scene::materials
    Polygon polygon;       ///< counter-clockwise, first vertex not repeated
    RegionMesh mesh = RegionMesh::block;
    std::array<std::size_t, 4> corners{};  ///< block: indices into polygon, counter-clockwise
    /// block: elements along sides 0-1 and 1-2 of the corners; 0: from element_size
    std::array<int, 2> divisions{};
    double element_size = 0.0;  ///< wanted edge length [m]
    MeshGrading grading{};
};

struct Section {
    std::vector<Region> regions;

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
    int depths;                            ///< number of circles per pair of ends
    double minimum_depth;                  ///< least depth of the sliding mass below ground [m]
    std::optional<double> lowest_level{};  ///< surfaces stay above it [m]
};

/// Vertical crack at the upper end of every surface, down to `depth` or `level`.
struct TensionCrack {
    std::optional<double> depth;  ///< of the crack [m]
    std::optional<double> level;  ///< y of its tip [m]
    double filled;                ///< share of its height filled with water [-]
};

/// Polygonal slip surfaces, analysed by Spencer's method.
struct NonCircular {
    std::vector<Vec2> given;  ///< ascending in x; empty: none [m]
    int vertices;             ///< of the optimised surface; 0: no optimisation
};

/// Pore pressure below the phreatic line: gamma_w times the depth, or times cos^2 of the line's
/// inclination too.
enum class PhreaticCorrection { none, cos2 };

/// Hydrostatic water below a line; free water where the line is above ground.
struct Water {
    std::vector<Vec2> line;  ///< ascending in x, level beyond its ends [m]
    double density;          ///< [kg/m3]
    PhreaticCorrection correction;
    /// regions it fills, indices into the section's; empty: all without another line
    std::vector<std::size_t> regions;
};

struct PorePressureRatio {
    std::size_t region;  ///< index into the section's regions
    double r_u;          ///< u over the vertical total stress [-]
};

/// Vertical pressure on the ground for x in [from, to].
struct Surcharge {
    double from;      ///< [m]
    double to;        ///< [m]
    double pressure;  ///< [Pa]
};

/// s = constant + coefficient (sigma'_v0 / p_a)^exponent, p_a = 101.325 kPa; phi = 0.
struct UndrainedStrength {
    double constant;      ///< [Pa]
    double coefficient;   ///< [Pa]
    double exponent;      ///< [-]
    double factor = 1.0;  ///< multiplies the strength of the profile or law [-]
    std::optional<materials::OnPath> on_path{};  ///< strength by the material's law instead
    std::shared_ptr<const materials::UndrainedByPlace>
        by_state{};  ///< filled in if the law gives the strength

    /// True without a strength of its own: the residual strength of the material's profile applies,
    /// if any.
    bool is_of_profile() const { return constant == 0.0 && coefficient == 0.0 && !on_path; }
};

struct UndrainedRegion {
    std::size_t region;  ///< index into the section's regions
    UndrainedStrength strength;
    std::optional<std::array<double, 2>> levels{};  ///< only between these levels, low to high [m]
};

/// Slip surface for varied parameters: fixed, or searched again.
enum class VariedSurface { fixed, searched };

enum class Parameter {
    cohesion,
    friction_angle,
    density,
    undrained_strength,
    residual_strength,
    seismic_coefficient
};
enum class Distribution { normal, lognormal };

/// `of`: index into the materials, Lem::undrained or Lem::liquefaction.
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
    std::vector<Water> piezometric_lines;  ///< pore pressure of their regions, without free water
    std::vector<PorePressureRatio> pore_pressure_ratios;
    double seismic_coefficient;  ///< k_h, towards the sliding direction [-]
    std::vector<Surcharge> surcharge;
    /// no surface reaches below; ascending in x, level beyond its ends; empty: none [m]
    std::vector<Vec2> floor;
    std::optional<TensionCrack> tension_crack;
    std::optional<NonCircular> non_circular;
    std::vector<UndrainedRegion> undrained;
    std::vector<UndrainedRegion> liquefaction;  ///< from the top down; each stage adds one
    /// Regions that were placed too fast for the soil below to consolidate: sigma'_v0 excludes
    /// their weight.
    std::vector<std::size_t> unconsolidated;
    std::optional<Probability> probability;

    /// Whether any entry gives pore pressure, be it zero.
    bool has_water() const {
        return water || !piezometric_lines.empty() || !pore_pressure_ratios.empty();
    }
};

// ---------------------------------------------------------------- fem_solver

/// bbar: 2 x 2 Gauss points, mean dilatation. ssp: one point with hourglass stabilisation.
enum class ElementKind { bbar, ssp };
/// Modulus of the ssp quad's stabilisation: the current or the elastic one.
enum class HourglassKind { current, elastic };
struct MeshSource {
    std::optional<std::filesystem::path> msh_file;  ///< absolute; none: meshed from the regions
};

/// Nodes on the segment are fixed in x, y or both.
struct Support {
    std::string name;
    Vec2 from;
    Vec2 to;
    bool fixes_x;
    bool fixes_y;
};

enum class StageKind { static_equilibrium, dynamic };
enum class StageLaws { elastic, scene };
/// free_drainage: 1 m/s everywhere; scene: the materials' permeability.
enum class StagePermeability { free_drainage, scene };

/// Nodes on the segment have the hydrostatic pressure below `level`; without a level p = 0.
struct PressureBoundary {
    std::string name;
    Vec2 from;
    Vec2 to;
    std::optional<double> level;
};

/// Nodes on the segment are fixed in the given directions and moved by these amounts over a stage.
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

struct Stage {
    std::string name;
    StageKind kind;
    StageLaws laws;
    StagePermeability permeability = StagePermeability::scene;
    int load_steps = 1;            ///< static: number of equal gravity increments
    double duration = 0.0;         ///< dynamic [s]
    double time_step = 0.0;        ///< dynamic: largest [s]
    double least_time_step = 0.0;  ///< dynamic: a smaller step ends the run [s]
    std::optional<double> S{};     ///< additional softening, if the stage sets it [-]
    /// [regions] the same by region, drained or not; empty: no region
    std::vector<std::optional<double>> S_of_region{};
    std::vector<std::size_t> activates{};  ///< regions placed in this stage
    std::vector<std::size_t> removes{};    ///< regions removed in this stage
    std::vector<std::size_t> releases{};   ///< supports removed in this stage
    /// From this stage on, replaces the earlier surcharges.
    std::optional<std::vector<Surcharge>> surcharge{};
    /// static: from this stage on, replaces the earlier line; ascending in x [m]
    std::optional<std::vector<Vec2>> phreatic_line{};
    /// static: regions without pore water flow in this stage
    std::vector<std::size_t> undrained{};
    /// From this stage on, replaces the earlier value.
    std::optional<double> seismic_coefficient{};  ///< horizontal body force over weight [-]
    std::optional<std::vector<EdgePressure>> pressures{};
    std::vector<Displacement> displacements{};  ///< static: kept from this stage on
    double ramp = 0.0;              ///< dynamic: time over which unbalanced forces are applied [s]
    bool goes_on_at_limit = false;  ///< static: a limit point ends the stage instead of the run

    bool changes_the_body() const {
        return !activates.empty() || !removes.empty() || !releases.empty() || surcharge ||
               phreatic_line || !undrained.empty() || seismic_coefficient || pressures ||
               !displacements.empty();
    }
};

/// Soil above the phreatic line: p = 0 at its nodes, or no pore water.
enum class AboveWater { drained, dry };

/// Integration of storage and conduction in the ssp quad: full, or at one point, which does not
/// resist a pressure that alternates from node to node.
enum class PressureIntegration { full, one_point };

/// Pore water below a phreatic line.
struct GroundWater {
    std::vector<Vec2> line;  ///< ascending in x, level beyond its ends [m]
    double density;          ///< [kg/m3]
    double bulk_modulus;     ///< K_f [Pa]
    AboveWater above;
    double pressure_stabilisation;  ///< alpha in alpha h^2 / (K + 4G/3) [-]
    PressureIntegration pressure_integration;
    std::vector<PressureBoundary> boundaries;
};

/// Input motion: of the rock outcrop (twice the upgoing wave), or the upgoing wave.
enum class MotionAt { outcrop, upgoing };

/// Elastic half-space below the mesh: its nodes have the same x displacement.
struct ElasticBase {
    double density;  ///< [kg/m3]
    double V_s;      ///< [m/s]
    MotionAt motion_at;
};

enum class Baseline { as_recorded, corrected };

struct BaseMotion {
    std::filesystem::path file;            ///< absolute
    std::optional<double> scale_to_pga_g;  ///< [g]
    Baseline baseline;
    bool reversed = false;  ///< the other way than recorded
};

enum class FreeFieldSides { left, right, both };

struct FreeField {
    double width;             ///< [m]
    double thickness_factor;  ///< multiplies the section's thickness [-]
    FreeFieldSides sides;
};

/// Depth of liquefaction: the deepest node with r_u above the threshold.
struct LiquefactionWatch {
    std::vector<std::size_t> regions;  ///< of the nodes
    std::array<double, 2> x;           ///< range of the nodes [m]
    double level;                      ///< y of zero depth [m]
    double r_u;                        ///< threshold [-]
    double least_stress;  ///< no r_u at nodes with less sigma'_v0 [Pa, compression positive]
};

struct Fem {
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
    double largest_step_error;  ///< 0: the Newton iterations alone control the time step [m]
    double newmark_beta;
    double newmark_gamma;
    double rayleigh_mass;                       ///< alpha [1/s]
    double rayleigh_stiffness;                  ///< beta [s]
    std::optional<double> damping_frequency{};  ///< frequency of the given damping ratio [Hz]
    double force_tolerance;                     ///< residual norm over reference force norm [-]
    int largest_iterations;
    double least_jacobian_ratio;  ///< a smaller ratio counts as entangled [-]
    Vec2 crest;                   ///< monitored point: the nearest node [m]
    double strain_threshold;      ///< averages include elements with a larger epsilon_q [-]
    std::optional<LiquefactionWatch> liquefaction;
    /// connected elements with a larger epsilon_q are a failure surface [-]
    double failure_strain;
    double failure_separation;  ///< surfaces that reach the ground closer together count as one [m]
    std::vector<double> snapshot_times;  ///< ascending; time steps end on them [s]
    double snapshot_interval;            ///< time steps do not end on these; 0: none [s]
    double telemetry_interval;           ///< [s]
    /// of undrained strength by state; none: not computed [s]
    std::optional<double> strength_interval;

    /// Of the stages; static ones have none [s].
    double duration() const {
        double sum = 0.0;
        for (const Stage& stage : stages) sum += stage.duration;
        return sum;
    }
    bool changes_the_body() const {
        for (const Stage& stage : stages)
            if (stage.changes_the_body()) return true;
        return false;
    }
    bool moves_the_water() const {
        for (const Stage& stage : stages)
            if (stage.phreatic_line) return true;
        return false;
    }
    /// The water with the phreatic line of a stage.
    std::optional<GroundWater> water_in(std::size_t stage) const {
        std::optional<GroundWater> now = water;
        for (std::size_t s = 0; now && s <= stage; ++s)
            if (stages[s].phreatic_line) now->line = *stages[s].phreatic_line;
        return now;
    }
    /// [regions] absent in a stage: not yet placed, or removed.
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

/// r_u that decides whether a node is liquefied: the largest since the shaking began, or that at
/// t_T.
enum class LiquefiedWhen { ever, at_transfer };
/// Treatment of an element that is inside out in the FEM.
enum class Entangled { refuse, rebuild };
/// Stress of points with frictional laws: effective with a separate pore pressure, or total. All
/// other laws (phi = 0, elastic) get the total stress.
enum class TransferredStress { total, effective };

/// Soil of a region that gets another material in the MPM.
struct SoilMapping {
    std::size_t region;                      ///< index into the section's regions
    std::size_t material;                    ///< index into Scene::materials
    std::optional<std::size_t> saturated{};  ///< material below the phreatic line
};

/// Liquefied soil with initial vertical effective stress sigma'_v0 in [from, to).
struct LiquefiedLayer {
    double from;  ///< [Pa]
    double to;    ///< [Pa]
    std::size_t material;
};

/// At this transfer time, soil above the line is liquefied, and soil left of the line above the
/// level of its left end.
struct LiquefiedLine {
    double transfer_time;        ///< [s]
    std::array<Vec2, 2> points;  ///< from left to right [m]
};

enum class LiquefiedBy { column, point };

struct LiquefiedZone {
    std::vector<std::size_t> regions;  ///< with liquefiable soil
    double r_u;                        ///< liquefied above this pore pressure ratio [-]
    LiquefiedWhen when;
    LiquefiedBy by = LiquefiedBy::column;
    std::optional<double> shear_strain{};  ///< by point: liquefied above it [-]
    /// From 0, without gaps; the last layer includes higher stresses. Empty: soil keeps its
    /// material, with the residual strength of that material's profile.
    std::vector<LiquefiedLayer> layers;
    /// unliquefied soil between liquefied soil liquefies if it is narrower [m]
    double narrowest_wall = 0.0;
    std::vector<LiquefiedLine> lines{};
};

/// Recommended transfer times; expressions of core/criteria over FEM telemetry.
struct AdviceWindow {
    std::string lower;  ///< condition: the failure has developed
    std::string upper;  ///< condition: the mesh is too distorted
    double hold;        ///< [s]
    std::string pick;   ///< "midpoint", "first" or "last_before"
};

enum class BaseDisplacement { kept, subtracted };
/// sigma_zz of the points: from the FEM, or zero as in a transfer of three stress components.
enum class OutOfPlaneStress { carried, zero };

struct Transfer {
    int points_per_direction;
    std::optional<int> points_per_cell{};  ///< mean in the MPM's filled cells
    /// Moves the points along xi and eta: 0 Gauss points, +-1 to the border of their part [-]
    std::array<double, 2> point_shift{};
    Interpolation interpolation;
    int neighbours;
    Entangled entangled = Entangled::refuse;
    TransferredStress stress = TransferredStress::total;
    std::vector<SoilMapping> mapping{};
    std::vector<Vec2> phreatic_line{};  ///< ascending in x, level beyond its ends [m]
    std::optional<LiquefiedZone> liquefied{};
    BaseDisplacement base_displacement = BaseDisplacement::kept;
    OutOfPlaneStress sigma_zz = OutOfPlaneStress::carried;
    double largest_mass_loss;                    ///< relative; a larger loss fails the transfer
    double largest_momentum_loss;                ///< relative
    double largest_kinetic_energy_loss = 0.005;  ///< relative
    std::optional<AdviceWindow> window{};
};

// ---------------------------------------------------------------- mpm_solver

/// automatic: on if the law is plastic or nu > 0.45.
enum class AntiLocking { on, off, automatic };
enum class Wall { roller, fixed, open };

/// Motion of the ground during the runout.
enum class Shaking {
    off,      ///< none: the earthquake ends with the transfer
    goes_on,  ///< that of the base of the FEM's free-field columns; the grid moves with it
};

/// Initial stress if points fill the section: none, or from the overburden, sigma_h = K_0 sigma_v
/// with K_0 = nu / (1 - nu).
enum class FillStress { none, overburden };

/// Coulomb friction on floor or terrain for x in [from, to].
struct FrictionZone {
    double from;
    double to;
    double coefficient;
};

struct Floor {
    double level;                        ///< y of the floor [m]
    std::vector<FrictionZone> friction;  ///< ascending in x, empty: fixed (no slip)
};

/// Separates overlapping soil: adds the volume rate -rate max(0, fill - 1 - tolerance) to a point.
struct OverlapCorrection {
    double rate = 0.0;       ///< 0: none [1/s]
    double tolerance = 0.1;  ///< [-]
};

struct Runout {
    Vec2 toe;
    std::vector<std::string> regions;  ///< mobile regions; empty: all
    double front_depth = 1.0;          ///< the front is the farthest place with this flow depth [m]
};

/// A place where flow depth and velocity are recorded.
struct Gauge {
    std::string name;
    double x;              ///< [m]
    double arrival_depth;  ///< flow depth at arrival [m]
};

/// A place through which soil leaves the model; its hydrograph is recorded.
struct FlowSection {
    std::string name;
    double x;  ///< [m]
};

/// Width of the breach, normal to the section [m].
struct BreachWidth {
    double low;
    double best;
    double high;
};

/// Fields of a point besides position and region, by their names in the exchange files.
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
    std::vector<PointField> fields{};  ///< of the points, in frames
};

/// Criterion of rest for the mobile soil. Limits that depend on the scene's size are resolved.
struct Rest {
    double change;                 ///< largest movement of the front over the window [m]
    double window;                 ///< [s]
    double earliest;               ///< no rest before [s]
    double speed;                  ///< slower soil is at rest [m/s]
    double body_share = 0.005;     ///< largest moving connected body, over the mobile mass [-]
    double kinetic_share = 0.005;  ///< largest kinetic energy, over the energy released [-]
    double peak_share = 0.05;      ///< largest kinetic energy, over its maximum so far [-]
};

/// Standing water of a runout; core/scene/standing_water.hpp gives its pressure.
struct Pool {
    std::vector<Vec2> line;  ///< ascending in x, level beyond its ends [m]
    double density;          ///< [kg/m3]
};

struct Mpm {
    double cell_size;  ///< [m]
    bool allow_coarse_cells = false;
    std::array<double, 2> domain_x;  ///< [m]
    std::array<double, 2> domain_y;  ///< [m]
    Wall left;
    Wall right;
    Floor floor;
    std::optional<Pool> water{};
    /// Ascending in x, linear beyond its ends; empty: the floor [m]
    std::vector<Vec2> terrain{};
    double gimp_half_size;  ///< over the cell size [-]
    double blending_rate;   ///< affine PIC rate beta [1/s]
    /// Damping of soil that does not yield, over critical, at the frequency of the mobile height
    /// [-]
    double damping_ratio = 0.0;
    /// Least tensile strength over the present unconfined compressive strength [-]
    double tension_share = 0.0;
    AntiLocking anti_locking;
    bool gap_closure;
    /// Limits crack volume to the space between neighbouring points. By default on if more than a
    /// tenth of the terrain is steeper than 30 degrees and debris falls on other soil.
    bool gap_room = false;
    OverlapCorrection overlap_correction{};
    /// Cell size for which the softening strains are given [m]
    std::optional<double> softening_length{};
    double stiffness_scale;  ///< multiplies E; in the results [-]
    /// of compression waves: soil is softened to it [m/s]
    std::optional<double> wave_speed_limit{};
    std::optional<double> time_step;  ///< fixed [s]; otherwise by CFL
    double cfl;                       ///< [-]
    double duration;                  ///< largest [s]
    bool until_rest = false;          ///< end the run at rest, at the latest after `duration`
    Rest rest;
    Runout runout;
    std::vector<Gauge> gauges{};
    double arrival_depth = 0.1;  ///< envelope: flow depth at arrival [m]
    std::vector<FlowSection> sections{};
    std::optional<BreachWidth> breach_width{};
    double snapshot_interval;  ///< [s]
    Output output{};
    double telemetry_interval;           ///< [s]
    double checkpoint_interval;          ///< wall clock [s]
    double largest_energy_gain;          ///< over the energy released; more ends the run [-]
    int fill_points;                     ///< per cell and direction, if no particles are given
    std::array<double, 2> fill_shift{};  ///< moves the filling grid of points, in its spacings [-]
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
    std::string completed;              ///< JSON text with all defaults, keys sorted
    std::vector<fault::Flag> warnings;  ///< possible but probably unintended entries

    const Material& material_of(std::size_t region) const {
        return materials[section.regions[region].material];
    }
};

/// Soil of material points: region and material.
struct Soil {
    std::size_t region;    ///< index into the section's regions
    std::size_t material;  ///< index into materials
    bool operator==(const Soil&) const = default;
};

/// All soils of this scene's points: first the section's regions, in their order, with their MPM
/// material; then the parts that /transfer separates (saturated parts, liquefied layers).
std::vector<Soil> soils_of(const Scene& scene);

/// Reads and checks a scene; `overrides` are "/json/pointer=value". Throws BadInput with every
/// fault, IoError if the file cannot be read.
Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// The same from text. Relative paths start at `folder`; messages use `name`.
Scene parse_scene(std::string_view text, const std::string& name,
                  const std::filesystem::path& folder = ".",
                  const std::vector<std::string>& overrides = {});

/// Throws BadInput if the scene lacks this phase ("/mpm" missing).
const Fem& fem_of(const Scene& scene);
const Lem& lem_of(const Scene& scene);
const Transfer& transfer_of(const Scene& scene);
const Mpm& mpm_of(const Scene& scene);

}  // namespace breach::scene
