// Output streams and format of a command.
#pragma once

#include <ostream>

namespace breach::cli {

/// json is the program's --json, csv a flag of some commands; with both given, --json wins.
enum class Style { people, json, csv };
/// terminal: the cursor may be moved; plain: a file or a pipe, which gets whole lines; quiet: the
/// answer alone.
enum class Screen { terminal, plain, quiet };

/// out: the requested answer only; notes: everything else.
struct Console {
    // stdout and stderr: a redirected table holds no remarks.
    std::ostream& out;
    std::ostream& notes;
    Style style;
    Screen screen;
};

}  // namespace breach::cli
