// The columns of the FEM's telemetry: one table for the FEM's lines, the conditions of triggers,
// the labels of reports and GET /v1/telemetry/fields.
#pragma once

#include <limits>
#include <span>
#include <string_view>

namespace breach::telemetry {

/// Requirement of a column on the scene, for the FEM to measure it.
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
    double least = -std::numeric_limits<double>::infinity();  ///< its lower bound
    double most = std::numeric_limits<double>::infinity();
};

/// The columns of fem_solver, in the order of history.h5, with their requirements.
std::span<const Column> fem_columns();

/// Further names for conditions: numbers of the same run from other phases.
std::span<const Column> run_columns();

/// A column of either table; nullptr: no such column.
const Column* column_named(std::string_view name);

}  // namespace breach::telemetry
