// The columns of the FEM's telemetry: one table from which the FEM writes its lines, triggers check
// their conditions, reports take their labels and GET /v1/telemetry/fields answers.
#pragma once

#include <limits>
#include <span>
#include <string_view>

namespace breach::telemetry {

/// What a scene must have for its FEM to measure a column.
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
    const char* name;     ///< key of the line, name in a condition
    const char* unit;     ///< "1": a ratio or a count
    const char* meaning;  ///< for people, one line
    Needs needs = Needs::nothing;
    double least = -std::numeric_limits<double>::infinity();  ///< that it can be
    double most = std::numeric_limits<double>::infinity();
};

/// What fem_solver writes, in the order of history.h5, of a scene that has what they need.
std::span<const Column> fem_columns();

/// What a condition may use beside them: numbers of the same run that other phases give.
std::span<const Column> run_columns();

/// Of either table; nullptr: no such column.
const Column* column_named(std::string_view name);

}  // namespace breach::telemetry
