// Output streams and format of a command.
#pragma once

#include <ostream>

namespace breach::cli {

enum class Style { people, json, csv };
enum class Screen { terminal, plain, quiet };

/// out: the requested answer only; notes: everything else.
struct Console {
    std::ostream& out;
    std::ostream& notes;
    Style style;
    Screen screen;
};

}  // namespace breach::cli
