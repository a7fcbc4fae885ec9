// The tables, version by version (PRAGMA user_version), and the views.
#pragma once

#include "services/orchestrator/store/connection.hpp"

namespace breach::orchestrator {

/// Brings the database to this program's version and views in one transaction, after a backup beside it when
/// it held data. Throws StoreError when the database is newer than the program.
void migrate(Connection& database, const std::filesystem::path& file);

}  // namespace breach::orchestrator
