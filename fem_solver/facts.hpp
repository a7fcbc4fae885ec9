// The results of an analysis: entries of result.json, flags, and a few sentences.
#pragma once

#include "fem_solver/course.hpp"

namespace breach::fem {

/// Reports its cost and its settings.
void report_facts(Course& course);
/// Reports its end and its results, as entries and in sentences.
void report_end(Course& course);
void print_profile(const Course& course);

}  // namespace breach::fem
