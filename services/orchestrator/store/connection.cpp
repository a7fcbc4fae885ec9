// One connection to SQLite with its prepared statements. A connection is used by one thread at a
// time (NOMUTEX): the store's writer has one, each reader borrows another. Statements stay
// prepared for the life of the connection, by their text, so a query's text must not contain
// values.
#include "services/orchestrator/store/connection.hpp"

#include <sqlite3.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <type_traits>

namespace breach::orchestrator {

namespace {

/// Readers never wait in WAL mode. This is for another process that has the database open, such
/// as a backup.
constexpr int busy_timeout_ms = 10000;

/// Resets the statement even when reading its rows throws.
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

void Row::Close::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }

/// Every row asks for its columns in the same order, so the place found for the first row is
/// tried first for the next; names are compared, not searched.
int Row::place_of(std::string_view column) const {
    if (turn_ == asked_.size()) asked_.push_back(0);
    int& place = asked_[turn_++];
    if (place < std::ssize(columns_) && columns_[place] == column) return place;
    const auto found = std::ranges::find(columns_, column);
    if (found == columns_.end())
        throw std::logic_error("no column " + std::string(column) + " in " +
                               sqlite3_sql(statement_.get()));
    return place = static_cast<int>(found - columns_.begin());
}

bool Row::is_null_at(int place) const {
    return sqlite3_column_type(statement_.get(), place) == SQLITE_NULL;
}

std::string Row::text_at(int place) const {
    const auto* data = reinterpret_cast<const char*>(sqlite3_column_text(statement_.get(), place));
    // NULL reads as empty; where they differ, the caller uses optional_text.
    if (data == nullptr) return {};
    return {data, static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), place))};
}

std::int64_t Row::integer_at(int place) const {
    return sqlite3_column_int64(statement_.get(), place);
}

double Row::real_at(int place) const { return sqlite3_column_double(statement_.get(), place); }

nlohmann::json Row::document(std::string_view column) const {
    return nlohmann::json::parse(text(column));
}

std::optional<nlohmann::json> Row::optional_document(std::string_view column) const {
    const auto text = optional_text(column);
    return text ? std::optional(nlohmann::json::parse(*text)) : std::nullopt;
}

namespace {

/// Keeps the journal of savepoints in memory up to this size, beyond it in a temporary file. With
/// `temp_store=MEMORY` it would be a list of 1 kB pieces that every statement traverses: a retry of
/// 10,000 tasks blocked all writers for 20 s. SQLite writes at most 128 kB at once, and reports a
/// larger size as a full disk.
void set_memory_of_savepoints() {
    static const int once = sqlite3_config(SQLITE_CONFIG_STMTJRNL_SPILL, 126 * 1024);
    static_cast<void>(once);
}

}  // namespace

void Connection::Close::operator()(sqlite3* database) const { sqlite3_close_v2(database); }

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
    // auto_vacuum first: it has no effect once there are tables. journal_size_limit: shrinks the
    // log after a large removal. cache_size: 64 MB, as writes hit the same pages of a dozen
    // indexes. wal_autocheckpoint: copies the log to the database every 16 MB, once for many
    // commits.
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

/// Returns the number of changed rows, by which callers learn whether a condition in the
/// statement held.
std::int64_t Connection::change(const std::string& sql, const std::vector<Value>& values) {
    sqlite3_stmt* statement = prepared(sql, values).statement_.get();
    const Rewind rewind{statement};
    if (sqlite3_step(statement) != SQLITE_DONE) refuse(sql);
    return sqlite3_changes64(database_.get());
}

void Connection::query(const std::string& sql, const std::vector<Value>& values,
                       const std::function<void(const Row&)>& visit) {
    const Row& row = prepared(sql, values);
    const Rewind rewind{row.statement_.get()};
    int code = SQLITE_ROW;
    while ((code = sqlite3_step(rewind.statement)) == SQLITE_ROW) {
        row.turn_ = 0;
        visit(row);
    }
    if (code != SQLITE_DONE) refuse(sql);
}

std::vector<std::string> Connection::texts(const std::string& sql,
                                           const std::vector<Value>& values) {
    return select(sql, values, [](const Row& row) { return row.text_at(0); });
}

std::optional<std::string> Connection::text(const std::string& sql,
                                            const std::vector<Value>& values) {
    return first(sql, values, [](const Row& row) { return row.unless_null(0, &Row::text_at); })
        .value_or(std::nullopt);
}

std::optional<std::int64_t> Connection::integer(const std::string& sql,
                                                const std::vector<Value>& values) {
    return first(sql, values, [](const Row& row) { return row.unless_null(0, &Row::integer_at); })
        .value_or(std::nullopt);
}

bool Connection::finds(const std::string& sql, const std::vector<Value>& values) {
    bool found = false;
    query(sql, values, [&](const Row&) { found = true; });
    return found;
}

std::int64_t Connection::last_row_id() const { return sqlite3_last_insert_rowid(database_.get()); }

Row& Connection::prepared(const std::string& sql, const std::vector<Value>& values) {
    Row& kept = statements_[sql];
    if (!kept.statement_) {
        sqlite3_stmt* statement = nullptr;
        if (sqlite3_prepare_v3(database_.get(), sql.c_str(), -1, SQLITE_PREPARE_PERSISTENT,
                               &statement, nullptr) != SQLITE_OK)
            refuse(sql);
        kept.statement_.reset(statement);
        for (int i = 0; i < sqlite3_column_count(statement); ++i)
            kept.columns_.emplace_back(sqlite3_column_name(statement, i));
    }
    int index = 0;
    for (const Value& value : values) {
        if (bind(kept.statement_.get(), ++index, value) != SQLITE_OK) refuse(sql);
    }
    return kept;
}

/// A full disk is the one error that callers treat apart: they answer 503 and repeat, and nothing
/// is lost.
void Connection::refuse(const std::string& what) const {
    const std::string text =
        "database: " + std::string(sqlite3_errmsg(database_.get())) + " (" + what + ")";
    const int code = sqlite3_errcode(database_.get()) & 0xFF;  // without its extension
    const int cause = sqlite3_system_errno(database_.get());
    if (code == SQLITE_FULL || (code == SQLITE_IOERR && (cause == ENOSPC || cause == EDQUOT)))
        throw DiskFull(text);
    throw StoreError(text);
}

}  // namespace breach::orchestrator
