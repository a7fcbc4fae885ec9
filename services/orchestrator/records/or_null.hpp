// Optional values as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

namespace breach::orchestrator {

template <class T>
nlohmann::json or_null(const std::optional<T>& value) {
    return value ? nlohmann::json(*value) : nlohmann::json(nullptr);
}

}  // namespace breach::orchestrator
