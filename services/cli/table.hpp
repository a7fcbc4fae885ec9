// Tables and numbers as text in aligned columns.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "services/cli/console.hpp"

namespace breach::cli {

enum class Align { left, right };

struct Column {
    std::string title;
    Align align;
};

using Cells = std::vector<std::string>;

/// Columns as wide as their widest cell, two blanks between them, no blanks at line ends.
/// Every row has as many cells as there are columns.
std::string as_table(const std::vector<Column>& columns, const std::vector<Cells>& rows);

/// Numbers with four significant digits or, from 10,000 on, to the unit; "-" for null, text without control characters.
std::string cell(const nlohmann::json& value);
/// The member's cell; "-" when there is none.
std::string cell(const nlohmann::json& object, const char* key);
/// The same for a number that names a row, as a transfer time: different ones never look alike.
std::string whole_cell(const nlohmann::json& object, const char* key);

/// Prints the server's answer unchanged.
void show_json(const nlohmann::json& answer, const Console& console);

/// Removes control characters, so that a text from the server cannot move the cursor.
std::string harmless(std::string_view text);

/// "[#####...............]  25 %"; fraction in [0, 1], other values are clamped.
std::string bar(double fraction);

/// The first `width` characters (UTF-8 is not cut in the middle).
std::string shortened(const std::string& text, std::size_t width);

}  // namespace breach::cli
