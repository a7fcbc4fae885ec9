// Remedies as text that can be pasted behind a command. A message names one, or alternatives with
// the first one best (tests/misuse/remedies.py follows each flag's first).
#pragma once

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstring>
#include <string>

#include "core/words/number.hpp"

namespace breach::words {

/// "--set /mpm/cell_size=0.38", quoted where a shell would read it otherwise. `value`: as in JSON.
inline std::string set(const std::string& pointer, const std::string& value) {
    const std::string assignment = pointer + "=" + value;
    const auto is_plain = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 || std::strchr("/_.+-=", c);
    };
    if (std::ranges::all_of(assignment, is_plain)) return "--set " + assignment;
    return "--set '" + assignment + "'";
}

inline std::string set(const std::string& pointer, double value) {
    return set(pointer, text_of(value, 9));
}

/// [from, to]
inline std::string set(const std::string& pointer, const std::array<double, 2>& range) {
    return set(pointer, "[" + text_of(range[0], 9) + "," + text_of(range[1], 9) + "]");
}

/// To two digits, never above a limit.
inline double rounded_down(double value) {
    const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
    return std::floor(value / unit * (1.0 + 1e-12)) * unit;
}

}  // namespace breach::words
