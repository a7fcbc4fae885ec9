#include "core/motion/read_motion.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <istream>
#include <optional>
#include <ostream>
#include <sstream>
#include <stdexcept>

#include "core/fault/fault.hpp"

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

/// Beyond it squares are no numbers any more, and nothing moves so.
constexpr double largest_number = 1e100;

std::optional<double> number_from(std::string word) {
    if (!word.empty() && word.front() == '+') word.erase(0, 1);
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
    if (!value) reject(name, line, "'" + word + "' is not a finite number", "mend this line");
    return *value;
}

/// Lines with their numbers.
struct Lines {
    std::istream& in;
    std::size_t number = 0;
    bool next(std::string& line) {
        if (!std::getline(in, line)) return false;
        ++number;
        line = trimmed(line);
        return true;
    }
};

struct Unit {
    Quantity quantity;
    double factor;  ///< to SI
};

std::optional<Unit> peer_unit(const std::string& header) {
    const std::string text = upper(header);
    const auto has = [&](const char* part) { return text.find(part) != std::string::npos; };
    if (has("ACCELERATION") && has("UNITS OF G")) {
        return Unit{Quantity::acceleration, standard_gravity};
    }
    if (has("VELOCITY") && has("CM/S")) return Unit{Quantity::velocity, 0.01};
    if (has("DISPLACEMENT") && has("CM")) return Unit{Quantity::displacement, 0.01};
    return std::nullopt;
}

std::optional<Unit> column_unit(const std::string& header) {
    if (header == "acceleration_g") return Unit{Quantity::acceleration, standard_gravity};
    if (header == "acceleration_m_s2") return Unit{Quantity::acceleration, 1.0};
    if (header == "velocity_m_s") return Unit{Quantity::velocity, 1.0};
    if (header == "velocity_cm_s") return Unit{Quantity::velocity, 0.01};
    return std::nullopt;
}

struct PeerSize {
    std::size_t count;
    double dt;
};

/// "NPTS= 8000, DT= .0050 SEC" or "4096 0.0100 NPTS, DT": a number belongs to the label before it,
/// or, when the line begins with numbers, to the label of the same rank.
PeerSize peer_size(const std::string& header, const std::string& name, std::size_t line) {
    std::vector<double> numbers;
    std::vector<std::string> labels;
    for (const std::string& word : words_of(upper(header))) {
        if (const auto value = number_from(word)) {
            numbers.push_back(*value);
        } else if (word == "NPTS" || word == "DT") {
            labels.push_back(word);
        }
    }
    if (numbers.size() < 2 || labels.size() < 2 || labels[0] == labels[1]) {
        reject(name, line, "does not give NPTS and DT", "write e.g. NPTS= 4000, DT= .0100 SEC");
    }
    const double count = labels[0] == "NPTS" ? numbers[0] : numbers[1];
    const double dt = labels[0] == "NPTS" ? numbers[1] : numbers[0];
    if (!(dt > 0.0) || count < 2.0 || count > 1e8 || count != std::floor(count)) {
        reject(name, line, "NPTS must be a whole number above 1 and DT positive",
               "mend the header");
    }
    return {static_cast<std::size_t>(count), dt};
}

/// Samples with their times, as far as they are read.
struct Samples {
    std::vector<double> time, value;
    std::vector<std::size_t> line;
};

Series series_from(const Samples& samples, double factor, const std::string& name,
                   std::size_t lines) {
    const std::size_t count = samples.time.size();
    if (count < 2) reject(name, lines, "holds fewer than two samples", "give a whole record");
    if (std::abs(samples.time.front()) > 1e-9) {
        reject(name, samples.line.front(), "the first time is not zero", "count time from zero");
    }
    const double dt = samples.time.back() / static_cast<double>(count - 1);
    for (std::size_t i = 1; i < count; ++i) {
        const double step = samples.time[i] - samples.time[i - 1];
        // Times are often written with few digits: a hundredth of a step is still the same step.
        if (step > 0.0 && std::abs(samples.time[i] - dt * static_cast<double>(i)) <= 0.01 * dt) {
            continue;
        }
        reject(name, samples.line[i], "the times are not equally spaced",
               "resample the motion to one time step");
    }
    Series series{dt, samples.value};
    for (double& value : series.values) value *= factor;
    return series;
}

