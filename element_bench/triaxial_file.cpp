// Checks every line of a laboratory's file while it reads: a wrong unit or sign would otherwise
// become a plausible but wrong parameter. The first faulty line ends a file, as later faults would
// follow from it. Called by norsand_document.cpp for each test.
#include "element_bench/triaxial_file.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

namespace breach::element_bench {

using fault::Fault;
using nlohmann::json;

namespace {

constexpr std::array column_names{"epsilon_1", "q_kPa", "epsilon_v", "u_kPa", "p_kPa", "cell_kPa"};

/// Commas, semicolons or tabs. Decimal commas are not read: they give a row with too many cells,
/// which read_row() refuses.
std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells(1);
    for (const char c : line) {
        if (c == ',' || c == ';' || c == '\t')
            cells.emplace_back();
        else if (c != ' ' && c != '\r' && c != '"')
            cells.back() += c;
    }
    return cells;
}

/// NaN if the text is no number.
/// from_chars() reads points as decimals in every locale, and takes no rest such as "5kPa".
double number_from(const std::string& text) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = error == std::errc() && end == text.data() + text.size();
    return whole ? value : std::numeric_limits<double>::quiet_NaN();
}

/// Reads one file into columns.
class Reader {
  public:
    Reader(std::string file, Boundary boundary, std::string pointer, std::vector<Fault>& faults)
        : file_(std::move(file)),
          drained_(is_drained(boundary)),
          pointer_(std::move(pointer)),
          faults_(faults) {}

    json columns(std::istream& stream);

  private:
    /// Faults point to the document's entry and name the line of the file.
    void fault(std::size_t line, const std::string& what, const std::string& remedy) {
        sound_ = false;
        faults_.push_back(
            {pointer_, file_ + ", line " + std::to_string(line) + ": " + what, remedy});
    }
    void read_names(const std::string& text, std::size_t line);
    void read_row(const std::string& text, std::size_t line);
    void check_row(std::size_t line);
    double last(const char* name) const { return columns_.at(name).back(); }
    bool has(const char* name) const { return columns_.contains(name); }

    std::string file_;
    bool drained_;
    std::string pointer_;
    std::vector<Fault>& faults_;
    bool sound_ = true;
    std::vector<std::string> names_;  ///< in the file's order
    std::map<std::string, std::vector<double>> columns_;
};

/// Columns with other names are skipped. Undrained tests need a pressure: q alone gives no stress
/// path.
void Reader::read_names(const std::string& text, std::size_t line) {
    names_ = cells_of(text);
    for (const std::string& each : names_) {
        if (std::ranges::count(column_names, each) == 0) continue;
        if (columns_.contains(each))
            return fault(line, "column " + each + " occurs twice", "keep one of them");
        columns_[each];
    }
    const std::string volume = drained_ ? "epsilon_v" : "u_kPa (or p_kPa)";
    const std::string remedy = "name the columns in the first line: epsilon_1,q_kPa," +
                               std::string(drained_ ? "epsilon_v" : "u_kPa");
    for (const char* name : {"epsilon_1", "q_kPa"})
        if (!has(name)) fault(line, std::string("no column ") + name, remedy);
    const bool has_volume = drained_ ? has("epsilon_v") : has("u_kPa") || has("p_kPa");
    if (!has_volume) fault(line, "no column " + volume, remedy);
}

void Reader::read_row(const std::string& text, std::size_t line) {
    const std::vector<std::string> cells = cells_of(text);
    if (cells.size() != names_.size()) {
        return fault(line,
                     std::to_string(cells.size()) + " values under " +
                         std::to_string(names_.size()) + " columns",
                     "give one value per column, with decimal points");
    }
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const auto column = columns_.find(names_[i]);
        if (column == columns_.end()) continue;
        const double value = number_from(cells[i]);
        if (!std::isfinite(value)) {
            return fault(line, names_[i] + " is '" + cells[i] + "', not a finite number",
                         "correct or remove this line");
        }
        column->second.push_back(value);
    }
    check_row(line);
}

