// Checks a JSON document against its schema: strict parsing, all faults, defaults filled in.
// Supports the part of JSON Schema 2020-12 that our schemas use, and the annotations "unit",
// "x-plausible" and "x-slips" (slips.hpp).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/fault/fault.hpp"
#include "core/fault/flag.hpp"

namespace breach::scene {

const nlohmann::json& scene_schema();
const nlohmann::json& study_schema();
const nlohmann::json& element_test_schema();

/// Parses JSON. Refuses duplicate keys, keys with / or ~ (which JSON pointers escape) or of more
/// than 200 characters, comments, numbers out of range, nesting deeper than 64. Throws BadInput.
nlohmann::json parse_json(std::string_view text, const std::string& file);

/// Fault of a pointer into a material or list entry that the document lacks. None for a new whole
/// entry ("/materials/new", one past a list's end) and for unknown keys, which complete_and_check
/// reports.
std::optional<fault::Fault> missing_parent(const nlohmann::json& document,
                                           const std::string& pointer);

/// Sets one "/json/pointer=value" (value: JSON, or a bare word taken as string). Returns the faults
/// found.
std::vector<fault::Fault> apply_override(nlohmann::json& document, const std::string& assignment);

/// Adds the schema's defaults to `document` and returns all faults. `warnings` get possible but
/// implausible numbers, as flags "implausible". Throws BadInput, with the file's name, for more
/// than fault::most_faults: checks of the contents would then read faulty entries.
std::vector<fault::Fault> complete_and_check(nlohmann::json& document, const nlohmann::json& schema,
                                             const std::string& file,
                                             std::vector<fault::Flag>& warnings);
std::vector<fault::Fault> complete_and_check(nlohmann::json& document, const nlohmann::json& schema,
                                             const std::string& file = "document");

}  // namespace breach::scene