void add_sample(Samples& samples, const std::vector<std::string>& words, const std::string& name,
                std::size_t line) {
    if (words.size() != 2) {
        reject(name, line, "has " + std::to_string(words.size()) + " columns, not two",
               "give time and value");
    }
    samples.time.push_back(needed_number(words[0], name, line));
    samples.value.push_back(needed_number(words[1], name, line));
    samples.line.push_back(line);
}

}  // namespace

Recording read_peer(std::istream& in, const std::string& name) {
    Lines lines{in};
    std::string line;
    Recording recording;
    std::optional<Unit> unit;
    std::optional<PeerSize> size;
    while (!size) {
        if (!lines.next(line)) {
            reject(name, lines.number, "the header of four lines is incomplete",
                   "give an AT2 file as PEER writes it");
        }
        if (lines.number == 2) recording.title = line;
        if (lines.number == 3) {
            unit = peer_unit(line);
            if (!unit) {
                reject(name, 3, "names no known unit", "write ACCELERATION ... IN UNITS OF G");
            }
        }
        if (lines.number == 4) size = peer_size(line, name, 4);
    }
    recording.quantity = unit->quantity;
    recording.series.dt = size->dt;
    while (lines.next(line)) {
        for (const std::string& word : words_of(line)) {
            const double value = needed_number(word, name, lines.number);
            recording.series.values.push_back(unit->factor * value);
        }
    }
    if (recording.series.values.size() != size->count) {
        reject(name, lines.number,
               "the file ends after " + std::to_string(recording.series.values.size()) + " of " +
                   std::to_string(size->count) + " values",
               "the file is cut or its header wrong: get it again");
    }
    return recording;
}

Recording read_two_columns(std::istream& in, const std::string& name) {
    Lines lines{in};
    Samples samples;
    for (std::string line; lines.next(line);) {
        if (line.empty() || line.front() == '#') continue;
        add_sample(samples, words_of(line), name, lines.number);
    }
    return {Quantity::acceleration, series_from(samples, standard_gravity, name, lines.number),
            name};
}

Recording read_csv(std::istream& in, const std::string& name) {
    Lines lines{in};
    Samples samples;
    std::optional<Unit> unit;
    for (std::string line; lines.next(line);) {
        if (line.empty() || line.front() == '#') continue;
        const auto words = words_of(line);
        if (unit) {
            add_sample(samples, words, name, lines.number);
            continue;
        }
        if (words.size() == 2 && words[0] == "time_s") unit = column_unit(words[1]);
        if (!unit) {
            reject(name, lines.number, "is no known header",
                   "write time_s,acceleration_g (or acceleration_m_s2, velocity_m_s, "
                   "velocity_cm_s)");
        }
    }
    if (!unit) reject(name, lines.number, "holds no header", "write time_s,acceleration_g first");
    return {unit->quantity, series_from(samples, unit->factor, name, lines.number), name};
}

Recording read_motion(const std::filesystem::path& file) {
    std::ifstream in;
    std::error_code error;  // a device or a pipe never ends
    if (std::filesystem::is_regular_file(file, error)) in.open(file);
    if (!in.is_open()) throw fault::IoError("cannot open the motion " + file.string());
    const std::string ending = upper(file.extension().string()), name = file.string();
    if (ending == ".AT2" || ending == ".VT2" || ending == ".DT2") return read_peer(in, name);
    if (ending == ".CSV") return read_csv(in, name);
    return read_two_columns(in, name);
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
