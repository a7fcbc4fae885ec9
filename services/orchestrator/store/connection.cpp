#include "services/orchestrator/store/connection.hpp"

#include <sqlite3.h>

#include <type_traits>

namespace breach::orchestrator {

namespace {

constexpr int busy_timeout_ms = 10000;

/// Gives the statement back reusable however the reading of its rows ends.
struct Rewind {
    sqlite3_stmt* statement;
    ~Rewind() { sqlite3_reset(statement); }
};

int bind(sqlite3_stmt* statement, int index, const Value& value) {
    return std::visit(
        [&](const auto& v) {
            using T = std::decay_t<decltype(v)>;
            if constexpr (std::is_same_v<T, std::nullptr_t>) {
                return sqlite3_bind_null(statement, index);
            } else if constexpr (std::is_same_v<T, std::int64_t>) {
                return sqlite3_bind_int64(statement, index, v);
            } else if constexpr (std::is_same_v<T, double>) {
                return sqlite3_bind_double(statement, index, v);
            } else {
                return sqlite3_bind_text64(statement, index, v.data(), v.size(), SQLITE_TRANSIENT,
                                           SQLITE_UTF8);
            }
        },
        value);
}

}  // namespace

bool Row::is_null(int column) const {
    return sqlite3_column_type(statement_, column) == SQLITE_NULL;
}

std::string Row::text(int column) const {
    const auto* data = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
    if (data == nullptr) return {};
    return {data, static_cast<std::size_t>(sqlite3_column_bytes(statement_, column))};
}

std::int64_t Row::integer(int column) const { return sqlite3_column_int64(statement_, column); }
double Row::real(int column) const { return sqlite3_column_double(statement_, column); }

std::optional<std::string> Row::optional_text(int column) const {
    if (is_null(column)) return std::nullopt;
    return text(column);
}

std::optional<std::int64_t> Row::optional_integer(int column) const {
    if (is_null(column)) return std::nullopt;
    return integer(column);
}

std::optional<double> Row::optional_real(int column) const {
    if (is_null(column)) return std::nullopt;
    return real(column);
}

namespace {

/// What a savepoint could have to put back stays in memory up to this size, and goes to a temporary
/// file beyond it. With `temp_store=MEMORY` it would be a list of 1 kB pieces that every statement
/// walks along: a retry of 10,000 tasks held all writers up for 20 s. SQLite writes at most 128 kB
/// at once and takes more for a full disk.
void set_memory_of_savepoints() {
    static const int once = sqlite3_config(SQLITE_CONFIG_STMTJRNL_SPILL, 126 * 1024);
    static_cast<void>(once);
}

}  // namespace

void Connection::Close::operator()(sqlite3* database) const { sqlite3_close_v2(database); }
void Connection::Finalize::operator()(sqlite3_stmt* statement) const {
    sqlite3_finalize(statement);
}

Connection::Connection(const std::filesystem::path& file, Access access) {
    const int flags = SQLITE_OPEN_NOMUTEX |
                      (access == Access::read_only ? SQLITE_OPEN_READONLY
                                                   : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
    set_memory_of_savepoints();
    sqlite3* database = nullptr;
    const int code = sqlite3_open_v2(file.c_str(), &database, flags, nullptr);
    database_.reset(database);
    if (code != SQLITE_OK) refuse("opening " + file.string());
    sqlite3_busy_timeout(database, busy_timeout_ms);
    script("PRAGMA foreign_keys=ON");
    if (access == Access::read_only) return;
    // What a large removal wrote does not stay in the log's file. auto_vacuum first: it is only
    // taken by a database without tables.
    // What is written hits the same pages of a dozen indexes: they stay in memory (64 MB), and are
    // copied from the log to the database once for many commits (every 16 MB).
    script(
        "PRAGMA auto_vacuum=INCREMENTAL; PRAGMA journal_mode=WAL; PRAGMA synchronous=FULL; "
        "PRAGMA journal_size_limit=67108864; PRAGMA cache_size=-65536; PRAGMA "
        "wal_autocheckpoint=4000");
}

Connection::~Connection() = default;

void Connection::script(const std::string& sql) {
    if (sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
        refuse(sql);
}

std::int64_t Connection::change(const std::string& sql, const std::vector<Value>& values) {
    sqlite3_stmt* statement = prepared(sql, values);
    const Rewind rewind{statement};
    if (sqlite3_step(statement) != SQLITE_DONE) refuse(sql);
    return sqlite3_changes64(database_.get());
}

void Connection::query(const std::string& sql, const std::vector<Value>& values,
                       const std::function<void(const Row&)>& visit) {
    sqlite3_stmt* statement = prepared(sql, values);
    const Rewind rewind{statement};
    int code = SQLITE_ROW;
    while ((code = sqlite3_step(statement)) == SQLITE_ROW) visit(Row(statement));
    if (code != SQLITE_DONE) refuse(sql);
}

bool Connection::finds(const std::string& sql, const std::string& value) {
    bool found = false;
    query(sql, {value}, [&](const Row&) { found = true; });
    return found;
}

std::int64_t Connection::last_row_id() const { return sqlite3_last_insert_rowid(database_.get()); }

sqlite3_stmt* Connection::prepared(const std::string& sql, const std::vector<Value>& values) {
    auto& kept = statements_[sql];
    if (!kept) {
        sqlite3_stmt* statement = nullptr;
        if (sqlite3_prepare_v3(database_.get(), sql.c_str(), -1, SQLITE_PREPARE_PERSISTENT,
                               &statement, nullptr) != SQLITE_OK)
            refuse(sql);
        kept.reset(statement);
    }
    int index = 0;
    for (const Value& value : values) {
        if (bind(kept.get(), ++index, value) != SQLITE_OK) refuse(sql);
    }
    return kept.get();
}

void Connection::refuse(const std::string& what) const {
    throw StoreError("database: " + std::string(sqlite3_errmsg(database_.get())) + " (" + what +
                     ")");
}

}  // namespace breach::orchestrator
