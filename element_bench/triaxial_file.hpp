// A laboratory's triaxial test from a CSV file: columns by name, every line checked.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/fault/fault.hpp"
#include "element_bench/specimen.hpp"

namespace breach::element_bench {

/// The columns of the file by their original names (docs/how-to/calibrate_a_sand.md). Adds faults to `faults`, with file
/// and line; `pointer` is the entry that names it.
nlohmann::json read_triaxial_file(const std::filesystem::path& file, Boundary boundary,
                                  const std::string& pointer, std::vector<fault::Fault>& faults);

}  // namespace breach::element_bench
