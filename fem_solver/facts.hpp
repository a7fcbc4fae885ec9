// Results of an analysis: entries of result.json, flags, and log messages.
// analyse() calls them once, after the last stage or the entanglement; a stopped run reports
// nothing but its profile.
#pragma once

#include "fem_solver/course.hpp"

namespace breach::fem {

/// Reports its cost and its settings.
void report_facts(Course& course);
/// Reports the end and the results, as entries and log messages.
void report_end(Course& course);
void print_profile(const Course& course);

}  // namespace breach::fem
