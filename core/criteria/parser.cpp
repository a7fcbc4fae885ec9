#include "core/criteria/parser.hpp"

#include <cctype>
#include <charconv>
#include <cmath>

namespace breach::criteria {

namespace {

bool begins_name(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

Word number_at(std::string_view text, std::size_t at) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data() + at, text.data() + text.size(), value);
    if (error != std::errc{} || !std::isfinite(value))
        throw Complaint{at + 1, "is not a number", "write it like 0.97 or 1e-3"};
    return {Word::Kind::number, std::string(text.data() + at, end), value, at + 1};
}

Word name_at(std::string_view text, std::size_t at) {
    std::size_t end = at;
    while (end < text.size() && (begins_name(text[end]) || is_digit(text[end]))) ++end;
    return {Word::Kind::name, std::string(text.substr(at, end - at)), 0.0, at + 1};
}

Word sign_at(std::string_view text, std::size_t at) {
    constexpr std::string_view single = "+-*/()<>,";
    if (single.find(text[at]) == std::string_view::npos) {
        throw Complaint{at + 1, std::string("the character '") + text[at] + "' has no meaning here",
                        "use numbers, telemetry fields, + - * / < <= > >= and or not ( ) ,"};
    }
    const bool two = (text[at] == '<' || text[at] == '>') && text.substr(at + 1, 1) == "=";
    return {Word::Kind::sign, std::string(text.substr(at, two ? 2 : 1)), 0.0, at + 1};
}

}  // namespace

std::vector<Word> words_of(std::string_view text) {
    std::vector<Word> words;
    std::size_t at = 0;
    while (at < text.size()) {
        if (std::isspace(static_cast<unsigned char>(text[at])) != 0) {
            ++at;
            continue;
        }
        const bool number = is_digit(text[at]) || text[at] == '.';
        words.push_back(number                  ? number_at(text, at)
                        : begins_name(text[at]) ? name_at(text, at)
                                                : sign_at(text, at));
        at += words.back().text.size();
    }
    words.push_back({Word::Kind::end, "the end", 0.0, text.size() + 1});
    return words;
}

}  // namespace breach::criteria
