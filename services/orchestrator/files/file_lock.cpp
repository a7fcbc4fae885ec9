// Locks that the kernel frees when the last process that inherited them ends, even by KILL; so no
// lock is ever left over. OFD locks rather than flock() because F_OFD_GETLK asks without taking,
// and rather than POSIX locks because those vanish when any descriptor of the file is closed.
#include "services/orchestrator/files/file_lock.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "core/fault/fault.hpp"

namespace breach::orchestrator {

namespace {

/// The whole file, for one open file description: like flock(), but others can query it.
struct flock whole_file() {
    struct flock range {};
    range.l_type = F_WRLCK;
    range.l_whence = SEEK_SET;
    return range;
}

fault::IoError trouble(const std::filesystem::path& file, const std::string& what = "") {
    return fault::IoError(file.string() + ": " + what + std::strerror(errno));
}

}  // namespace

std::optional<FileLock> FileLock::try_take(const std::filesystem::path& file) {
    const int descriptor = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (descriptor < 0) throw trouble(file);
    FileLock lock(descriptor);
    struct flock range = whole_file();
    if (fcntl(descriptor, F_OFD_SETLK, &range) == 0) return lock;
    if (errno == EAGAIN || errno == EACCES) return std::nullopt;
    throw trouble(file, "cannot be locked: ");
}

FileLock::FileLock(FileLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

FileLock& FileLock::operator=(FileLock&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
}

FileLock::~FileLock() {
    if (descriptor_ >= 0) close(descriptor_);
}

/// Where the file may be moved or deleted, the caller compares inodes (ArrivingFile): a second
/// process could lock a new file of the same name.
bool is_held(const std::filesystem::path& file) {
    const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0 && errno == ENOENT) return false;
    if (descriptor < 0) throw trouble(file);
    struct flock range = whole_file();
    const bool answered = fcntl(descriptor, F_OFD_GETLK, &range) == 0;
    close(descriptor);
    if (!answered) throw trouble(file, "cannot be asked for its lock: ");
    return range.l_type != F_UNLCK;
}

}  // namespace breach::orchestrator
