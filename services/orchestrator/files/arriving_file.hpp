// A file that is being sent. One that was announced by its content keeps what has come of it when the rest does not
// follow, and goes on from there; others are gone with their request.
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
    /// folder: where such files are kept, for a day after their last byte. Nothing: this one is being sent right now.
    static std::optional<ArrivingFile> resumable(const std::filesystem::path& folder,
                                                 const std::string& name);
    ArrivingFile(ArrivingFile&&) = default;
    ~ArrivingFile();

    const std::filesystem::path& path() const { return path_; }
    std::int64_t bytes() const;
    void begin_anew();
    /// Throws IoError.
    void append(const char* data, std::size_t size);
    /// What has come is worth nothing without the rest.
    void keep_until_resumed() { kept_ = true; }
    /// To the disk. Throws IoError.
    void sync();

  private:
    ArrivingFile(std::filesystem::path path, FileLock lock)
        : path_(std::move(path)), lock_(std::move(lock)) {}
    std::filesystem::path path_;
    FileLock lock_;
    bool kept_ = false;
};

/// How much has come of the file whose name begins so [bytes].
std::int64_t arrived_bytes(const std::filesystem::path& folder, const std::string& sha256);

}  // namespace breach::orchestrator
