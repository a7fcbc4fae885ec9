#include "core/motion/units.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <regex>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "core/motion/series.hpp"

namespace breach::motion {

namespace {

using Spelling = std::pair<std::string_view, std::string_view>;

/// Applied in this order to an upper-case header: CM/SEC**2 and CM PER S PER S become CM/S2 and
/// CM/S/S.
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

/// Words of a normalised text, split at blanks, brackets and trailing punctuation.
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

/// "G", "CM/S/S", "M/S2"; a length alone means displacement.
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

/// A unit with a factor: "0.01*G", "G/10", "CM/S/S*1000".
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

/// Ordinary words ("TIME", "SERIES"), which end a unit; "10", "X" or "S" would continue it.
bool is_word(const std::string& token) {
    const auto letters = std::ranges::count_if(
        token, [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; });
    return std::isalpha(static_cast<unsigned char>(token.front())) != 0 && letters > 1;
}

/// Text after UNITS OF, up to the end of its sentence.
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

/// Whether a word names this quantity.
bool names(const std::string& token, Quantity quantity) {
    switch (quantity) {
        case Quantity::acceleration:
            return token.starts_with("ACCEL") || token == "ACC";
        case Quantity::velocity:
            return token.starts_with("VELOC") || token == "VEL";
        case Quantity::displacement:
            return token.starts_with("DISPL") || token == "DISP";
    }
    return false;
}

bool names_any(const std::string& token) {
    return names(token, Quantity::acceleration) || names(token, Quantity::velocity) ||
           names(token, Quantity::displacement);
}

template <std::size_t Count>
bool is_one_of(std::string_view word, const std::string_view (&list)[Count]) {
    return std::ranges::find(list, word) != std::end(list);
}

/// Words that may accompany a unit without changing its size.
bool may_stand_beside(const std::string& token) {
    constexpr std::string_view words[] = {
        "TIME",     "SERIES",    "HISTORY",   "HISTORIES",   "RECORD",   "RECORDED",  "DATA",
        "VALUES",   "UNIT",      "UNITS",     "IN",          "ARE",      "IS",        "AND",
        "WITH",     "AT",        "FOR",       "FROM",        "FILTER",   "FILTERED",  "POINTS",
        "HP",       "LP",        "CORRECTED", "UNCORRECTED", "BASELINE", "COMPONENT", "HORIZONTAL",
        "VERTICAL", "DIRECTION", "DAMPING",   "DEPTH",       "NORTH",    "SOUTH",     "EAST",
        "WEST",     "NS",        "EW",        "UP",          "UD",       "OUTCROP",   "SURFACE"};
    return names_any(token) || is_one_of(token, words);
}

/// "HUNDREDTHS", "SCALED BY 10": words that change the unit's size.
bool scales(const std::vector<std::string>& tokens, std::size_t i) {
    constexpr std::string_view beginnings[] = {"TENTH", "HUNDREDTH", "THOUSANDTH", "MILLI",
                                               "MICRO", "SCAL",      "MULTIPL",    "FACTOR",
                                               "DIVID", "PERCENT",   "PROMILLE"};
    const bool begins = std::ranges::any_of(
        beginnings, [&](std::string_view each) { return tokens[i].starts_with(each); });
    return begins && !(i + 1 < tokens.size() && tokens[i + 1] == "TO");  // SCALED TO 0.3 G
}

bool any_scales(const std::vector<std::string>& tokens) {
    for (std::size_t i = 0; i < tokens.size(); ++i)
        if (scales(tokens, i)) return true;
    return false;
}

/// The unit at the beginning of a phrase; the next word must not continue it.
std::optional<Unit> first_unit(std::vector<std::string> tokens) {
    if (tokens.size() > 1 && begins_number(tokens[0])) {
        tokens[1] = tokens[0] + "*" + tokens[1];
        tokens.erase(tokens.begin());
    }
    if (tokens.empty() || (tokens.size() > 1 && !may_stand_beside(tokens[1]))) return std::nullopt;
    return unit_of(tokens[0]);
}

std::vector<Quantity> quantities_in(const std::vector<std::string>& tokens) {
    std::vector<Quantity> named;
    for (const std::string& each : tokens) {
        for (const Quantity quantity :
             {Quantity::acceleration, Quantity::velocity, Quantity::displacement})
            if (names(each, quantity)) named.push_back(quantity);
    }
    return named;
}

/// Takes out what a header adds about the size of g: "G (1 G = 980.665 CM/S/S)" is G.
std::string without_size_of_g(std::string text) {
    // The numbers of repeats bound the depth of std::regex.
    static const std::regex size(
        R"(\bG ?[(,;]? ?(?:= ?|(?:1|1\.0*)? ?G ?= ?)?([0-9.]{1,12}) ?\*?((?:CM|MM|M|IN|FT)/S[/S2]{1,2}|GAL)\b(?: ?= ?1?\.?0? ?G\b)? ?[)]?)");
    std::smatch match;
    if (!std::regex_search(text, match, size)) return text;
    const auto one = positive(match[1].str());
    const auto unit = plain_unit(match[2].str());
    constexpr double rounding = 0.005;  // 9.81 and 32.2 ft/s2 stand for g
    if (!one || !unit || std::abs(*one * unit->factor / standard_gravity - 1.0) > rounding)
        return text;
    return text.replace(static_cast<std::size_t>(match.position(0)),
                        static_cast<std::size_t>(match.length(0)), "G ");
}

}  // namespace

std::optional<Unit> unit_in_header(const std::string& header) {
    const std::string text = without_size_of_g(spelled(header));
    const std::vector<std::string> tokens = tokens_of(text);
    const std::vector<Quantity> named = quantities_in(tokens);
    const auto fits = [&](const Unit& unit) {
        return named.empty() || std::ranges::find(named, unit.quantity) != named.end();
    };
    if (any_scales(tokens)) return std::nullopt;
    if (const auto phrase = phrase_of_units(text)) {
        const auto unit = first_unit(tokens_of(*phrase));
        return unit && fits(*unit) ? unit : std::nullopt;
    }
    std::optional<Unit> only;
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        const auto unit = unit_of(tokens[i]);
        if (!unit || !fits(*unit)) continue;
        const bool scaled = (i > 0 && !may_stand_beside(tokens[i - 1])) ||
                            (i + 1 < tokens.size() && !may_stand_beside(tokens[i + 1]));
        const bool other =
            only && (only->quantity != unit->quantity || only->factor != unit->factor);
        if (scaled || other) return std::nullopt;
        only = unit;
    }
    return only;
}

