// `fem_solver calibrate` for documents with NorSand.
#pragma once

#include "core/exchange/archive.hpp"
#include "core/process/phase.hpp"

namespace breach::element_bench {

/// An empty archive for element-test curves.
exchange::Archive empty_archive();

bool seeks_norsand(const scene::Scene& scene);
process::Plan norsand_calibration_plan(const scene::Scene& scene);

/// result.json (parameters with errors, results by test) and element_tests.h5: columns named
/// `<test>.measured.<column>` and `<test>.computed.<column>`.
process::Outcome run_norsand_calibration(process::Session& session);

}  // namespace breach::element_bench
