// An exclusive lock that the kernel drops when the last process holding the file open is gone:
// proof of life that neither reused pids nor a moved clock can fake. Children that inherit the
// descriptor hold it too.
#pragma once

#include <filesystem>
#include <optional>

namespace breach::orchestrator {

class FileLock {
  public:
    /// Nothing when another process holds it. Throws IoError when the file cannot be created.
    static std::optional<FileLock> try_take(const std::filesystem::path& file);

    FileLock(FileLock&& other) noexcept;
    FileLock& operator=(FileLock&& other) noexcept;
    ~FileLock();

    int descriptor() const { return descriptor_; }

  private:
    explicit FileLock(int descriptor) : descriptor_(descriptor) {}
    int descriptor_;
};

/// Whether a process holds it now. Does not take the lock. A missing file is not
/// held.
bool is_held(const std::filesystem::path& file);

}  // namespace breach::orchestrator