namespace {

/// Splits a column's name into quantity and unit.
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

namespace {

/// A word of a comment; for brackets, their content.
struct Word {
    std::string text;
    char bracket = 0;
};

std::vector<Word> words_of_clause(const std::string& clause) {
    std::vector<Word> words;
    std::string plain;
    const auto flush = [&] {
        for (std::string& each : tokens_of(plain)) words.push_back({std::move(each)});
        plain.clear();
    };
    for (std::size_t i = 0; i < clause.size(); ++i) {
        const std::size_t open = std::string_view("([").find(clause[i]);
        const std::size_t end =
            open == std::string_view::npos ? std::string::npos : clause.find(")]"[open], i);
        if (end == std::string::npos) {
            plain += clause[i];
            continue;
        }
        flush();
        words.push_back({clause.substr(i + 1, end - i - 1), clause[i]});
        i = end;
    }
    flush();
    return words;
}

/// Splits at semicolons, and at commas and full stops outside numbers.
std::vector<std::string> clauses_of(const std::string& text) {
    std::vector<std::string> clauses(1);
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char next = i + 1 < text.size() ? text[i + 1] : ' ';
        const bool digit = std::isdigit(static_cast<unsigned char>(next)) != 0;
        const bool parts = text[i] == ';' || text[i] == '|' || (text[i] == ',' && !digit) ||
                           (text[i] == '.' && next == ' ');
        if (parts)
            clauses.emplace_back();
        else
            clauses.back() += text[i];
    }
    return clauses;
}

/// "PGA in g": the unit of a measure, not of the values.
bool is_measure(const std::string& word) {
    constexpr std::string_view measures[] = {"PGA", "PGV",  "PGD",   "PEAK", "MAX", "MAXIMUM",
                                             "MIN", "VS30", "ARIAS", "CAV",  "VS",  "VP"};
    return is_one_of(word, measures);
}

bool is_time(const std::string& word) { return word == "TIME" || word == "T"; }

bool is_direction(const std::string& word) {
    constexpr std::string_view directions[] = {"X",  "Y",  "Z",  "N",  "S",  "E",  "W",  "H", "V",
                                               "NS", "EW", "UD", "H1", "H2", "H3", "UP", "1", "2"};
    return is_one_of(word, directions);
}

/// Words that look like a unit; others after IN or in round brackets are prose.
bool looks_like_unit(const std::string& word) {
    constexpr std::string_view units[] = {"COUNTS", "COUNT", "DIGITS",  "MG",  "UG",    "SI",
                                          "KINE",   "KINES", "VOLT",    "V",   "VOLTS", "MV",
                                          "MS",     "MIN",   "MINUTES", "MSEC"};
    return is_one_of(word, units) || word.find_first_of("/%") != std::string::npos ||
           any_scales({word});
}

/// Unit information in one comment about the file's columns.
class Comment {
  public:
    void read(const std::string& clause) {
        words_ = words_of_clause(clause);
        named_.clear();
        is_about_units_ = after_measure_ = found_here_ = false;
        for (const Word& each : words_) {
            for (const Quantity quantity : quantities_in({first_part(each.text)}))
                named_.push_back(quantity);
            is_about_units_ = is_about_units_ || each.text == "UNITS" || each.text == "UNIT";
        }
        for (std::size_t i = 0; i < words_.size(); ++i) {
            after_measure_ = after_measure_ || is_measure(words_[i].text);
            if (after_measure_) return;
            look_at(i);
        }
        if (is_about_units_ && !found_here_ && !says_seconds() && named_.empty()) refuse(clause);
    }

