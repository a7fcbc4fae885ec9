// Tables and numbers as text in aligned columns.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "services/cli/console.hpp"

namespace breach::cli {

enum class Align { left, right };
using enum Align;

struct Column {
    std::string title;
    Align align = left;
};

using Cells = std::vector<std::string>;

/// Pads columns to their widest cell, with two blanks between them and none at line ends. Every row
/// has one cell per column.
std::string as_table(const std::vector<Column>& columns, const std::vector<Cells>& rows);

/// Four significant digits, or whole units from 10,000 on; "-" for null; harmless text.
std::string cell(const nlohmann::json& value);
/// The cell of a member; "-" when it is missing.
std::string cell(const nlohmann::json& object, const char* key);
/// The same for a number that identifies a row (transfer time): all digits.
std::string whole_cell(const nlohmann::json& object, const char* key);

/// Prints the server's answer unchanged.
void show_json(const nlohmann::json& answer, const Console& console);
/// The same with --json only. False: the caller prints the answer for people, or as CSV.
bool shown_as_json(const nlohmann::json& answer, const Console& console);

/// Removes control characters, so that a text from the server cannot move the cursor.
std::string harmless(std::string_view text);

/// "[#####...............]  25 %"; fraction in [0, 1], other values are clamped.
std::string bar(double fraction);

/// The first `width` characters; never splits a UTF-8 sequence.
std::string shortened(const std::string& text, std::size_t width);

}  // namespace breach::cli
