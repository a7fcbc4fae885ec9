// One SQLite connection and its prepared statements. Only this folder uses sqlite3.h.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

struct sqlite3;
struct sqlite3_stmt;

namespace breach::orchestrator {

/// SQLite failed (disk full, damaged, busy for too long). The message names the statement.
class StoreError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// The change was undone because the disk is full.
class DiskFull : public StoreError {
  public:
    using StoreError::StoreError;
};

using Value = std::variant<std::nullptr_t, std::int64_t, double, std::string>;

template <class T>
Value value_or_null(const std::optional<T>& value) {
    if (!value) return nullptr;
    return *value;
}

/// The current row of a statement; columns by their names. Throws std::logic_error for an unknown
/// name.
class Row {
  public:
    std::string text(std::string_view column) const { return text_at(place_of(column)); }
    std::int64_t integer(std::string_view column) const { return integer_at(place_of(column)); }
    double real(std::string_view column) const { return real_at(place_of(column)); }
    bool yes(std::string_view column) const { return yes_at(place_of(column)); }
    nlohmann::json document(std::string_view column) const;
    std::optional<std::string> optional_text(std::string_view column) const {
        return unless_null(place_of(column), &Row::text_at);
    }
    std::optional<std::int64_t> optional_integer(std::string_view column) const {
        return unless_null(place_of(column), &Row::integer_at);
    }
    std::optional<double> optional_real(std::string_view column) const {
        return unless_null(place_of(column), &Row::real_at);
    }
    std::optional<bool> optional_yes(std::string_view column) const {
        return unless_null(place_of(column), &Row::yes_at);
    }
    std::optional<nlohmann::json> optional_document(std::string_view column) const;

  private:
    friend class Connection;
    struct Close {
        void operator()(sqlite3_stmt* statement) const;
    };
    int place_of(std::string_view column) const;
    bool is_null_at(int place) const;
    std::string text_at(int place) const;
    std::int64_t integer_at(int place) const;
    double real_at(int place) const;
    bool yes_at(int place) const { return integer_at(place) != 0; }
    template <class T>
    std::optional<T> unless_null(int place, T (Row::*read)(int) const) const {
        if (is_null_at(place)) return std::nullopt;
        return (this->*read)(place);
    }

    std::unique_ptr<sqlite3_stmt, Close> statement_;
    std::vector<std::string> columns_;
    /// Indices of the columns in the order in which the last row was read; the next row is usually
    /// read in the same order.
    mutable std::vector<int> asked_;
    mutable std::size_t turn_ = 0;
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
    /// Applies `read` to each row.
    template <class Read>
    auto select(const std::string& sql, const std::vector<Value>& values, const Read& read) {
        std::vector<std::invoke_result_t<const Read&, const Row&>> found;
        query(sql, values, [&](const Row& row) { found.push_back(read(row)); });
        return found;
    }
    /// The same for the first row; nothing: there is none.
    template <class Read>
    auto first(const std::string& sql, const std::vector<Value>& values, const Read& read) {
        std::optional<std::invoke_result_t<const Read&, const Row&>> found;
        query(sql, values, [&](const Row& row) {
            if (!found) found = read(row);
        });
        return found;
    }
    /// For a statement with one column.
    std::vector<std::string> texts(const std::string& sql, const std::vector<Value>& values = {});
    /// For one with one column, its first row; nothing: there is none, or it is null.
    std::optional<std::string> text(const std::string& sql, const std::vector<Value>& values = {});
    std::optional<std::int64_t> integer(const std::string& sql,
                                        const std::vector<Value>& values = {});
    /// Whether the query has any row.
    bool finds(const std::string& sql, const std::vector<Value>& values);
    std::int64_t last_row_id() const;

  private:
    struct Close {
        void operator()(sqlite3* database) const;
    };
    Row& prepared(const std::string& sql, const std::vector<Value>& values);
    [[noreturn]] void refuse(const std::string& what) const;

    std::unique_ptr<sqlite3, Close> database_;
    std::map<std::string, Row> statements_;
};

}  // namespace breach::orchestrator
