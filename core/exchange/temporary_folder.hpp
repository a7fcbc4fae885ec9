// A new folder that goes with its owner: of a trial run (--measure), of a mesh that is only drawn, of
// a report, of the store that answers for phases run by hand.
#pragma once

#include <filesystem>
#include <string>

namespace breach::exchange {

class TemporaryFolder {
  public:
    /// The name begins with `prefix`. `in`: on the disk to which files are to be moved by renaming.
    /// Throws IoError.
    explicit TemporaryFolder(const std::string& prefix, const std::filesystem::path& in =
                                                            std::filesystem::temp_directory_path());
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

}  // namespace breach::exchange
