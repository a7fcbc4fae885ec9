// Reports changes in watched folders (inotify). Only a hint to look: the caller reads the folder
// itself, so that a lost hint costs time only.
#pragma once

#include <filesystem>
#include <vector>

namespace breach::orchestrator {

enum class Notice {
    every_change,     ///< files made, written to, renamed
    published_files,  ///< files renamed into place only
};

class FolderWatch {
  public:
    FolderWatch();
    ~FolderWatch();
    FolderWatch(const FolderWatch&) = delete;
    FolderWatch& operator=(const FolderWatch&) = delete;

    int descriptor() const { return descriptor_; }
    /// Returns the watch's number; -1 when the folder cannot be watched.
    int add(const std::filesystem::path& folder, Notice notice);
    void remove(int watch);
    /// Numbers of the watches that saw a change since the last call; does not block.
    std::vector<int> changes();

  private:
    int descriptor_;
};

}  // namespace breach::orchestrator
