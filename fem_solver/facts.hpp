// What an analysis has come to: facts of result.json, flags, and a few plain words.
#pragma once

#include "fem_solver/course.hpp"

namespace breach::fem {

/// What it took, and what it was done with.
void report_facts(Course& course);
/// How it ended and what it came to, as facts and in plain words.
void report_end(Course& course);
void print_profile(const Course& course);

}  // namespace breach::fem
