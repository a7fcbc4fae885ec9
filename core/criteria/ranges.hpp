// Whether a condition can ever be true, from the ranges of its fields.
#pragma once

#include <functional>
#include <limits>

#include "core/criteria/expression.hpp"

namespace breach::criteria {

struct Range {
    double least = -std::numeric_limits<double>::infinity();
    double most = std::numeric_limits<double>::infinity();
};

/// False only if no values within the ranges make the condition true.
bool can_be_true(const Expression& condition,
                 const std::function<Range(const std::string& field)>& range_of);

}  // namespace breach::criteria
