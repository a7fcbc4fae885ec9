// One SQLite connection and its prepared statements. Only the .cpp files of this folder know
// sqlite3.h.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

struct sqlite3;
struct sqlite3_stmt;

namespace breach::orchestrator {

/// The database refused (disk full, damaged, busy for too long). The message names the statement.
class StoreError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

using Value = std::variant<std::nullptr_t, std::int64_t, double, std::string>;

template <class T>
Value value_or_null(const std::optional<T>& value) {
    if (!value) return nullptr;
    return *value;
}

/// A row of a result while it is being read; columns from 0.
class Row {
  public:
    explicit Row(sqlite3_stmt* statement) : statement_(statement) {}
    bool is_null(int column) const;
    std::string text(int column) const;
    std::int64_t integer(int column) const;
    double real(int column) const;
    std::optional<std::string> optional_text(int column) const;
    std::optional<std::int64_t> optional_integer(int column) const;
    std::optional<double> optional_real(int column) const;

  private:
    sqlite3_stmt* statement_;
};

enum class Access { read_only, read_write };

class Connection {
  public:
    Connection(const std::filesystem::path& file, Access access);
    ~Connection();
    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;

    /// Runs statements without parameters or results, one after another.
    void script(const std::string& sql);
    /// Runs one statement; returns the number of rows changed.
    std::int64_t change(const std::string& sql, const std::vector<Value>& values = {});
    void query(const std::string& sql, const std::vector<Value>& values,
               const std::function<void(const Row&)>& visit);
    /// Whether the query has any row.
    bool finds(const std::string& sql, const std::string& value);
    std::int64_t last_row_id() const;

  private:
    struct Close {
        void operator()(sqlite3* database) const;
    };
    struct Finalize {
        void operator()(sqlite3_stmt* statement) const;
    };
    sqlite3_stmt* prepared(const std::string& sql, const std::vector<Value>& values);
    [[noreturn]] void refuse(const std::string& what) const;

    std::unique_ptr<sqlite3, Close> database_;
    std::map<std::string, std::unique_ptr<sqlite3_stmt, Finalize>> statements_;
};

}  // namespace breach::orchestrator
