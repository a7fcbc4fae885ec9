// Reads tables of numbers with a header line.
#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace breach::testing {

/// A table by columns.
struct Table {
    std::map<std::string, std::vector<double>> columns;
    std::size_t rows = 0;
};

inline Table read_table(const std::filesystem::path& file) {
    std::ifstream stream(file);
    std::string line, cell;
    std::getline(stream, line);
    std::vector<std::string> names;
    for (std::istringstream header(line); std::getline(header, cell, ',');) names.push_back(cell);
    Table table;
    while (std::getline(stream, line)) {
        std::size_t k = 0;
        for (std::istringstream row(line); std::getline(row, cell, ',');) {
            table.columns[names[k++]].push_back(std::stod(cell));
        }
        ++table.rows;
    }
    return table;
}

}  // namespace breach::testing
