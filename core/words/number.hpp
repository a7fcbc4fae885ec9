// Formats numbers for a sentence.
#pragma once

#include <cstdarg>
#include <cstdio>
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

/// As printf; at most 1,023 bytes.
[[gnu::format(printf, 1, 2)]] inline std::string formatted(const char* format, ...) {
    char text[1024];
    std::va_list values;
    va_start(values, format);
    std::vsnprintf(text, sizeof text, format, values);
    va_end(values);
    return text;
}

}  // namespace breach::words
