// One material point in the laboratory: any law behind one pure interface, and the boundary conditions
// of element tests. No test programmes here.
#pragma once

#include <variant>

#include "core/materials/law.hpp"
#include "core/materials/norsand/norsand.hpp"
#include "core/materials/pm4sand/pm4sand.hpp"
#include "core/words/words.hpp"

namespace breach::element_bench {

using mechanics::Voigt;

/// Laws whose memory is materials::State alone.
using PlainLaw =
    std::variant<materials::LinearElastic, materials::MohrCoulomb, materials::DruckerPrager>;

struct PlainPoint {
    PlainLaw law;
    materials::State state;
};

/// A point of PM4Sand.
struct SandPoint {
    materials::pm4sand::Ready law;
    materials::pm4sand::Options options;
    materials::pm4sand::State state;
};

/// A point of NorSand.
struct NorSandPoint {
    materials::norsand::Ready law;
    materials::norsand::Options options;
    materials::norsand::State state;
};

/// Laws with their state; copied for a trial, assigned on acceptance.
struct Specimen {
    std::variant<PlainPoint, SandPoint, NorSandPoint> point;
    /// Volumetric strain since the start of the test, compression positive
    double epsilon_v = 0.0;
    double gamma = 0.0;       ///< engineering shear strain since the start
    double epsilon_yy = 0.0;  ///< vertical strain since the start, compression positive
};

/// The point of a specimen of NorSand, otherwise null.
inline const NorSandPoint* norsand_in(const Specimen& specimen) {
    return std::get_if<NorSandPoint>(&specimen.point);
}

/// Cost of calls of a law with memory.
struct Counts {
    materials::pm4sand::Counts sand;
    materials::norsand::Counts norsand;

    Counts& operator+=(const Counts& other) {
        sand += other.sand;
        norsand += other.norsand;
        return *this;
    }
};

/// Effective stress [Pa, tension positive].
Voigt stress(const Specimen& specimen);

/// Initial tangent shear modulus [Pa].
double shear_modulus(const Specimen& specimen);

enum class Ending { done, failed };

/// A specimen after a trial; `failed` leaves it as it was.
struct Trial {
    Specimen specimen;
    Ending outcome = Ending::done;
    Counts counts;
};

/// Strains the specimen by d_epsilon [-, tension positive, engineering shear].
Trial strained(const Specimen& specimen, const Voigt& d_epsilon);

/// The stresses and strains held while the driven strain increases.
enum class Boundary {
    undrained_shear,        ///< gamma driven, epsilon_xx = epsilon_yy = 0
    drained_shear,          ///< gamma driven, epsilon_xx = 0, sigma_yy held
    undrained_biaxial,      ///< epsilon_yy driven (compression positive), epsilon_xx = -epsilon_yy
    drained_biaxial,        ///< epsilon_yy driven, sigma_xx held, no shear
    undrained_compression,  ///< triaxial: epsilon_yy driven, epsilon_xx = epsilon_zz = -epsilon_yy / 2
    drained_compression,  ///< triaxial: epsilon_yy driven, sigma_xx = sigma_zz held
    undrained_extension,  ///< the same with epsilon_yy pulled: driven is -epsilon_yy
    drained_extension,
};

constexpr auto words_of(Boundary) {
    using enum Boundary;
    return words::in_order<Boundary>({{undrained_shear, "undrained_shear"},
                                      {drained_shear, "drained_shear"},
                                      {undrained_biaxial, "undrained_biaxial"},
                                      {drained_biaxial, "drained_biaxial"},
                                      {undrained_compression, "undrained_compression"},
                                      {drained_compression, "drained_compression"},
                                      {undrained_extension, "undrained_extension"},
                                      {drained_extension, "drained_extension"}});
}

/// The strain that a boundary drives.
enum class Drives { shear, compression, extension };
Drives drives(Boundary boundary);
/// Whether epsilon_zz equals epsilon_xx instead of being zero.
bool is_triaxial(Boundary boundary);
/// Whether volume is free to change.
bool is_drained(Boundary boundary);

/// The driven strain since the start of the test.
double driven_strain(const Specimen& specimen, Boundary boundary);

/// Advances the driven strain by `d`; `held` is the stress component that the boundary holds [Pa,
/// tension positive], if it holds one. Fails when no strain gives that stress.
Trial driven(const Specimen& specimen, Boundary boundary, double d, double held);

/// The stress component that the boundary holds, at the start of a test.
double held_stress(const Specimen& specimen, Boundary boundary);

/// The stress conjugate to the driven strain: tau, or half the stress difference of yy and xx [Pa].
double response(const Specimen& specimen, Boundary boundary);

}  // namespace breach::element_bench
