// breachline check: prints the inconsistencies of `audited` as text or as JSON.
#pragma once

#include <CLI/CLI.hpp>

#include "core/fault/fault.hpp"

namespace breach::orchestrator {

struct CheckOptions {
    std::filesystem::path data;
    bool repair = false;
    bool sizes = false;
    bool json = false;

    CLI::App* add_to(CLI::App& program);
};

/// done: no inconsistencies; bad_input: some, also those that --repair left. Throws BadInput,
/// IoError (a service runs and --repair was given) and StoreError.
fault::ExitCode check(const CheckOptions& options);

}  // namespace breach::orchestrator
