// All material points at one time, as structure of arrays. File: VTKHDF UnstructuredGrid 1.0 of
// vertices. The transfer writes the first state, the MPM its frames and the final one; frames are
// for display, a runout starts from whole states only.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/exchange/base_motion.hpp"
#include "core/exchange/ledger.hpp"
#include "core/exchange/provenance.hpp"
#include "core/mechanics/nodal_field.hpp"
#include "core/mechanics/tensor.hpp"
#include "core/words/words.hpp"

namespace breach::exchange {

/// Stress measure of a region's points. effective: total stress = stress - u I with the points'
/// pore_pressure u; total: `stress` is the total stress; buoyant: total stress = stress - p I with
/// the pressure p of /mpm/water at the point's place (core/scene/standing_water.hpp).
enum class StressMeasure { effective, total, buoyant };

constexpr auto words_of(StressMeasure) {
    using enum StressMeasure;
    return words::in_order<StressMeasure>(
        {{effective, "effective"}, {total, "total"}, {buoyant, "buoyant"}});
}

/// Peak and residual strength of points [n_particles]; 0 for soil without a strength profile.
struct StrengthOfPoints {
    std::vector<double> c;                 ///< [Pa]
    std::vector<double> tan_phi;           ///< [-]
    std::vector<double> c_residual;        ///< [Pa]
    std::vector<double> tan_phi_residual;  ///< [-]
};

/// Fields of the points besides position and region, [n_particles].
struct PointFields {
    std::vector<mechanics::Vec2> velocity;  ///< [m/s]
    /// L_ij = dv_i / dx_j [1/s].
    std::vector<mechanics::Matrix2> velocity_gradient;
    std::vector<double> mass;               ///< [kg] for `thickness`
    std::vector<double> volume_0;           ///< at zero mean stress, the law's reference [m3]
    std::vector<double> volume;             ///< [m3]
    std::vector<mechanics::Voigt> stress;   ///< [Pa], tension positive; see stress_of_regions
    std::vector<double> epsilon_q;          ///< total, sqrt(2/3 e:e) accumulated [-]
    std::vector<double> epsilon_q_plastic;  ///< softening variable of the law [-]
    std::vector<double> gap;  ///< volumetric strain opened in tension, to be closed again [-]
    std::vector<double> pore_pressure;  ///< u [Pa]; empty when there is no water
    std::vector<double> r_u;    ///< (u - u_0) / sigma'_v0 at t_T [-], for display; may be empty
    StrengthOfPoints strength;  ///< empty if no material has a strength profile
};

/// Presence of a field in a whole state. maybe: absent in a scene without water or profiles.
/// with_cohesion: exactly where "cohesion" is.
enum class Given { always, maybe, with_cohesion };

/// Calls visit(name, unit, presence, array) for each field, in the order of the files.
template <class Fields, class Visit>
constexpr void for_each_field(Fields& of, Visit&& visit) {
    using enum Given;
    visit("velocity", "m/s", always, of.velocity);
    visit("velocity_gradient", "1/s", always, of.velocity_gradient);
    visit("mass", "kg", always, of.mass);
    visit("volume_0", "m3", always, of.volume_0);
    visit("volume", "m3", always, of.volume);
    visit("stress", "Pa", always, of.stress);
    visit("epsilon_q", "1", always, of.epsilon_q);
    visit("epsilon_q_plastic", "1", always, of.epsilon_q_plastic);
    visit("gap", "1", always, of.gap);
    visit("pore_pressure", "Pa", maybe, of.pore_pressure);
    visit("r_u", "1", maybe, of.r_u);
    visit("cohesion", "Pa", maybe, of.strength.c);
    visit("tan_phi", "1", with_cohesion, of.strength.tan_phi);
    visit("cohesion_residual", "Pa", with_cohesion, of.strength.c_residual);
    visit("tan_phi_residual", "1", with_cohesion, of.strength.tan_phi_residual);
}

// A field that is added to PointFields but not to the list above would silently be missing from the
// files.
static_assert(
    [] {
        const PointFields none;
        std::size_t size = 0;
        for_each_field(none, [&](auto, auto, auto, const auto& array) { size += sizeof array; });
        return size == sizeof none;
    }(),
    "every field is visited");

struct ParticleState : PointFields {
    double time = 0.0;           ///< [s] on the MPM's clock; 0 at the transfer
    double transfer_time = 0.0;  ///< t_T [s] on the FEM's clock
    std::int64_t step = 0;
    double thickness = 1.0;  ///< [m]

    /// [regions] name, material, stress measure. A name may occur several times with different
    /// materials (liquefied layers of one region).
    std::vector<std::string> regions;
    std::vector<std::string> materials_of_regions;
    std::vector<StressMeasure> stress_of_regions;  ///< empty: all effective

    std::vector<mechanics::Vec2> position;  ///< [n_particles] [m]
    std::vector<std::int32_t> region;       ///< [n_particles]

    /// On the FEM's clock; only in files of the transfer. The velocities of those files are still
    /// relative to far rock.
    BaseMotion base_motion{};
    /// Pore pressure before the shaking at the nodes of the undeformed mesh [Pa]; only in files of
    /// a transfer to a scene with /mpm/water.
    mechanics::NodalField steady_pressure{};

    std::size_t size() const { return position.size(); }
    /// New points have zeros in the fields that every point has.
    void resize(std::size_t n);
    /// u of a point with effective stress [Pa]; 0 if its stress is total.
    double pressure_beside(std::size_t p) const;
};

/// `ledger`: what the transfer conserved and lost; only the transfer gives one.
void write_particle_state(const std::filesystem::path& path, const ParticleState& state,
                          const Provenance& provenance, const Ledger& ledger = {});

struct ParticleStateFile {
    ParticleState state;
    Provenance provenance;
    Ledger ledger;  ///< empty unless the transfer wrote the file
};
/// Throws BadInput or IoError as read_mesh_snapshot does.
ParticleStateFile read_particle_state(const std::filesystem::path& path);

/// Writes a frame for display, not for restart: positions, regions and the named fields that the
/// points have, in single precision, compressed.
void write_particle_frame(const std::filesystem::path& path, const ParticleState& state,
                          std::span<const std::string_view> fields, const Provenance& provenance);

/// Reads a frame or a whole state; fields that the file lacks stay empty. Throws as
/// read_particle_state does.
ParticleState read_particle_frame(const std::filesystem::path& path);

}  // namespace breach::exchange
