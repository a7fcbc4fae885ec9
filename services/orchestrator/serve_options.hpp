// Options of `breachline serve`, from the command line or a settings file.
#pragma once

#include <CLI/CLI.hpp>

#include "services/orchestrator/serve.hpp"

namespace breach::orchestrator {

class ServeOptions {
  public:
    /// `self`: this executable; shared files are expected beside it.
    explicit ServeOptions(const std::filesystem::path& self);
    ServeOptions(const ServeOptions&) = delete;
    ServeOptions& operator=(const ServeOptions&) = delete;

    /// Adds the subcommand and, to the program, --config FILE with its section [serve].
    CLI::App* add_to(CLI::App& program);
    /// The same error with its line of the settings file and, of an unknown key, the nearest known
    /// one. Nothing: the error is not the file's.
    static std::optional<std::string> explained(const CLI::ParseError& error,
                                                const CLI::App& program, const CLI::App& serving);
    /// Call after parsing. Throws BadInput and IoError.
    ServeSettings settings() const;

  private:
    void add_access_options(CLI::App& serving);
    void add_dispatch(CLI::App& serving);
    void add_files(CLI::App& serving);
    void add_retention(CLI::App& serving);
    void add_slurm(CLI::App& serving);

    ServeSettings settings_;
    std::vector<std::filesystem::path> allowed() const;
    std::filesystem::path token_file_;
    std::vector<std::filesystem::path> allowed_folders_;
    double retry_seconds_ = 0.5;
    std::vector<std::string> limits_;
};

}  // namespace breach::orchestrator
