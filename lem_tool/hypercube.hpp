// Latin hypercube samples of independent standard variables. Deterministic: own generator, no
// standard library distribution (those differ between libraries).
#pragma once

#include <cstdint>
#include <vector>

#include "core/scene/scene.hpp"

namespace breach::lem {

/// z with Phi(z) = probability, 0 < probability < 1.
double standard_normal_quantile(double probability);

/// One column of a Latin hypercube (McKay et al. 1979): `count` numbers in (0, 1), one in each of
/// `count` equal intervals, in random order. Columns of one seed are independent.
std::vector<double> hypercube_column(std::size_t count, std::uint64_t seed, std::size_t column);

/// Value of a variable with mean 1 at a probability. Normal values below zero are zero.
double factor_at(const scene::RandomVariable& variable, double probability);

}  // namespace breach::lem
