#include "core/motion/units.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "core/motion/series.hpp"

namespace breach::motion {

namespace {

using Spelling = std::pair<std::string_view, std::string_view>;

/// Applied in this order to a header in upper case, so that CM/SEC**2 and CM PER S PER S become
/// CM/S2 and CM/S/S.
constexpr Spelling spellings[] = {
    {"\t", " "},          {"²", "2"},      {"×", "*"},       {"**", ""},      {"^", ""},
    {" SQUARED", "2"},    {" PER ", "/"},  {" TIMES ", "*"}, {" X ", "*"},    {" DIVIDED BY ", "/"},
    {" /", "/"},          {"/ ", "/"},     {" *", "*"},      {"* ", "*"},     {"CENTIMET", "CMET"},
    {"MILLIMET", "MMET"}, {"METERS", "M"}, {"METRES", "M"},  {"METER", "M"},  {"METRE", "M"},
    {"INCHES", "IN"},     {"INCH", "IN"},  {"FEET", "FT"},   {"FOOT", "FT"},  {"SECONDS", "S"},
    {"SECOND", "S"},      {"SECS", "S"},   {"SEC", "S"},     {"GALS", "GAL"}, {"G'S", "G"},
};

std::string spelled(std::string text) {
    for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    for (const auto& [from, to] : spellings)
        for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos;)
            text.replace(at, from.size(), to);
    return text;
}

/// Words of a spelled text: blanks and brackets part them, and signs of punctuation at their end.
std::vector<std::string> tokens_of(std::string text) {
    std::ranges::replace_if(
        text,
        [](char c) { return std::string_view("()[]{},;:=").find(c) != std::string_view::npos; },
        ' ');
    std::istringstream in(text);
    std::vector<std::string> tokens;
    for (std::string token; in >> token;) {
        while (!token.empty() && token.back() == '.') token.pop_back();
        if (!token.empty()) tokens.push_back(token);
    }
    return tokens;
}

std::optional<double> positive(std::string_view text) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = error == std::errc() && end == text.data() + text.size();
    if (!whole || !std::isfinite(value) || !(value > 0.0)) return std::nullopt;
    return value;
}

/// "G", "CM/S/S", "M/S2"; a length alone is a displacement.
std::optional<Unit> plain_unit(std::string_view token) {
    if (token == "G" || token == "GS") return Unit{Quantity::acceleration, standard_gravity};
    if (token == "GAL") return Unit{Quantity::acceleration, 0.01};
    constexpr std::pair<std::string_view, double> lengths[] = {
        {"MM", 0.001}, {"CM", 0.01}, {"M", 1.0}, {"IN", 0.0254}, {"FT", 0.3048}};
    const std::string_view top = token.substr(0, token.find('/'));
    const std::string_view below = token.substr(top.size());
    for (const auto& [name, metres] : lengths) {
        if (top != name) continue;
        if (below.empty()) return Unit{Quantity::displacement, metres};
        if (below == "/S") return Unit{Quantity::velocity, metres};
        if (below == "/S/S" || below == "/S2") return Unit{Quantity::acceleration, metres};
    }
    return std::nullopt;
}

/// A plain unit with a number before or behind it: "0.01*G", "G/10", "CM/S/S*1000".
std::optional<Unit> unit_of(std::string_view token) {
    if (const auto plain = plain_unit(token)) return plain;
    const std::size_t last = token.find_last_of("*/");
    if (last != std::string_view::npos) {
        const auto scale = positive(token.substr(last + 1));
        auto unit = scale ? unit_of(token.substr(0, last)) : std::nullopt;
        if (unit) {
            unit->factor *= token[last] == '/' ? 1.0 / *scale : *scale;
            return unit;
        }
    }
    const std::size_t first = token.find('*');
    if (first == std::string_view::npos) return std::nullopt;
    const std::size_t over = token.substr(0, first).find('/');
    const auto top = positive(token.substr(0, std::min(over, first)));
    const auto below = over < first ? positive(token.substr(over + 1, first - over - 1)) : 1.0;
    auto unit = top && below ? plain_unit(token.substr(first + 1)) : std::nullopt;
    if (unit) unit->factor *= *top / *below;
    return unit;
}

/// "TIME", "SERIES", what goes on with the sentence; "10", "X" or "S" would go on with the unit.
bool is_word(const std::string& token) {
    const auto letters = std::ranges::count_if(
        token, [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; });
    return std::isalpha(static_cast<unsigned char>(token.front())) != 0 && letters > 1;
}

