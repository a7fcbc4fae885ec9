// Columns of the FEM's telemetry: one table for the FEM's lines, trigger conditions, report labels
// and GET /v1/telemetry/fields.
#pragma once

#include <limits>
#include <span>
#include <string_view>

namespace breach::telemetry {

/// What a scene needs for the FEM to measure a column.
enum class Needs {
    nothing,
    softening,
    state_parameter,
    looks_at_strength,
    damping,
    water,
    watched_ground
};

struct Column {
    const char* name;     ///< key in a line, name in a condition
    const char* unit;     ///< "1": a ratio or a count
    const char* meaning;  ///< for display, one line
    Needs needs = Needs::nothing;
    double least = -std::numeric_limits<double>::infinity();  ///< lower bound of the values
    double most = std::numeric_limits<double>::infinity();
};

/// Columns of fem_solver with their requirements, in the order of history.h5.
std::span<const Column> fem_columns();

/// More names for conditions: results of the same run's other phases.
std::span<const Column> run_columns();

/// A column of either table; nullptr: none.
const Column* column_named(std::string_view name);

}  // namespace breach::telemetry
