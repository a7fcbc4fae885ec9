// Frames in the order of their times, as ParaView reads a .series file. Rewritten after each frame, by
// renaming, so that a killed run leaves a list of frames that are all there.
#include "core/process/series.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/exchange/publish.hpp"
#include "core/phases/files.hpp"

namespace breach::process {

using nlohmann::ordered_json;

Series Series::going_on(std::filesystem::path folder, const std::string& prefix, double time) {
    Series series(std::move(folder));
    for (const auto& entry : std::filesystem::directory_iterator(series.folder_)) {
        const std::string name = entry.path().filename();
        const auto at = phases::files::time_in(name, prefix);
        if (at && *at < time) series.frames_.emplace_back(*at, name);
    }
    std::ranges::sort(series.frames_);
    return series;
}

void Series::add(const std::string& name, double time) {
    std::erase_if(frames_, [&](const auto& frame) { return frame.second == name; });
    frames_.emplace_back(time, name);
    ordered_json files = ordered_json::array();
    for (const auto& [at, file] : frames_) files.push_back({{"name", file}, {"time", at}});
    const ordered_json document{{"file-series-version", "1.0"}, {"files", std::move(files)}};
    exchange::publish_text(folder_ / phases::files::series, document.dump(1) + "\n");
}

}  // namespace breach::process
