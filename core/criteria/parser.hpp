// Text -> words with their columns. Only expression.cpp needs it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace breach::criteria {

struct Word {
    enum class Kind { number, name, sign, end };
    Kind kind;
    std::string text;
    double value = 0.0;      ///< of a number
    std::size_t column = 0;  ///< from 1
};

/// What is wrong with a text, and at which column (from 1).
struct Complaint {
    std::size_t column;
    std::string cause;
    std::string remedy;
};

/// Throws Complaint at a character that belongs to no word.
std::vector<Word> words_of(std::string_view text);

}  // namespace breach::criteria
