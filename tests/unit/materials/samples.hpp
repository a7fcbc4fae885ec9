// Soils and strain increments that reach every facet of the yield surface.
#pragma once

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "core/materials/mohr_coulomb/mohr_coulomb.hpp"

namespace breach::materials::samples {

inline constexpr double degree = 3.14159265358979323846 / 180.0;
inline constexpr double no_cut_off = std::numeric_limits<double>::infinity();

inline MohrCoulomb soil(double phi_deg, double psi_deg, double c, double cut_off, double nu = 0.3) {
    return {{2e7, nu}, c, phi_deg * degree, psi_deg * degree, cut_off, std::nullopt};
}

/// Associated and not, frictionless, cohesionless, neither; cut-off absent, at zero, below and
/// beyond the apex.
inline std::vector<MohrCoulomb> soils() {
    std::vector<MohrCoulomb> all;
    for (const double nu : {0.0, 0.3, 0.4999}) {
        for (const double cut_off : {0.0, 3e3, no_cut_off}) {
            all.push_back(soil(0, 0, 1e4, cut_off, nu));
            all.push_back(soil(30, 0, 1e4, cut_off, nu));
            all.push_back(soil(30, 12, 1e4, cut_off, nu));
            all.push_back(soil(30, 30, 1e4, cut_off, nu));
            all.push_back(soil(55, 55, 2e3, cut_off, nu));
            all.push_back(soil(35, 5, 0.0, cut_off, nu));
            all.push_back(soil(0, 0, 0.0, cut_off, nu));
            all.push_back(soil(1e-4, 0, 1e4, cut_off, nu));
        }
    }
    return all;
}

class Draw {
  public:
    explicit Draw(unsigned seed) : random_(seed) {}

    double uniform(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    double magnitude(double low, double high) {
        return std::exp(uniform(std::log(low), std::log(high)));
    }
    Voigt voigt(double size) {
        return size * Voigt(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    }
    /// Strain increments small and huge, sometimes with equal or vanishing entries.
    Voigt strain(double largest) {
        Voigt e = voigt(magnitude(1e-7, largest));
        const double dice = uniform(0, 1);
        if (dice < 0.1) e[1] = e[0];
        if (dice < 0.05) e[3] = 0.0;
        if (dice > 0.9) e[2] = 0.0;
        if (dice > 0.95) e[2] = e[1] = e[0];
        return e;
    }

  private:
    std::mt19937 random_;
};

}  // namespace breach::materials::samples
