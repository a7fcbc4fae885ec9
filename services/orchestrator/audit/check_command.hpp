// breachline check: what `audited` finds, told to a person or as JSON.
#pragma once

#include <CLI/CLI.hpp>

#include "core/fault/fault.hpp"

namespace breach::orchestrator {

struct CheckOptions {
    std::filesystem::path data;
    bool repair = false;
    bool sizes = false;
    bool json = false;

    /// Adds the subcommand.
    CLI::App* add_to(CLI::App& program);
};

/// done: all is sound; bad_input: something is not. Throws BadInput, IoError (a service runs and
/// --repair was asked for) and StoreError.
fault::ExitCode check(const CheckOptions& options);

}  // namespace breach::orchestrator
