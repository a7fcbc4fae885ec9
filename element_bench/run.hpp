// `fem_solver element-test` and `fem_solver calibrate` as phases.
#pragma once

#include "core/process/phase.hpp"

namespace breach::element_bench {

/// Runs every test of the document: result.json (numbers by test) and element_tests.h5 (curves).
process::Phase element_test_phase();

/// Runs the document's calibration: result.json (parameters, misfit by term before and after,
/// path).
process::Phase calibrate_phase();

}  // namespace breach::element_bench
