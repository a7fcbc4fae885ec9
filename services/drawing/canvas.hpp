// A panel with its drawing, and its legend. Private to the section's drawing: each feature draws
// its marks and adds their keys in one go, so that neither is there without the other.
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "services/drawing/sheet.hpp"

namespace breach::drawing {

/// An entry of the legend: a symbol of 24 x 12 px, and its meaning.
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

}  // namespace breach::drawing
