// A laboratory's triaxial test from a CSV file: columns by name, every line checked.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/fault/fault.hpp"
#include "element_bench/specimen.hpp"

namespace breach::element_bench {

/// The file's columns by their original names (docs/how-to/calibrate_a_sand.md). Adds faults with
/// file and line to `faults`; `pointer` is the entry with the file's name.
nlohmann::json read_triaxial_file(const std::filesystem::path& file, Boundary boundary,
                                  const std::string& pointer, std::vector<fault::Fault>& faults);

}  // namespace breach::element_bench
