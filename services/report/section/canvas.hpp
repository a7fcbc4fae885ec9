// A panel with its drawing, and its legend. Private to the section's drawing.
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "services/report/section/sheet.hpp"

namespace breach::report {

/// A line of the legend: a picture 24 px wide and 12 high, and what it means.
struct Key {
    std::string symbol;
    std::string text;
};

/// A panel with its drawing.
struct Canvas {
    Panel panel;
    Labels labels;
    std::vector<Key> keys = {};
    std::ostringstream svg = {};   ///< clipped at the panel
    std::ostringstream over = {};  ///< marks and text above it
};

}  // namespace breach::report
