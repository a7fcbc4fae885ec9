#include "services/orchestrator/store/migrations.hpp"

#include <spdlog/spdlog.h>

#include <array>

#include "services/orchestrator/files/failpoint.hpp"
#include "services/orchestrator/store/versions.hpp"
#include "services/orchestrator/store/views.hpp"

namespace breach::orchestrator {

namespace {

const std::array versions{version_1, version_2, version_3, version_4,  version_5, version_6,
                          version_7, version_8, version_9, version_10, version_11};

std::int64_t number_in(Connection& database, const std::string& pragma) {
    std::int64_t number = 0;
    database.query("PRAGMA " + pragma, {}, [&](const Row& row) { number = row.integer(0); });
    return number;
}

/// A database of before version 10 keeps the pages that it once had. Turning it round copies it
/// once; where there is no room for that it goes on growing, and serves.
void let_it_shrink(Connection& database, const std::filesystem::path& file) {
    constexpr std::int64_t incremental = 2;
    if (number_in(database, "auto_vacuum") == incremental) return;
    try {
        database.script("PRAGMA auto_vacuum=INCREMENTAL; VACUUM");
    } catch (const StoreError& error) {
        spdlog::warn("{} cannot be made to shrink: {}", file.string(), error.what());
    }
}

}  // namespace

std::int64_t version_of(Connection& database) { return number_in(database, "user_version"); }

std::int64_t newest_version() { return static_cast<std::int64_t>(versions.size()); }

void migrate(Connection& database, const std::filesystem::path& file) {
    const std::int64_t version = version_of(database);
    const std::int64_t newest = newest_version();
    if (version == newest && views_are_current(database)) {
        let_it_shrink(database, file);
        return;
    }
    if (version > newest) {
        throw StoreError(file.string() + " is of version " + std::to_string(version) +
                         ", but this program knows only up to " + std::to_string(newest) +
                         ": use the newer program");
    }
    if (version > 0 && version < newest) {
        std::filesystem::path backup = file;
        backup += ".before_version_" + std::to_string(newest);
        std::filesystem::remove(backup);
        database.change("VACUUM INTO ?", {backup.string()});
    }
    database.script("BEGIN IMMEDIATE");
    try {
        for (std::int64_t v = version; v < newest; ++v) {
            database.script(versions[static_cast<std::size_t>(v)]);
            reach(Failpoint::migration_half_way);
        }
        make_views(database);
        database.script("PRAGMA user_version=" + std::to_string(newest));
        database.script("COMMIT");
    } catch (const StoreError&) {
        database.script("ROLLBACK");
        throw;
    }
    let_it_shrink(database, file);
}

}  // namespace breach::orchestrator
