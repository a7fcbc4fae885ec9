// The tables, version by version (PRAGMA user_version), and the views.
#pragma once

#include "services/orchestrator/store/connection.hpp"

namespace breach::orchestrator {

/// The version of a database: 0 when it is empty.
std::int64_t version_of(Connection& database);
/// That this program makes.
std::int64_t newest_version();

/// Brings the database to this program's version and views in one transaction, after a backup beside it when
/// it held data. Throws StoreError when the database is newer than the program.
void migrate(Connection& database, const std::filesystem::path& file);

}  // namespace breach::orchestrator
