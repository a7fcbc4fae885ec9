// Disk use of the data folder by run. Runs that share results share the files (hard links), so the
// links decide how many bytes the removal of a run frees.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace breach::orchestrator {

/// [bytes allocated on the disk]
struct RunUse {
    std::int64_t own = 0;                       ///< freed when the run is removed
    std::int64_t shared = 0;                    ///< also held by others
    std::vector<std::string> shared_with = {};  ///< some of the runs that hold them, newest first
};

/// What removing this run's folder would free [bytes].
std::int64_t freed_without(const std::filesystem::path& run);

class DiskUse {
  public:
    /// Looks at every file below `runs` and `files`. Files that vanish meanwhile count as removed.
    DiskUse(const std::filesystem::path& runs, const std::filesystem::path& files);

    /// By run; includes folders that the store does not know.
    std::map<std::string, RunUse> by_run() const;
    std::int64_t bytes_of_runs() const { return bytes_of_runs_; }
    std::int64_t bytes_of_files() const { return bytes_of_files_; }
    /// Excludes the run from now on; returns the bytes it frees.
    std::int64_t leave_out(const std::string& run);

  private:
    /// One file on the disk, with any number of names.
    struct Content {
        std::int64_t bytes;
        std::uint64_t names;  ///< anywhere on the disk
        std::map<std::string, std::uint64_t> in_runs;
    };
    bool is_held_elsewhere(const Content& content, const std::string& run) const;

    using Key = std::pair<std::uint64_t, std::uint64_t>;  ///< device, inode
    std::map<Key, Content> contents_;
    std::map<std::string, std::vector<Key>> of_run_;
    std::int64_t bytes_of_runs_ = 0;
    std::int64_t bytes_of_files_ = 0;
};

}  // namespace breach::orchestrator
