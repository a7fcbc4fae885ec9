// Formats a number for a sentence.
#pragma once

#include <sstream>
#include <string>

namespace breach::words {

/// "0.25", "1e+09"; `digits`: most significant digits.
inline std::string text_of(double value, int digits = 6) {
    std::ostringstream text;
    text.precision(digits);
    text << value;
    return text.str();
}

}  // namespace breach::words
