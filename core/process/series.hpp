// List of a run's frames with their times, which ParaView opens as one: a small JSON file beside
// them ("file series", version 1.0).
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace breach::process {

class Series {
  public:
    /// Starts empty: frames of an earlier run in the folder are not included.
    explicit Series(std::filesystem::path folder) : folder_(std::move(folder)) {}

    /// For a resumed run: includes its frames before `time` [s], that of the frame which is about
    /// to be added. Frames of the killed attempt after it stay on the disk, but out of the list.
    static Series going_on(std::filesystem::path folder, const std::string& prefix, double time);

    /// Adds a frame, or replaces that of the same name, and publishes phases::files::series. Throws
    /// IoError.
    void add(const std::string& name, double time);

  private:
    std::filesystem::path folder_;
    std::vector<std::pair<double, std::string>> frames_;  ///< time [s], file name; ascending
};

}  // namespace breach::process
