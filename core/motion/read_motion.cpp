#include "core/motion/read_motion.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <istream>
#include <limits>
#include <optional>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "core/fault/fault.hpp"
#include "core/motion/units.hpp"
#include "core/words/number.hpp"

namespace breach::motion {
namespace {

[[noreturn]] void reject(const std::string& name, std::size_t line, const std::string& cause,
                         const std::string& remedy) {
    throw fault::BadInput(name, {{"line " + std::to_string(line), cause, remedy}});
}

std::string upper(std::string text) {
    for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return text;
}

std::string trimmed(const std::string& text) {
    constexpr const char* blanks = " \t\r";
    const auto first = text.find_first_not_of(blanks);
    if (first == std::string::npos) return "";
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::vector<std::string> words_of(std::string text) {
    std::ranges::replace_if(
        text, [](char c) { return c == ',' || c == '=' || c == ';'; }, ' ');
    std::istringstream in(text);
    std::vector<std::string> words;
    for (std::string word; in >> word;) words.push_back(word);
    return words;
}

/// Values of a file's lines, separated by blanks, tabs, semicolons or commas. A comma is a decimal
/// comma if something else separates the values and the line has no decimal point.
class Values {
  public:
    std::vector<std::string> of(const std::string& line) {
        std::string text = line;
        std::ranges::replace(text, ';', ' ');
        std::istringstream in(text);
        std::vector<std::string> words;
        bool decimal = text.find('.') == std::string::npos;
        for (std::string word; in >> word;) {
            while (!word.empty() && word.back() == ',') word.pop_back();
            decimal = decimal && std::ranges::count(word, ',') <= 1;
            if (!word.empty()) words.push_back(word);
        }
        if (!decimal || (words.size() < 2 && !decimal_commas_)) return words_of(text);
        for (std::string& word : words) {
            decimal_commas_ = decimal_commas_ || word.find(',') != std::string::npos;
            std::ranges::replace(word, ',', '.');
        }
        return words;
    }

  private:
    bool decimal_commas_ = false;  ///< in an earlier line
};

/// Limit of values: squares of larger ones overflow.
constexpr double largest_number = 1e100;

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// Fortran leaves out the E of an exponent with three digits: 7.09-100. Whether `rest`, which begins
/// with a sign, begins with such an exponent of the mantissa before it.
bool is_bare_exponent(std::string_view before, std::string_view rest) {
    const std::size_t end = std::min(rest.find_first_not_of("0123456789", 1), rest.size());
    return end == 4 && (end == rest.size() || rest[end] == '-' || rest[end] == '+') &&
           before.find('.') != std::string_view::npos &&
           before.find_first_of("eEdD") == std::string_view::npos;
}

/// Splits numbers that fill their Fortran fields: "7.09E-20-7.79E-05".
std::vector<std::string> parted_at_signs(const std::string& word) {
    std::vector<std::string> parts(1);
    for (std::size_t i = 0; i < word.size(); ++i) {
        const bool sign = (word[i] == '-' || word[i] == '+') && i > 0 &&
                          (is_digit(word[i - 1]) || word[i - 1] == '.');
        if (sign && !is_bare_exponent(parts.back(), std::string_view(word).substr(i)))
            parts.emplace_back();
        parts.back() += word[i];
    }
    return parts;
}

/// An exponent may begin with E, with Fortran's D, or with its sign only.
std::optional<double> number_from(std::string word) {
    if (!word.empty() && word.front() == '+') word.erase(0, 1);
    std::ranges::replace_if(
        word, [](char c) { return c == 'd' || c == 'D'; }, 'e');
    const std::size_t sign = std::min(word.find_last_of("+-"), word.size());
    if (sign > 0 && sign < word.size() &&
        is_bare_exponent(word.substr(0, sign), std::string_view(word).substr(sign)))
        word.insert(sign, 1, 'e');
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() ||
        !(std::abs(value) <= largest_number)) {
        return std::nullopt;
    }
    return value;
}

double needed_number(const std::string& word, const std::string& name, std::size_t line) {
    const auto value = number_from(word);
    if (!value) reject(name, line, "'" + word + "' is not a finite number", "correct this line");
    return *value;
}

/// Removes the quotes around table entries; other lines stay unchanged.
void without_quotes(std::string& line) {
    const std::string whole = trimmed(line);
    if (whole.size() > 1 && whole.front() == '"') std::erase(line, '"');
}

/// Numbered lines, without UTF-8 byte order mark and quotes.
struct Lines {
    std::istream& in;
    const std::string& name;
    std::size_t number = 0;
    bool next(std::string& line) {
        if (!std::getline(in, line)) return false;
        ++number;
        if (line.find('\0') != std::string::npos)
            reject(name, number, "holds zero bytes: the file is UTF-16 text, or no text",
                   "save it as UTF-8");
        if (number == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
        without_quotes(line);
        line = trimmed(line);
        return true;
    }
};

std::string in_quotes(const std::string& header) {
    constexpr std::size_t longest = 80;
    return '"' + (header.size() > longest ? header.substr(0, longest) + "..." : header) + '"';
}

struct PeerSize {
    std::size_t count;
    double dt;
};

/// Splits ".01SEC" into number and word; other words stay whole.
std::vector<std::string> parted_from_number(const std::string& word) {
    double value = 0.0;
    const auto end = std::from_chars(word.data(), word.data() + word.size(), value).ptr;
    const std::string unit(end, word.data() + word.size());
    const bool parts =
        end != word.data() && std::isalpha(static_cast<unsigned char>(unit.c_str()[0])) != 0;
    return parts ? std::vector{word.substr(0, word.size() - unit.size()), unit} : std::vector{word};
}

/// "NPTS= 8000, DT= .0050 SEC" or "4096 0.0100 NPTS, DT": labels and numbers in their order.
struct SizeLine {
    std::vector<double> numbers;
    std::vector<std::string> labels;
    std::vector<std::string> behind_number;  ///< word after each number, if any
    std::string behind_dt;                   ///< word after the label DT