/// The text behind UNITS OF, up to the end of its sentence.
std::optional<std::string> phrase_of_units(const std::string& text) {
    const auto is_letter = [&](std::size_t i) {
        return i < text.size() && std::isalpha(static_cast<unsigned char>(text[i])) != 0;
    };
    std::size_t at = text.find("UNIT"), end = 0;
    for (; at != std::string::npos; at = text.find("UNIT", at + 4)) {
        end = text.compare(at, 5, "UNITS") == 0 ? at + 5 : at + 4;
        if ((at == 0 || !is_letter(at - 1)) && !is_letter(end)) break;
    }
    if (at == std::string::npos) return std::nullopt;
    std::string phrase = text.substr(end);
    constexpr std::string_view fillers[] = {" ", ":", "=", "OF ", "IN ", "ARE "};
    for (bool found = true; found;) {
        found = false;
        for (const std::string_view filler : fillers)
            if (phrase.starts_with(filler)) phrase.erase(0, filler.size()), found = true;
    }
    for (std::size_t i = 0; i < phrase.size(); ++i) {
        const bool decimal = phrase[i] == '.' && i + 1 < phrase.size() &&
                             std::isdigit(static_cast<unsigned char>(phrase[i + 1])) != 0;
        if (phrase[i] == ',' || phrase[i] == ';' || (phrase[i] == '.' && !decimal))
            return phrase.substr(0, i);
    }
    return phrase;
}

bool begins_number(const std::string& token) {
    return std::isdigit(static_cast<unsigned char>(token.front())) != 0 || token.front() == '.';
}

/// The unit with which a phrase begins; what follows must not belong to it.
std::optional<Unit> first_unit(std::vector<std::string> tokens) {
    if (tokens.size() > 1 && begins_number(tokens[0])) {
        tokens[1] = tokens[0] + "*" + tokens[1];
        tokens.erase(tokens.begin());
    }
    if (tokens.empty() || (tokens.size() > 1 && !is_word(tokens[1]))) return std::nullopt;
    return unit_of(tokens[0]);
}

/// What the words of a header name.
std::vector<Quantity> quantities_in(const std::vector<std::string>& tokens) {
    std::vector<Quantity> named;
    for (const std::string& each : tokens) {
        if (each.starts_with("ACCEL") || each == "ACC") named.push_back(Quantity::acceleration);
        if (each.starts_with("VELOC") || each == "VEL") named.push_back(Quantity::velocity);
        if (each.starts_with("DISPL") || each == "DISP") named.push_back(Quantity::displacement);
    }
    return named;
}

}  // namespace

std::optional<Unit> unit_in_header(const std::string& header) {
    const std::string text = spelled(header);
    const std::vector<std::string> tokens = tokens_of(text);
    const std::vector<Quantity> named = quantities_in(tokens);
    const auto fits = [&](const Unit& unit) {
        return named.empty() || std::ranges::find(named, unit.quantity) != named.end();
    };
    if (const auto phrase = phrase_of_units(text)) {
        const auto unit = first_unit(tokens_of(*phrase));
        return unit && fits(*unit) ? unit : std::nullopt;
    }
    std::optional<Unit> only;
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        const auto unit = unit_of(tokens[i]);
        if (!unit || !fits(*unit)) continue;
        const bool scaled = (i > 0 && begins_number(tokens[i - 1])) ||
                            (i + 1 < tokens.size() && !is_word(tokens[i + 1]));
        const bool other =
            only && (only->quantity != unit->quantity || only->factor != unit->factor);
        if (scaled || other) return std::nullopt;
        only = unit;
    }
    return only;
}

namespace {

/// The words of a column's name: what it holds, and its unit.
std::pair<std::string, std::string> column_words(const std::string& name) {
    std::string text = spelled(name);
    std::ranges::replace(text, '_', ' ');
    const std::vector<std::string> tokens = tokens_of(text);
    std::string unit;  // "M", "S2" are M/S2
    for (std::size_t i = 1; i < tokens.size(); ++i) unit += (i > 1 ? "/" : "") + tokens[i];
    return {tokens.empty() ? "" : tokens.front(), unit};
}

}  // namespace

std::optional<Unit> unit_of_column(const std::string& name) {
    const auto [what, word] = column_words(name);
    const std::vector<Quantity> named = quantities_in({what});
    const auto unit = unit_of(word);
    return unit && !named.empty() && named.front() == unit->quantity ? unit : std::nullopt;
}

bool is_time_column(const std::string& name) {
    const auto [what, word] = column_words(name);
    return (what == "TIME" || what == "T") && (word.empty() || word == "S");
}

}  // namespace breach::motion
