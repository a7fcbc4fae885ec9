// A JSON document against its schema: parsed strictly, checked whole, completed with the schema's
// defaults. The schema language is the part of JSON Schema 2020-12 that our schemas use, plus the
// annotations "unit", "x-plausible" and "x-slips" (slips.hpp).
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

/// Text -> JSON. Refuses duplicate keys, keys with / or ~ (which JSON pointers
/// escape), comments, numbers out of range, nesting deeper than 64. Throws
/// BadInput.
nlohmann::json parse_json(std::string_view text, const std::string& file);

/// The fault of a pointer into a material or into an entry of a list that the document does not have. What is new as a whole
/// ("/materials/new", the place behind a list's end) has none; nor do unknown keys, which complete_and_check refuses.
std::optional<fault::Fault> missing_parent(const nlohmann::json& document,
                                           const std::string& pointer);

/// Sets one "/json/pointer=value" (value: JSON, or a bare word taken as string). Returns the faults
/// found.
std::vector<fault::Fault> apply_override(nlohmann::json& document, const std::string& assignment);

/// Adds the schema's defaults to `document` in place and returns every fault: pointer, cause,
/// remedy. `warnings` get the numbers that are possible and not plausible, as flags "implausible".
std::vector<fault::Fault> complete_and_check(nlohmann::json& document, const nlohmann::json& schema,
                                             std::vector<fault::Flag>& warnings);
std::vector<fault::Fault> complete_and_check(nlohmann::json& document,
                                             const nlohmann::json& schema);

}  // namespace breach::scene
