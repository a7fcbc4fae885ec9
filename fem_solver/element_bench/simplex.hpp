// Least value of a function of a few variables without derivatives (Nelder & Mead 1965).
#pragma once

#include <functional>
#include <vector>

namespace breach::element_bench {

struct SimplexSettings {
    double size;        ///< edge of the first simplex
    double least_size;  ///< ends when every vertex is as near as this to the best one
    int most_evaluations;
};

/// The best point found from `start`. Deterministic.
std::vector<double> least_by_simplex(const std::function<double(const std::vector<double>&)>& f,
                                     const std::vector<double>& start,
                                     const SimplexSettings& settings);

}  // namespace breach::element_bench