    explicit SizeLine(std::string line) {
        if (line.find('.') == std::string::npos)
            for (std::size_t i = 0; i + 1 < line.size(); ++i)  // a decimal comma
                if (line[i] == ',' && std::isdigit(static_cast<unsigned char>(line[i + 1])) != 0)
                    line[i] = '.';
        std::ranges::replace_if(
            line, [](char c) { return std::string_view("()[]").find(c) != std::string_view::npos; },
            ' ');
        std::string* behind = nullptr;
        for (const std::string& each : words_of(upper(line)))
            for (const std::string& word : parted_from_number(each)) behind = take(word, behind);
    }
    bool is_one() const { return labels.size() >= 2 && labels[0] != labels[1]; }

  private:
    /// Where to put the word after this one.
    std::string* take(std::string word, std::string* behind) {
        if (const auto value = number_from(word)) {
            numbers.push_back(*value);
            return &behind_number.emplace_back();
        }
        while (word.size() > 1 && word.back() == '.') word.pop_back();
        if (word == "NPTS" || word == "DT") {
            labels.push_back(word);
            return word == "DT" ? &behind_dt : nullptr;
        }
        if (behind != nullptr) *behind = word;
        return nullptr;
    }
};

bool means_seconds(const std::string& unit) {
    return unit.empty() || unit == "S" || unit == "SEC" || unit == "SECS" || unit == "SECOND" ||
           unit == "SECONDS";
}

/// Remedy for a time step.
std::string in_seconds(double dt, const std::string& unit) {
    double seconds = 0.0;
    if (unit == "HZ") seconds = 1.0 / dt;
    if (unit.starts_with("MS") || unit.starts_with("MILLI")) seconds = 1e-3 * dt;
    if (unit == "MIN" || unit.starts_with("MINUTE")) seconds = 60.0 * dt;
    return seconds > 0.0 ? "DT= " + words::text_of(seconds) + " SEC" : "e.g. DT= .0100 SEC";
}

/// A number belongs to the label before it, or, if the line begins with numbers, to the label of
/// the same rank.
PeerSize peer_size(const SizeLine& size, const std::string& name, std::size_t line) {
    const auto& [numbers, labels, behind_number, behind_dt] = size;
    if (numbers.size() < 2 || !size.is_one())
        reject(name, line, "does not give NPTS and DT", "write e.g. NPTS= 4000, DT= .0100 SEC");
    const std::size_t of_dt = labels[0] == "NPTS" ? 1 : 0;
    const double count = numbers[1 - of_dt], dt = numbers[of_dt];
    if (!(dt > 0.0) || count < 2.0 || count > 1e8 || count != std::floor(count))
        reject(name, line, "NPTS must be a whole number above 1 and DT positive",
               "correct the header");
    for (const std::string& unit : {behind_number[of_dt], behind_dt}) {
        if (means_seconds(unit)) continue;
        reject(name, line, "gives DT in " + unit, "write it in seconds: " + in_seconds(dt, unit));
    }
    return {static_cast<std::size_t>(count), dt};
}

/// Samples read so far, with their times.
struct Samples {
    std::vector<double> time, value;
    std::vector<std::size_t> line;
    int decimals = 0;  ///< of the times: the largest number of decimals
};

/// Digits after the decimal point of a number.
int decimals_of(const std::string& word) {
    const std::size_t point = word.find('.'), power = word.find_first_of("eEdD");
    const std::size_t end = std::min(word.size(), power);
    int digits = point < end ? static_cast<int>(end - point) - 1 : 0;
    if (power != std::string::npos)
        digits -= static_cast<int>(
            std::clamp(number_from(word.substr(power + 1)).value_or(0.0), -99.0, 99.0));
    return digits;
}

/// The time step t for which the time of sample i lies within i t + [low, high].
std::optional<double> step_within(const std::vector<double>& times, double low, double high) {
    double least = 0.0, most = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < times.size(); ++i) {
        if (times[i] <= times[i - 1]) return std::nullopt;
        least = std::max(least, (times[i] - high) / static_cast<double>(i));
        most = std::min(most, (times[i] - low) / static_cast<double>(i));
    }
    if (least > most || least <= 0.0) return std::nullopt;
    const double middle = 0.5 * (least + most), whole = 1.0 / std::round(1.0 / middle);
    return whole >= least && whole <= most ? whole : middle;  // prefers 1/128 s to 0.0078124
}

bool are_multiples(const std::vector<double>& times, double step, double near) {
    for (std::size_t i = 1; i < times.size(); ++i)
        if (!(times[i] > times[i - 1]) ||
            !(std::abs(times[i] - step * static_cast<double>(i)) <= near))
            return false;
    return true;
}

/// The common time step; times may be rounded or truncated.
std::optional<double> time_step_of(const Samples& samples) {
    const std::vector<double>& times = samples.time;
    const double mean = times.back() / static_cast<double>(times.size() - 1);
    const double digit = std::pow(10.0, -samples.decimals);
    if (are_multiples(times, mean, 0.01 * mean)) return mean;
    // of a step; with coarser rounding, a missing sample cannot be detected
    constexpr double coarse = 0.3;
    constexpr double ties = 1.001;
    if (0.5 * digit <= coarse * mean)
        if (const auto step = step_within(times, -0.5 * ties * digit, 0.5 * ties * digit))
            return step;
    return digit <= coarse * mean ? step_within(times, -ties * digit, 1e-3 * digit) : std::nullopt;
}

/// Reports the first step that differs from most others.
[[noreturn]] void reject_uneven(const Samples& samples, const std::string& name) {
    const std::vector<double>& times = samples.time;
    std::vector<double> steps(times.size() - 1);
    for (std::size_t i = 0; i < steps.size(); ++i) steps[i] = times[i + 1] - times[i];
    std::vector<double> sorted = steps;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>((sorted.size() - 1) / 2);
    std::ranges::nth_element(sorted, middle);
    const double usual = *middle, digit = std::pow(10.0, -samples.decimals);
    const double near = std::max(0.02 * usual, std::min(1.001 * digit, 0.6 * usual));
    std::size_t odd = 0, oddest = 0;
    while (odd < steps.size() && steps[odd] > 0.0 && std::abs(steps[odd] - usual) <= near) ++odd;
    for (std::size_t i = 1; i < steps.size(); ++i)
        if (std::abs(steps[i] - usual) > std::abs(steps[oddest] - usual)) oddest = i;
    const std::size_t at = odd < steps.size() ? odd : oddest;
    const std::string from = " s to " + words::text_of(times[at + 1]) + " s";
    if (steps[at] <= 0.0)
        reject(name, samples.line[at + 1], "the time goes from " + words::text_of(times[at]) + from,
               "times must ascend: sort the lines, or take out the one that is there twice");
    reject(name, samples.line[at + 1],
           "the times are not equally spaced: from " + words::text_of(times[at]) + from +
               " is a step of " + words::text_of(steps[at]) + " s, and most steps are " +
               words::text_of(usual) + " s",
           "fill in the missing samples, or interpolate the motion to one time step");
}

Series series_from(const Samples& samples, double factor, const std::string& name,
                   std::size_t lines) {
    if (samples.time.size() < 2)
        reject(name, lines, "holds fewer than two samples", "give a whole record");
    if (std::abs(samples.time.front()) > 1e-9)
        reject(name, samples.line.front(), "the first time is not zero", "count time from zero");
    const auto dt = time_step_of(samples);
    if (!dt) reject_uneven(samples, name);
    Series series{*dt, samples.value};
    for (double& value : series.values) value *= factor;
    return series;
}

void add_sample(Samples& samples, const std::vector<std::string>& words, const std::string& name,
                std::size_t line) {
    if (words.size() != 2) {
        const std::string count = std::to_string(words.size());
        reject(name, line, "has " + count + " columns, not two",
               words.size() == 4
                   ? "write decimal points, or part time and value by ; where 0,01 has a decimal "
                     "comma"
                   : "give time and value; a PEER record begins with a header of four lines that "
                     "gives NPTS and DT");
    }
    samples.time.push_back(needed_number(words[0], name, line));
    samples.value.push_back(needed_number(words[1], name, line));
    samples.line.push_back(line);
    samples.decimals = std::max(samples.decimals, decimals_of(words[0]));
}

constexpr std::size_t most_header_lines = 20;

/// Unit in a header "time_s,acceleration_g".
std::optional<Unit> unit_of_columns(const std::string& header) {
    const std::size_t parted = header.find_first_of(",;\t");
    if (parted == std::string::npos || !is_time_column(header.substr(0, parted)))
        return std::nullopt;
    return unit_of_column(header.substr(parted + 1));
}

/// Remedy for an unknown unit.
std::string meant_unit(const std::string& header, const char* otherwise = "G") {
    const std::string text = ' ' + upper(header) + ' ';
    const auto has = [&](std::string_view part) { return text.find(part) != std::string::npos; };
    if (has("% G") || has("%G") || has("PERCENT") || has("HUNDREDTH")) return "0.01*G";
    if (has(" MG ") || has("(MG)") || has("[MG]") || has("_MG ") || has("MILLI") ||
        has("THOUSANDTH"))
        return "0.001*G";
    if (has("TENTH")) return "0.1*G";
    return otherwise;
}

std::string csv_remedy(const std::string& header) {
    const std::string meant = meant_unit(header, "");
    return "write time_s,acceleration_g (or acceleration_m_s2, acceleration_cm_s2, velocity_m_s, "
           "velocity_cm_s)" +
           (meant.empty() ? ""
                          : "; the values times " + meant.substr(0, meant.find('*')) + " are in g");
}

/// Reads the unit in a comment or header; two of them must not differ.
void take_unit(std::optional<Unit>& unit, const std::string& text, const std::string& name,
               std::size_t line) {
    const auto columns = unit_of_columns(trimmed(text));
    const Named named = columns ? Named{columns, ""} : unit_in_comment(text);
    if (!named.unknown.empty())
        reject(name, line, "names no unit that is known: " + in_quotes(trimmed(text)),
               "write e.g. # acceleration in " + meant_unit(text, "m/s2") +
                   ", or take the comment out where the values are in g; units are " +
                   std::string(known_units));
    if (!named.unit) return;
    if (unit && !(*unit == *named.unit))
        reject(name, line, "names another unit than a line before it: " + in_quotes(trimmed(text)),
               "leave the unit of the values only");
    unit = named.unit;
}

/// "time acceleration(m/s2)": the first word does not begin like a number.
bool is_header(const std::string& line) {
    const std::vector<std::string> words = words_of(line);
    return words.size() > 1 && std::isalpha(static_cast<unsigned char>(line.front())) != 0 &&
           std::ranges::none_of(words,
                                [](const auto& word) { return number_from(word).has_value(); });
}

void take_unit_of_header(std::optional<Unit>& unit, const std::string& text,
                         const std::string& name, std::size_t line) {
    take_unit(unit, text, name, line);
    if (!unit)
        reject(name, line, "is a header that names no known unit: " + in_quotes(text),
               csv_remedy(text));
}

/// A publisher's form that is not read, recognised by words in its first lines.
struct OtherForm {
    std::string_view mark, also, form, convert;
};

const OtherForm* other_form(const std::string& line) {
    static constexpr OtherForm others[] = {
        {"SAMPLING FREQ(HZ)", "", "K-NET and KiK-net",
         "multiply the counts by its Scale Factor (in gal) and take off their mean"},
        {"SCALE FACTOR", "(GAL)/", "K-NET and KiK-net",
         "multiply the counts by its Scale Factor (in gal) and take off their mean"},
        {"(FORMAT V", "TEXT LINES", "COSMOS", "take the acceleration, in the unit its block names"},
        {"INTEGER-HEADER VALUES FOLLOW", "", "COSMOS",
         "take the acceleration, in the unit its block names"},
        {"SAMPLING_INTERVAL_S:", "", "ESM (DYNA)",
         "count the time in steps of SAMPLING_INTERVAL_S, and take the values in the unit of "
         "UNITS"},
        {"1 UNCORRECTED ACCEL", "", "SMC (USGS), uncorrected",
         "take the corrected record of the same station; its values, in cm/s2, follow the lines "
         "that begin with |"},
        {"2 CORRECTED ACCEL", "", "SMC (USGS), corrected",
         "take the values, in cm/s2, which follow the lines that begin with |"},
        {"UNCORRECTED ACCEL", "", "V1 (CSMIP, COSMOS), an uncorrected accelerogram",
         "take the corrected record of the same station (V2); its acceleration follows the line "
         "POINTS OF ACCEL DATA, which names count, time step and unit"},
        {"CORRECTED ACCEL", "", "V2 (CSMIP, COSMOS), a corrected accelerogram",
         "take the values that follow the line POINTS OF ACCEL DATA, which names count, time step "
         "and unit, up to the velocity"},
        {"POINTS OF ACCEL", "", "V2 (CSMIP, COSMOS), a corrected accelerogram",
         "take the values that follow this line, which names count, time step and unit, up to the "
         "velocity"},
    };
    std::string text;
    for (const char c : upper(line))
        if (c != ' ' || !text.ends_with(' ')) text += c;
    const auto found = std::ranges::find_if(others, [&](const OtherForm& each) {
        return text.find(each.mark) != std::string::npos &&
               text.find(each.also) != std::string::npos;
    });
    return found != std::end(others) ? &*found : nullptr;
}

enum class Form { peer, csv, two_columns };

/// Format by the first lines or, if they are unclear, by the file's extension. Refuses other forms,
/// unless their words are in the title of a form that is read.
Form form_of(std::istream& in, const std::string& name, const std::string& ending) {
    Lines lines{in, name};
    std::string line;
    bool is_csv = false;
    const OtherForm* other = nullptr;
    std::size_t line_of_other = 0;
    while (lines.number < most_header_lines && lines.next(line)) {
        if (line.starts_with('#')) continue;
        if (SizeLine(line).is_one()) return Form::peer;
        is_csv = is_csv || unit_of_columns(line);
        if (other != nullptr) continue;
        other = other_form(line);
        line_of_other = lines.number;
    }
    if (is_csv) return Form::csv;
    if (other != nullptr)
        reject(name, line_of_other,
               "is of a file in the form of " + std::string(other->form) + ", which is not read",
               "convert it to a CSV file with the header time_s,acceleration_cm_s2 (or "
               "acceleration_g): " +
                   std::string(other->convert));
    if (ending == ".CSV") return Form::csv;
    return ending == ".AT2" || ending == ".VT2" || ending == ".DT2" ? Form::peer
                                                                    : Form::two_columns;
}

}  // namespace

Recording read_peer(std::istream& in, const std::string& name) {
    Lines lines{in, name};
    std::string line, before;
    Recording recording;
    std::optional<SizeLine> size;
    while (!size || !size->is_one()) {
        before = line;
        if (lines.number == most_header_lines || !lines.next(line))
            reject(name, lines.number, "the header has no line that gives NPTS and DT",
                   "give an AT2 file as PEER writes it (NPTS= 4000, DT= .0100 SEC on its fourth "
                   "line), or two columns of time and acceleration in g as a .txt file");
        if (lines.number == 2) recording.title = line;
        size.emplace(line);
    }
    const auto unit = unit_in_header(before);
    if (!unit)
        reject(name, lines.number - 1, "names no known unit: " + in_quotes(before),
               "write ACCELERATION TIME SERIES IN UNITS OF " + meant_unit(before) + "; units are " +
                   std::string(known_units));
    const auto [count, dt] = peer_size(*size, name, lines.number);
    recording.quantity = unit->quantity;
    recording.series.dt = dt;
    for (Values values; lines.next(line);)
        for (const std::string& word : values.of(line))
            for (const std::string& number : parted_at_signs(word))
                recording.series.values.push_back(unit->factor *
                                                  needed_number(number, name, lines.number));
    if (recording.series.values.size() > count)
        reject(name, lines.number,
               "the file holds " + std::to_string(recording.series.values.size()) +
                   " values, and its header gives NPTS= " + std::to_string(count),
               "correct NPTS, or remove what does not belong to this record");
    if (recording.series.values.size() < count)
        reject(name, lines.number,
               "the file ends after " + std::to_string(recording.series.values.size()) + " of " +
                   std::to_string(count) + " values",
               "the file is cut or its header wrong: get it again");
    return recording;
}

Recording read_two_columns(std::istream& in, const std::string& name) {
    Lines lines{in, name};
    Samples samples;
    Values values;
    std::optional<Unit> unit;
    bool may_be_header = true;
    for (std::string line; lines.next(line);) {
        if (line.empty()) continue;
        if (line.front() == '#') {
            take_unit(unit, line.substr(1), name, lines.number);
            continue;
        }
        if (may_be_header && is_header(line))
            take_unit_of_header(unit, line, name, lines.number);
        else
            add_sample(samples, values.of(line), name, lines.number);
        may_be_header = false;
    }
    const Unit of_values = unit.value_or(Unit{Quantity::acceleration, standard_gravity});
    return {of_values.quantity, series_from(samples, of_values.factor, name, lines.number), name};
}

Recording read_csv(std::istream& in, const std::string& name) {
    Lines lines{in, name};
    Samples samples;
    Values values;
    std::optional<Unit> unit;
    for (std::string line; lines.next(line);) {
        if (line.empty() || line.front() == '#') continue;
        if (unit) {
            add_sample(samples, values.of(line), name, lines.number);
            continue;
        }
        unit = unit_of_columns(line);
        if (!unit)
            reject(name, lines.number, "is no known header: " + in_quotes(line), csv_remedy(line));
    }
    if (!unit) reject(name, lines.number, "holds no header", "write time_s,acceleration_g first");
    return {unit->quantity, series_from(samples, unit->factor, name, lines.number), name};
}

Recording read_motion(const std::filesystem::path& file) {
    std::ifstream in;
    std::error_code error;  // excludes devices and pipes
    if (std::filesystem::is_regular_file(file, error)) in.open(file);
    if (!in.is_open()) throw fault::IoError("cannot open the motion " + file.string());
    const std::string name = file.string();
    const Form form = form_of(in, name, upper(file.extension().string()));
    in.clear();
    in.seekg(0);
    return form == Form::peer  ? read_peer(in, name)
           : form == Form::csv ? read_csv(in, name)
                               : read_two_columns(in, name);
}

void write_csv(std::ostream& out, const Recording& motion, const std::string& remarks) {
    if (motion.quantity == Quantity::displacement) {
        throw std::invalid_argument("a displacement has no CSV form");
    }
    const bool accelerates = motion.quantity == Quantity::acceleration;
    const double unit = accelerates ? standard_gravity : 1.0;
    std::istringstream each(remarks);
    for (std::string line; std::getline(each, line);) out << "# " << line << '\n';
    out << (accelerates ? "time_s,acceleration_g\n" : "time_s,velocity_m_s\n");
    const Series& series = motion.series;
    for (std::size_t i = 0; i < series.values.size(); ++i) {
        char row[64];
        std::snprintf(row, sizeof row, "%.10g,%.8f\n", series.dt * static_cast<double>(i),
                      series.values[i] / unit);
        out << row;
    }
}

}  // namespace breach::motion