/// Refuses impossible values in a row.
void Reader::check_row(std::size_t line) {
    constexpr double most_axial = 0.6, most_volume = 0.3;  // strain
    const std::vector<double>& strain = columns_.at("epsilon_1");
    const double epsilon_1 = strain.back();
    if (epsilon_1 > most_axial) {
        return fault(line, "epsilon_1 is " + std::to_string(epsilon_1) + ", per cent?",
                     "give strains as fractions: 0.01 for 1 %");
    }
    // The readings interpolate over strain: an unloading loop would give two stresses at one place.
    if (strain.size() > 1 && epsilon_1 <= strain[strain.size() - 2]) {
        return fault(line, "epsilon_1 does not ascend",
                     "sort the rows; each strain once, without unloading");
    }
    if (strain.size() == 1 && (epsilon_1 < 0.0 || epsilon_1 > 0.005)) {
        return fault(line, "the test begins at epsilon_1 " + std::to_string(epsilon_1),
                     "begin after consolidation, at epsilon_1 = 0");
    }
    if (has("epsilon_v") && drained_) {
        const double volume = last("epsilon_v");
        // Radial strain would be inwards, or dilation larger than in any soil.
        constexpr double noise = 0.01, most_dilation = 2.0;
        const bool steep =
            volume > epsilon_1 + noise || -volume > most_dilation * epsilon_1 + noise;
        if (std::abs(volume) > most_volume || steep) {
            return fault(line,
                         "epsilon_v is " + std::to_string(volume) + " at epsilon_1 " +
                             std::to_string(epsilon_1) + ", per cent?",
                         "give strains as fractions, contraction positive");
        }
    }
    if (has("p_kPa") && !(last("p_kPa") > 0.0 && last("q_kPa") < 3.0 * last("p_kPa"))) {
        return fault(line,
                     "q and p_kPa leave no radial stress: p_kPa " + std::to_string(last("p_kPa")) +
                         ", q_kPa " + std::to_string(last("q_kPa")),
                     "give mean effective stress in kPa, q = sigma_1 - sigma_3");
    }
}

/// Empty after a fault. Remarks (#), blank lines and rows of empty cells are skipped.
json Reader::columns(std::istream& stream) {
    // Fewer rows give no slope at the end and no parabola at a peak.
    constexpr std::size_t least_rows = 20, most_rows = 20000, longest = 4096;
    std::string text;
    std::size_t line = 0;
    while (sound_ && std::getline(stream, text)) {
        ++line;
        if (line == 1 && text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
        if (text.size() > longest || text.find('\0') != std::string::npos) {
            fault(line, "is no text", "give a CSV file");
            break;
        }
        text = text.substr(0, text.find('#'));
        if (text.find_first_not_of(" \t\r,;") == std::string::npos) continue;
        if (names_.empty())
            read_names(text, line);
        else
            read_row(text, line);
        if (sound_ && columns_.at("epsilon_1").size() > most_rows)
            fault(line, "has more than 20000 rows", "thin them out");
    }
    if (!sound_) return json::object();
    const std::size_t rows = names_.empty() ? 0 : columns_.at("epsilon_1").size();
    if (rows < least_rows) {
        fault(std::max<std::size_t>(line, 1),
              "holds " + std::to_string(rows) + " rows, less than 20",
              "give a line of names, then a line per reading");
    } else if (columns_.at("epsilon_1").back() < 0.02) {
        fault(line, "the test ends at epsilon_1 " + std::to_string(last("epsilon_1")),
              "a calibration needs 2 % at least; give strains as fractions");
    }
    return sound_ ? json(columns_) : json::object();
}

}  // namespace

json read_triaxial_file(const std::filesystem::path& file, Boundary boundary,
                        const std::string& pointer, std::vector<Fault>& faults) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream || !std::filesystem::is_regular_file(file)) {
        faults.push_back({pointer, "names " + file.string() + ", which cannot be read",
                          "give a path from the document's folder, or an absolute one"});
        return json::object();
    }
    return Reader(file.string(), boundary, pointer, faults).columns(stream);
}

}  // namespace breach::element_bench
