// The tables of the database, their version (PRAGMA user_version) and the views.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "services/orchestrator/store/connection.hpp"

namespace breach::orchestrator {

/// The version of a database: 0 when it is empty.
std::int64_t version_of(Connection& database);

/// Why this program cannot read a database of that version, with a remedy; nothing if it can.
std::optional<std::string> refusal_of(std::int64_t version);

/// Creates the tables of an empty database, and the views if they differ from this program's, in
/// one transaction. Throws StoreError for a database of another version.
void make_schema(Connection& database, const std::filesystem::path& file);

}  // namespace breach::orchestrator