    Named said;

  private:
    static std::string first_part(const std::string& word) {
        return word.substr(0, word.find('_'));
    }
    const std::string& before(std::size_t i) const {
        static const std::string none;
        return i > 0 ? words_[i - 1].text : none;
    }
    bool says_seconds() const {
        return std::ranges::any_of(
            words_, [](const Word& each) { return each.text == "S" || is_time(each.text); });
    }
    void refuse(const std::string& what) {
        if (said.unknown.empty()) said.unknown = what;
    }

    void look_at(std::size_t i) {
        const auto& [text, bracket] = words_[i];
        if (bracket != 0)
            look_at_bracket(i);
        else if (text.find('_') != std::string::npos)
            look_at_column(text);
        else if (const auto unit = unit_of(text))
            look_at_unit(i, *unit);
        else if ((before(i) == "IN" || names_any(before(i))) && looks_like_unit(text))
            refuse(text);
    }

    void look_at_bracket(std::size_t i) {
        std::string text = words_[i].text;
        if (text.starts_with("IN ")) text.erase(0, 3);
        const std::vector<std::string> tokens = tokens_of(text);
        if (tokens.empty()) return;
        if (is_time(before(i))) {
            if (tokens.size() > 1 || (tokens[0] != "S" && looks_like_time(tokens[0])))
                refuse("TIME IN " + text);
            return;
        }
        const bool of_values = names_any(before(i)) || before(i) == "A" || before(i) == "V";
        const auto unit = any_scales(tokens) ? std::nullopt : first_unit(tokens);
        if (unit && (of_values || unit->quantity == Quantity::acceleration))
            add(*unit, text);
        else if (of_values && !is_direction(text) &&
                 (words_[i].bracket == '[' || std::ranges::any_of(tokens, looks_like_unit)))
            refuse(text);
    }
    static bool looks_like_time(const std::string& word) {
        return word != "SEC" && word.size() < 8;
    }

    void look_at_column(const std::string& text) {
        const std::string what = first_part(text), unit = text.substr(what.size() + 1);
        if (is_time(what)) {
            if (unit != "S") refuse(text);
        } else if (what == "A" || names_any(what)) {
            const auto found = unit_of_column((what == "A" ? "ACC" : what) + "_" + unit);
            if (found)
                add(*found, text);
            else if (!is_direction(unit))
                refuse(text);
        }
    }

    void look_at_unit(std::size_t i, Unit unit) {
        const std::string& text = words_[i].text;
        const bool follows_number = i > 0 && begins_number(before(i));
        if (follows_number) {  // "PGA 0.3 g" is a value, "in 0.01 g" a unit
            const bool scaled = i > 1 && (before(i - 1) == "IN" || is_about_units_);
            const auto whole = scaled ? unit_of(before(i) + "*" + text) : std::nullopt;
            if (whole) add(*whole, text);
            return;
        }
        const std::string next = i + 1 < words_.size() ? words_[i + 1].text : "";
        if (positive(next)) return;  // "g = 9.81", "cm/s2: 294"
        const bool alone = words_.size() <= 2;
        const bool fits = std::ranges::find(named_, unit.quantity) != named_.end();
        if (unit.quantity == Quantity::displacement && !fits) return;  // a distance
        if (unit.quantity == Quantity::velocity && named_.empty() && !is_about_units_ && !alone)
            return;
        if ((text == "G" || text == "GS") && !fits && !is_about_units_ && !alone &&
            before(i) != "IN" && before(i) != "A")
            return;
        std::vector<std::string> tokens;
        for (const Word& each : words_)
            for (std::string& token : tokens_of(each.text)) tokens.push_back(std::move(token));
        if (any_scales(tokens) || (!next.empty() && !is_word(next))) {
            refuse(text + " " + next);
        } else {
            add(unit, text);
        }
    }

    void add(const Unit& unit, const std::string& text) {
        found_here_ = true;
        if (!named_.empty() && std::ranges::find(named_, unit.quantity) == named_.end())
            return refuse(text);
        if (said.unit && !(*said.unit == unit)) return refuse("two units");
        said.unit = unit;
    }

    std::vector<Word> words_;
    std::vector<Quantity> named_;
    bool is_about_units_ = false, after_measure_ = false, found_here_ = false;
};

}  // namespace

Named unit_in_comment(const std::string& comment) {
    Comment read;
    for (const std::string& clause : clauses_of(spelled(comment))) read.read(clause);
    return read.said;
}

bool is_time_column(const std::string& name) {
    const auto [what, word] = column_words(name);
    return (what == "TIME" || what == "T") && (word.empty() || word == "S");
}

}  // namespace breach::motion
