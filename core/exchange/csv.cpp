// Cells of the tables that the service and the CLI write. Every text is quoted, so that no caller
// has to look for commas or line ends in a label.
#include "core/exchange/csv.hpp"

#include <nlohmann/json.hpp>

namespace breach::exchange {

std::string csv_field(const nlohmann::json& value) {
    if (value.is_null()) return {};
    if (!value.is_string()) return value.dump();
    std::string quoted = "\"";
    for (const char each : value.get_ref<const std::string&>()) {
        if (each == '"') quoted += '"';
        quoted += each;
    }
    return quoted + '"';
}

}  // namespace breach::exchange
