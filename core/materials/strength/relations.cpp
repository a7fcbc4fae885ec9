#include "core/materials/strength/relations.hpp"

#include <algorithm>
#include <cmath>

#include "core/mechanics/atmosphere.hpp"

namespace breach::materials {

namespace {

constexpr double psf = 47.880258980336;  // Pa
constexpr double p_a = mechanics::standard_atmosphere;
constexpr double atmospheres_4 = 4.0 * p_a;

/// Weber et al. (2015): psf, with sigma'_v in atmospheres.
double weber(double N, double sigma_v0) {
    const double s = sigma_v0 / p_a;
    return psf * (std::exp(0.1407 * N + 4.2399 * std::pow(s, 0.120)) -
                  0.43991 * (std::pow(N, 1.45) + 0.2 * N * std::pow(s, 2.48) + 41.13));
}

/// Kramer & Wang (2015): in atmospheres.
double kramer_wang(double N, double sigma_v0) {
    return p_a * std::exp(-8.444 + 0.109 * N + 5.379 * std::pow(sigma_v0 / p_a, 0.1));
}

/// Idriss & Boulanger (2008): ratio to sigma'_v0 with significant void redistribution, and the
/// factor for negligible redistribution.
double ratio_by_spt(double N) { return std::exp(N / 16.0 + std::pow((N - 16.0) / 21.2, 3) - 3.0); }
double undisturbed_by_spt(double N) { return 1.0 + std::exp(N / 2.4 - 6.6); }
double ratio_by_cpt(double q) {
    return std::exp(q / 24.5 - std::pow(q / 61.7, 2) + std::pow(q / 106.0, 3) - 4.42);
}
double undisturbed_by_cpt(double q) { return 1.0 + std::exp(q / 11.1 - 9.82); }

}  // namespace

const RelationFacts& facts_of(Relation relation) {
    static constexpr const char* idriss_boulanger =
        "Idriss & Boulanger (2008), Soil liquefaction during earthquakes, EERI MNO-12";
    static constexpr const char* olson_stark =
        "Olson & Stark (2002), Can. Geotech. J. 39(3), 629-647";
    static constexpr RelationFacts all[] = {
        {"Weber 2015",
         "(N1)60cs",
         {0.0, 16.0},
         atmospheres_4,
         "Weber, Seed, Pestana, Moss et al. (2015), Engineering evaluation of post-liquefaction "
         "strength, UC Berkeley"},
        {"Kramer & Wang 2015",
         "(N1)60",
         {0.0, 15.0},
         atmospheres_4,
         "Kramer & Wang (2015), J. Geotech. Geoenviron. Eng. 141(9), 04015038"},
        {"Olson & Stark 2002, SPT", "(N1)60", {0.0, 12.0}, atmospheres_4, olson_stark},
        {"Olson & Stark 2002, CPT", "q_c1 [MPa]", {0.0, 6.5}, atmospheres_4, olson_stark},
        {"Idriss & Boulanger 2008, SPT",
         "(N1)60cs-Sr",
         {0.0, 16.0},
         atmospheres_4,
         idriss_boulanger},
        {"Idriss & Boulanger 2008, SPT, void redistribution",
         "(N1)60cs-Sr",
         {0.0, 16.0},
         atmospheres_4,
         idriss_boulanger},
        {"Idriss & Boulanger 2008, CPT",
         "q_c1Ncs-Sr",
         {0.0, 110.0},
         atmospheres_4,
         idriss_boulanger},
        {"Idriss & Boulanger 2008, CPT, void redistribution",
         "q_c1Ncs-Sr",
         {0.0, 110.0},
         atmospheres_4,
         idriss_boulanger},
    };
    return all[static_cast<std::size_t>(relation)];
}

double residual_strength(Relation relation, double sounding, double sigma_v0) {
    const auto [low, high] = facts_of(relation).range;
    const double n = std::clamp(sounding, low, high);
    const double stress = std::max(sigma_v0, 0.0);
    switch (relation) {
        case Relation::weber_2015:
            return std::max(weber(n, stress), 0.0);
        case Relation::kramer_wang_2015:
            return kramer_wang(n, stress);
        case Relation::olson_stark_2002_spt:
            return (0.03 + 0.0075 * n) * stress;
        case Relation::olson_stark_2002_cpt:
            return (0.03 + 0.0143 * n) * stress;
        case Relation::idriss_boulanger_2008_spt:
            return ratio_by_spt(n) * undisturbed_by_spt(n) * stress;
        case Relation::idriss_boulanger_2008_spt_redistribution:
            return ratio_by_spt(n) * stress;
        case Relation::idriss_boulanger_2008_cpt:
            return ratio_by_cpt(n) * undisturbed_by_cpt(n) * stress;
        case Relation::idriss_boulanger_2008_cpt_redistribution:
            return ratio_by_cpt(n) * stress;
    }
    return 0.0;
}

}  // namespace breach::materials
