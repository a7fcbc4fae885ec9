// The table of a sweep's results, with each column defined once. The SQL view, the JSON answers,
// CSV, HDF5, the table of `breach` and the API's description are generated from this list: a
// further number of the MPM's result.json is one more line in result_columns.cpp.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace breach::orchestrator {

/// Type of a column's values; each can be null, which means not known (yet).
enum class ColumnKind {
    number,
    yes_no,
    word,
    flags,  ///< a list of {code, severity, message, pointer, phase}; in CSV its codes, joined by ;
};

struct ResultColumn {
    const char* name;  ///< the same in JSON, CSV, HDF5 and SQL
    const char*
        pointer;  ///< JSON pointer in the MPM's result.json; empty: defined in store/views.cpp
    ColumnKind kind;
    const char* unit;   ///< "m", "s", "1"; empty: it has none
    const char* title;  ///< heading of a table for people; empty: not shown in such tables
    const char* meaning;
};

/// In the order of the CSV.
std::span<const ResultColumn> result_columns();
const char* name_of(ColumnKind kind);

/// One value for each of result_columns(), in their order.
using ResultRow = std::vector<nlohmann::json>;

/// Rows with their columns: of single runs, or of means.
struct ResultTable {
    const char* kind;  ///< of its file
    std::span<const ResultColumn> columns;
    std::vector<ResultRow> rows;
};

const nlohmann::json& value_of(const ResultRow& row, std::string_view name,
                               std::span<const ResultColumn> columns = result_columns());
nlohmann::json& value_of(ResultRow& row, std::string_view name,
                         std::span<const ResultColumn> columns = result_columns());

/// "still_moving;implausible": the codes of a list of flags, each once.
std::string codes_of(const nlohmann::json& flags);

/// The states of a row: the states of tasks, "questionable", and "not_reached" (the FEM ended
/// regularly before the transfer time).
bool is_row_state(std::string_view word);

}  // namespace breach::orchestrator
