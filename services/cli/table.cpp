// Text for the terminal. Everything that came from a server passes through harmless(), as a run's
// title or a log line could contain control sequences.
#include "services/cli/table.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace breach::cli {

using nlohmann::json;

namespace {

constexpr int bar_width = 20;

/// Widths count characters, not bytes: units and names are UTF-8.
bool begins_character(char byte) { return (static_cast<unsigned char>(byte) & 0xC0) != 0x80; }

std::size_t width_of(std::string_view text) {
    return static_cast<std::size_t>(std::ranges::count_if(text, begins_character));
}

/// No blanks at the end: a last column of remarks is often empty, and diffs would show them.
std::string line_of(const std::vector<Column>& columns, const std::vector<std::size_t>& widths,
                    const Cells& cells) {
    std::string line;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        const std::string space(widths[i] - width_of(cells[i]), ' ');
        if (i > 0) line += "  ";
        line += columns[i].align == Align::left ? cells[i] + space : space + cells[i];
    }
    line.erase(line.find_last_not_of(' ') + 1);
    return line + '\n';
}

}  // namespace

std::string as_table(const std::vector<Column>& columns, const std::vector<Cells>& rows) {
    std::vector<std::size_t> widths;
    Cells titles;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        titles.push_back(columns[i].title);
        widths.push_back(width_of(columns[i].title));
        for (const Cells& row : rows) {
            assert(row.size() == columns.size());
            widths[i] = std::max(widths[i], width_of(row[i]));
        }
    }
    std::string text = line_of(columns, widths, titles);
    for (const Cells& row : rows) text += line_of(columns, widths, row);
    return text;
}

namespace {

std::string printed(const char* format, double number) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), format, number);
    return text.data();
}

}  // namespace

/// Whole units from 10,000 on, as readers compare lengths and counts. Texts of a log need not be
/// UTF-8: what cannot be printed is replaced.
std::string cell(const json& value) {
    if (value.is_null()) return "-";
    if (value.is_string()) return harmless(value.get_ref<const std::string&>());
    if (value.is_number_float()) {
        const double number = value.get<double>();
        const bool is_long = std::abs(number) >= 1e4 && std::abs(number) < 1e9;  // not 1.235e+04
        return printed(is_long ? "%.0f" : "%.4g", number);
    }
    return harmless(value.dump(-1, ' ', false, json::error_handler_t::replace));
}

std::string cell(const json& object, const char* key) {
    const auto found = object.find(key);
    return found == object.end() ? "-" : cell(*found);
}

std::string whole_cell(const json& object, const char* key) {
    const auto found = object.find(key);
    if (found == object.end() || !found->is_number_float()) return cell(object, key);
    return printed("%.9g", found->get<double>());
}

void show_json(const json& answer, const Console& console) {
    console.out << answer.dump(2, ' ', false, json::error_handler_t::replace) << "\n";
}

bool shown_as_json(const json& answer, const Console& console) {
    if (console.style == Style::json) show_json(answer, console);
    return console.style == Style::json;
}

std::string harmless(std::string_view text) {
    std::string safe(text);
    for (char& each : safe) {
        const auto byte = static_cast<unsigned char>(each);
        if (byte < 0x20 || byte == 0x7F) each = ' ';
    }
    return safe;
}

/// Rounded down, so that 100 % means the end. The comparison is written for NaN, which becomes 0.
std::string bar(double fraction) {
    if (!(fraction > 0.0)) fraction = 0.0;
    fraction = std::min(fraction, 1.0);
    const int filled = static_cast<int>(fraction * bar_width);
    char percent[16];
    std::snprintf(percent, sizeof percent, "] %3.0f %%", std::floor(100.0 * fraction));
    std::string text = "[";
    text.append(filled, '#').append(bar_width - filled, '.').append(percent);
    return text;
}

std::string shortened(const std::string& text, std::size_t width) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (begins_character(text[i]) && count++ == width) return text.substr(0, i);
    }
    return text;
}

}  // namespace breach::cli
