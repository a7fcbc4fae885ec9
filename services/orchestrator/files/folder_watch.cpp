// Notices of the kernel about folders on this machine. They only shorten the wait: callers look
// again after a while without one, as other machines' changes give none and a full queue drops
// them.
#include "services/orchestrator/files/folder_watch.hpp"

#include <sys/inotify.h>
#include <unistd.h>

#include <array>
#include <cstring>

#include "core/fault/fault.hpp"

namespace breach::orchestrator {

FolderWatch::FolderWatch() : descriptor_(inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {
    if (descriptor_ < 0)
        throw fault::IoError("inotify: " + std::string(std::strerror(errno)) +
                             "; raise fs.inotify.max_user_instances");
}

FolderWatch::~FolderWatch() { close(descriptor_); }

/// -1 for a folder that is missing or one too many; the caller then relies on its regular look.
/// Adding a folder twice gives the same number.
int FolderWatch::add(const std::filesystem::path& folder, Notice notice) {
    const std::uint32_t mask =
        notice == Notice::published_files ? IN_MOVED_TO : IN_MOVED_TO | IN_MODIFY | IN_CREATE;
    return inotify_add_watch(descriptor_, folder.c_str(), mask);
}

void FolderWatch::remove(int watch) {
    if (watch >= 0) inotify_rm_watch(descriptor_, watch);
}

std::vector<int> FolderWatch::changes() {
    std::vector<int> seen;
    alignas(inotify_event) std::array<char, 16384> buffer{};
    ssize_t size = 0;
    while ((size = read(descriptor_, buffer.data(), buffer.size())) > 0) {
        for (ssize_t at = 0; at < size;) {
            inotify_event event{};
            std::memcpy(&event, buffer.data() + at, sizeof event);
            if (seen.empty() || seen.back() != event.wd) seen.push_back(event.wd);
            at += static_cast<ssize_t>(sizeof event + event.len);
        }
    }
    return seen;
}

}  // namespace breach::orchestrator
