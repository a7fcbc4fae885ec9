// Splits an expression into tokens with their columns. Only expression.cpp needs it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace breach::criteria {

struct Word {
    enum class Kind { number, name, sign, end };
    Kind kind;
    std::string text;
    double value = 0.0;      ///< value of a number token
    std::size_t column = 0;  ///< from 1
};

/// A syntax error and its column (from 1).
struct Complaint {
    std::size_t column;
    std::string cause;
    std::string remedy;
};

/// Throws Complaint at a character that starts no token.
std::vector<Word> words_of(std::string_view text);

}  // namespace breach::criteria
