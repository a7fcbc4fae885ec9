// Results of an analysis: entries of result.json, flags, and log messages.
#pragma once

#include "fem_solver/course.hpp"

namespace breach::fem {

/// Reports its cost and its settings.
void report_facts(Course& course);
/// Reports the end and the results, as entries and log messages.
void report_end(Course& course);
void print_profile(const Course& course);

}  // namespace breach::fem
