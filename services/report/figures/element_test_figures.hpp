// Figures of `fem_solver element-test`: curves of each test, CRR curves, undrained strength.
#pragma once

#include "services/report/chart/figure.hpp"

namespace breach::report {

/// folder: contains result.json and element_tests.h5. Throws IoError or BadInput.
std::vector<Figure> element_test_figures(const std::filesystem::path& folder);

}  // namespace breach::report
