// Values in tables of comma-separated text (RFC 4180).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace breach::exchange {

/// Nothing for null, a string in quotes (its own doubled), anything else as JSON writes it.
std::string csv_field(const nlohmann::json& value);

}  // namespace breach::exchange
