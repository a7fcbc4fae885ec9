// `verify`: compares the programs with closed forms, published tables and independent programs.
#pragma once

#include <filesystem>

#include "services/cli/commands.hpp"

namespace breach::cli {

struct VerifyOptions {
    std::filesystem::path output = "verification";
    std::filesystem::path catalogue;  ///< empty: the one that is shipped
    bool quick = false;
};

/// Does not return; the program ends with breakdown where a comparison fails.
fault::ExitCode verify(const VerifyOptions& options, const Console& console);

}  // namespace breach::cli
