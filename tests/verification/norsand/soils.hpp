// Soils, specimens and reference runs of the NorSand tests. Parameter sets:
// docs/reference/methods/norsand.md, section 14.
#pragma once

#include <string>

#include "element_bench/programme.hpp"

namespace breach::testing {

namespace norsand = materials::norsand;

inline norsand::Parameters soil(const std::string& name) {
    norsand::Parameters out{};
    if (name == "CJ1") {
        out.semi_log = {.Gamma = 0.900, .lambda = 0.020};
        out.M_tc = 1.20, out.N = 0.30, out.chi_tc = 3.5;
        out.H_0 = 300.0, out.H_psi = 0.0;
        out.G_ref = 30e6, out.m = 1.0, out.p_ref = 100e3, out.nu = 0.15;
    } else if (name == "CJ2") {
        out.semi_log = {.Gamma = 1.200, .lambda = 0.060};
        out.M_tc = 1.47, out.N = 0.50, out.chi_tc = 3.2;
        out.H_0 = 75.0, out.H_psi = 400.0;
        out.G_ref = 20.97e6, out.m = 0.5, out.p_ref = 100e3, out.nu = 0.15;
    } else if (name == "NK") {
        out.semi_log = {.Gamma = 0.875, .lambda = 0.048 / 2.3};
        out.M_tc = 1.45, out.N = 0.43, out.chi_tc = 3.4;
        out.H_0 = 50.0, out.H_psi = 0.0;
        out.G_ref = 71.5e6, out.m = 0.4, out.p_ref = 500e3, out.nu = 0.15;
    } else if (name == "NKu") {
        out.semi_log = {.Gamma = 0.875, .lambda = 0.048 / 2.3};
        out.M_tc = 1.27, out.N = 0.40, out.chi_tc = 4.2;
        out.H_0 = 70.0, out.H_psi = 180.0;
        out.G_ref = 65e6, out.m = 0.4, out.p_ref = 495e3, out.nu = 0.15;
    } else {  // TC
        out.curved = {.C_a = 0.98, .C_b = 0.07, .C_c = 0.45, .p_ref = 100e3};
        out.M_tc = 1.35, out.N = 0.35, out.chi_tc = 4.0;
        out.H_0 = 120.0, out.H_psi = 300.0;
        out.G_ref = 35e6, out.m = 0.5, out.p_ref = 100e3, out.nu = 0.20;
    }
    return out;
}

/// A specimen at the state parameter psi_0 under sigma_yy = sigma_v, sigma_xx = sigma_zz = K0
/// sigma_v [Pa].
inline element_bench::Specimen specimen(const norsand::Parameters& parameters, double sigma_v,
                                        double K0, double psi_0,
                                        const norsand::Options& options = {.tolerance = 1e-6},
                                        double R = 1.0) {
    const norsand::Ready law = norsand::ready(parameters);
    const double p = (1.0 + 2.0 * K0) / 3.0 * sigma_v;
    const mechanics::Voigt sigma(-K0 * sigma_v, -sigma_v, -K0 * sigma_v, 0.0);
    const double e_0 = psi_0 + norsand::critical_void_ratio(law, p);
    return {
        element_bench::NorSandPoint{law, options, norsand::initialise(law, sigma, e_0, R).state}};
}

inline norsand::Reading reading(const element_bench::Specimen& specimen) {
    const auto& point = *element_bench::norsand_in(specimen);
    return norsand::read(point.law, point.state);
}
inline const norsand::State& state_of(const element_bench::Specimen& specimen) {
    return element_bench::norsand_in(specimen)->state;
}

}  // namespace breach::testing
