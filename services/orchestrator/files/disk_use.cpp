// Space on the disk by run. The cache shares files by hard links, so that a run's size is not
// what its removal frees: contents are counted by inode, with the names that each run has for it.
// Retention and the storage page call it; it visits every file.
#include "services/orchestrator/files/disk_use.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <functional>
#include <set>

namespace breach::orchestrator {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t most_named = 10;

std::int64_t bytes_of(const struct stat& info) {
    constexpr std::int64_t block = 512;  // unit of st_blocks on every disk
    return block * static_cast<std::int64_t>(info.st_blocks);
}

/// Visits everything below the folder, including folders.
void for_each_below(const fs::path& folder, const std::function<void(const struct stat&)>& visit) {
    std::error_code error;
    fs::recursive_directory_iterator entry(folder, error);
    while (!error && entry != fs::recursive_directory_iterator()) {
        struct stat info {};
        if (lstat(entry->path().c_str(), &info) == 0) visit(info);
        entry.increment(error);
    }
}

}  // namespace

/// Without a look at other runs: the inode's link count says whether there are names elsewhere.
std::int64_t freed_without(const fs::path& run) {
    std::map<std::pair<std::uint64_t, std::uint64_t>, std::uint64_t> names_here;
    std::int64_t freed = 0;
    for_each_below(run, [&](const struct stat& info) {
        const std::uint64_t here = ++names_here[{info.st_dev, info.st_ino}];
        if (S_ISDIR(info.st_mode) || here == info.st_nlink) freed += bytes_of(info);
    });
    return freed;
}

DiskUse::DiskUse(const fs::path& runs, const fs::path& files) {
    std::set<Key> sent;
    for_each_below(files, [&](const struct stat& info) {
        if (sent.insert({info.st_dev, info.st_ino}).second) bytes_of_files_ += bytes_of(info);
    });
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(runs, error)) {
        const std::string run = entry.path().filename();
        of_run_[run];
        for_each_below(entry.path(), [&](const struct stat& info) {
            const Key key{info.st_dev, info.st_ino};
            // The link count of a folder counts its subfolders: a folder belongs to one run.
            const std::uint64_t names = S_ISDIR(info.st_mode) ? 1 : info.st_nlink;
            auto [found, is_new] = contents_.try_emplace(key, Content{bytes_of(info), names, {}});
            if (is_new && !sent.contains(key)) bytes_of_runs_ += found->second.bytes;
            if (++found->second.in_runs[run] == 1) of_run_[run].push_back(key);
        });
    }
}

bool DiskUse::is_held_elsewhere(const Content& content, const std::string& run) const {
    return content.names > content.in_runs.at(run);
}

std::map<std::string, RunUse> DiskUse::by_run() const {
    std::map<std::string, RunUse> found;
    for (const auto& [run, keys] : of_run_) {
        RunUse& use = found[run];
        std::set<std::string, std::greater<>> others;
        for (const Key& key : keys) {
            const Content& content = contents_.at(key);
            const bool shared = is_held_elsewhere(content, run);
            (shared ? use.shared : use.own) += content.bytes;
            if (!shared) continue;
            std::size_t newest = 0;
            for (auto each = content.in_runs.rbegin();
                 each != content.in_runs.rend() && newest <= most_named; ++each, ++newest)
                if (each->first != run) others.insert(each->first);
        }
        for (const std::string& each : others)
            if (use.shared_with.size() < most_named) use.shared_with.push_back(each);
    }
    return found;
}

std::int64_t DiskUse::leave_out(const std::string& run) {
    std::int64_t freed = 0;
    const auto keys = of_run_.find(run);
    if (keys == of_run_.end()) return 0;
    for (const Key& key : keys->second) {
        Content& content = contents_.at(key);
        if (!is_held_elsewhere(content, run)) freed += content.bytes;
        content.names -= content.in_runs.at(run);
        content.in_runs.erase(run);
    }
    of_run_.erase(keys);
    bytes_of_runs_ -= freed;
    return freed;
}

}  // namespace breach::orchestrator
