// A file during its upload. If it was announced by its content, an interrupted upload keeps the bytes so far and
// can be resumed; others are deleted with their request.
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
    /// folder: where such files are kept, for a day after their last byte. Nothing: it is being uploaded right now.
    static std::optional<ArrivingFile> resumable(const std::filesystem::path& folder,
                                                 const std::string& name);
    ArrivingFile(ArrivingFile&&) = default;
    ~ArrivingFile();

    const std::filesystem::path& path() const { return path_; }
    std::int64_t bytes() const;
    void begin_anew();
    /// Throws IoError.
    void append(const char* data, std::size_t size);
    /// Without this the file is deleted: its bytes are useless without the rest.
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

/// Bytes so far of the file with this beginning of its name.
std::int64_t arrived_bytes(const std::filesystem::path& folder, const std::string& sha256);

}  // namespace breach::orchestrator
