// The frames of one run as ParaView opens them at once, with their times: a small JSON file beside
// them (its "file series", version 1.0).
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace breach::process {

class Series {
  public:
    /// Empty: frames that an earlier run left in the folder do not belong to this one.
    explicit Series(std::filesystem::path folder) : folder_(std::move(folder)) {}

    /// For a resumed run: with those of its frames that are from before `time` [s].
    static Series going_on(std::filesystem::path folder, const std::string& prefix, double time);

    /// Publishes phases::files::series with this frame at the end; one of the same name is replaced.
    /// Throws IoError.
    void add(const std::string& name, double time);

  private:
    std::filesystem::path folder_;
    std::vector<std::pair<double, std::string>> frames_;  ///< time [s], file name; ascending
};

}  // namespace breach::process
