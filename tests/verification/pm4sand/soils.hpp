// Soils of the reference runs and readers for the PM4Sand tests. kPa here, Pa in the model.
#pragma once

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/materials/pm4sand/pm4sand.hpp"

namespace breach::testing {

namespace pm4sand = materials::pm4sand;

inline pm4sand::Parameters soil(const std::string& name) {
    if (name == "tailings_def") return pm4sand::defaults(0.35, 476.0, 0.53);
    if (name == "embankment") return pm4sand::defaults(0.55, 677.0, 0.40);
    if (name == "foundation") return pm4sand::defaults(0.75, 890.0, 0.63);
    if (name != "tailings_cal") throw std::invalid_argument(name);
    pm4sand::Parameters law = pm4sand::defaults(0.35, 476.0, 2.70);
    law.Q = 11.998;
    law.R = 3.75;
    return law;
}

inline pm4sand::State consolidated(const pm4sand::Ready& law, double sigma_v_kPa, double K0) {
    return pm4sand::initialise(
        law, mechanics::Voigt(-1e3 * K0 * sigma_v_kPa, -1e3 * sigma_v_kPa, 0.0, 0.0));
}

inline mechanics::Voigt shear(double d_gamma) { return {0.0, 0.0, 0.0, d_gamma}; }

/// A CSV file of numbers with one header line.
inline std::vector<std::vector<double>> table(const std::string& name) {
    std::ifstream in(std::string(BREACH_ROOT "/tests/verification/pm4sand/reference/") + name);
    if (!in) throw std::runtime_error("cannot read " + name);
    std::vector<std::vector<double>> rows;
    std::string line;
    std::getline(in, line);
    while (std::getline(in, line)) {
        std::vector<double> row;
        std::stringstream cells(line);
        for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
        rows.push_back(row);
    }
    return rows;
}

}  // namespace breach::testing
