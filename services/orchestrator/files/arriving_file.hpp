// A file during its upload. If its sender announced the SHA-256, the received bytes survive an
// interruption and the upload can be resumed. Other files are deleted with their request.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "services/orchestrator/files/file_lock.hpp"

namespace breach::orchestrator {

class ArrivingFile {
  public:
    /// path: of a file that is not there yet.
    static ArrivingFile of_one_request(std::filesystem::path path);
    /// folder: keeps such files for a day after their last byte. Nothing: the file is being
    /// uploaded right now.
    static std::optional<ArrivingFile> resumable(const std::filesystem::path& folder,
                                                 const std::string& name);
    ArrivingFile(ArrivingFile&&) = default;
    ~ArrivingFile();

    const std::filesystem::path& path() const { return path_; }
    std::int64_t bytes() const;
    void begin_anew();
    /// Throws IoError.
    void append(const char* data, std::size_t size);
    /// Without this call the destructor deletes the file.
    void keep_until_resumed() { kept_ = true; }
    /// Flushes to the disk. Throws IoError.
    void sync();

  private:
    ArrivingFile(std::filesystem::path path, FileLock lock)
        : path_(std::move(path)), lock_(std::move(lock)) {}
    std::filesystem::path path_;
    FileLock lock_;
    bool kept_ = false;
};

/// Bytes received so far of the file with this SHA-256.
std::int64_t arrived_bytes(const std::filesystem::path& folder, const std::string& sha256);

}  // namespace breach::orchestrator
