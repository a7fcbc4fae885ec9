// Detects times in milliseconds where seconds are expected.
#pragma once

#include <string>

#include "core/words/number.hpp"

namespace breach::words {

/// Remedy for a time after the end [s] that would fit in milliseconds; empty for all others.
inline std::string seconds_remedy(double time, double end) {
    if (time <= 50.0 * end || 1e-3 * time > end) return "";
    return "times are in seconds: for " + text_of(time) + " ms, write " + text_of(1e-3 * time);
}

}  // namespace breach::words
