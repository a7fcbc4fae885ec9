// Values in tables of comma-separated text (RFC 4180): the service's results and the CLI's tables.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace breach::exchange {

/// Empty for null, a quoted string ("" for a quote), anything else as JSON.
std::string csv_field(const nlohmann::json& value);

}  // namespace breach::exchange
