// One material point in the laboratory: any law behind one interface, and the boundary conditions
// of element tests.
#pragma once

#include <variant>

#include "core/materials/law.hpp"
#include "core/materials/norsand/norsand.hpp"
#include "core/materials/pm4sand/pm4sand.hpp"
#include "core/words/words.hpp"

namespace breach::element_bench {

using mechanics::Voigt;

/// Laws without memory besides materials::State.
using PlainLaw =
    std::variant<materials::LinearElastic, materials::MohrCoulomb, materials::DruckerPrager>;

struct PlainPoint {
    PlainLaw law;
    materials::State state;
};

struct SandPoint {
    materials::pm4sand::Ready law;
    materials::pm4sand::Options options;
    materials::pm4sand::State state;
};

struct NorSandPoint {
    materials::norsand::Ready law;
    materials::norsand::Options options;
    materials::norsand::State state;
};

/// A law with its state; a trial changes a copy.
struct Specimen {
    std::variant<PlainPoint, SandPoint, NorSandPoint> point;
    /// Volumetric strain since the start, compression positive.
    double epsilon_v = 0.0;
    double gamma = 0.0;       ///< engineering shear strain since the start
    double epsilon_yy = 0.0;  ///< vertical strain since the start, compression positive
};

/// The NorSand point of a specimen; null for other laws.
inline const NorSandPoint* norsand_in(const Specimen& specimen) {
    return std::get_if<NorSandPoint>(&specimen.point);
}

/// Cost of the calls of a law with memory.
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

/// A specimen after a trial; unchanged if `failed`.
struct Trial {
    Specimen specimen;
    Ending outcome = Ending::done;
    Counts counts;
};

/// Applies the strain d_epsilon [-, tension positive, engineering shear].
Trial strained(const Specimen& specimen, const Voigt& d_epsilon);

/// Boundary conditions of a test, with one driven strain.
enum class Boundary {
    undrained_shear,    ///< gamma driven, epsilon_xx = epsilon_yy = 0
    drained_shear,      ///< gamma driven, epsilon_xx = 0, sigma_yy constant
    undrained_biaxial,  ///< epsilon_yy driven (compression positive), epsilon_xx = -epsilon_yy
    drained_biaxial,    ///< epsilon_yy driven, sigma_xx constant, no shear
    /// triaxial: epsilon_yy driven, epsilon_xx = epsilon_zz = -epsilon_yy / 2
    undrained_compression,
    drained_compression,  ///< triaxial: epsilon_yy driven, sigma_xx = sigma_zz constant
    undrained_extension,  ///< undrained_compression in extension: driven is -epsilon_yy
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

enum class Drives { shear, compression, extension };
Drives drives(Boundary boundary);
/// Whether epsilon_zz = epsilon_xx instead of 0.
bool is_triaxial(Boundary boundary);
/// Whether the volume is free.
bool is_drained(Boundary boundary);

/// The driven strain since the start of the test.
double driven_strain(const Specimen& specimen, Boundary boundary);

/// Increases the driven strain by `d`; `held`: constant stress of the boundary, if any [Pa, tension
/// positive]. Fails if no strain gives that stress.
Trial driven(const Specimen& specimen, Boundary boundary, double d, double held);

/// The constant stress of the boundary, at the start of a test.
double held_stress(const Specimen& specimen, Boundary boundary);

/// Stress conjugate to the driven strain: tau, or half the difference of yy and xx [Pa].
double response(const Specimen& specimen, Boundary boundary);

}  // namespace breach::element_bench
