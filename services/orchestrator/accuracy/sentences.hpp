// Findings of an accuracy study in sentences.
#pragma once

#include <string>

#include "services/orchestrator/accuracy/accuracy_rows.hpp"

namespace breach::orchestrator {

/// "order 1.4, limit 30.9 m, the finest within 2.1 % of it (grid convergence index)"
std::string course_in_words(const statistics::Convergence& convergence, const AccuracyPlan& plan,
                            std::size_t ladder);
/// "the finest rung of each ladder"
std::string reference_in_words(const Reference& reference);
/// The recommended setting, or why there is none.
std::string recommendation_in_words(const AccuracyTable& table);

}  // namespace breach::orchestrator
