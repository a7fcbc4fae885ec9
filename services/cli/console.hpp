// Where and how a command shows what it was asked for.
#pragma once

#include <ostream>

namespace breach::cli {

enum class Style { people, json, csv };
enum class Screen { terminal, plain, quiet };

/// Where the answer goes (out: only what was asked for) and what is said on the side (notes).
struct Console {
    std::ostream& out;
    std::ostream& notes;
    Style style;
    Screen screen;
};

}  // namespace breach::cli
