// A file that a client is sending. POST /v1/files creates it locked, and its handler appends and
// then moves it into its place. A broken connection leaves a resumable file, which the next request
// with the same hash takes up; the destructor removes those that are not kept, and every new upload
// with a hash removes those that no client continued for a day. The lock keeps two requests from
// writing one file.
#include "services/orchestrator/files/arriving_file.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>

#include "core/fault/fault.hpp"

namespace breach::orchestrator {

namespace fs = std::filesystem;

namespace {

constexpr auto kept_for = std::chrono::hours(24);

fault::IoError refusal_of(const fs::path& path) {
    return fault::IoError(path.string() + ": " + std::strerror(errno));
}

struct stat status_of(const FileLock& lock) {
    struct stat status {};
    fstat(lock.descriptor(), &status);
    return status;
}

/// Whether the locked file still has this path: it may have been moved or removed before the lock
/// was taken.
bool is_at(const fs::path& path, const FileLock& lock) {
    struct stat named {};
    return stat(path.c_str(), &named) == 0 && named.st_ino == status_of(lock).st_ino;
}

void remove_old_ones(const fs::path& folder) {
    const auto now = fs::file_time_type::clock::now();
    std::error_code error;
    for (const auto& each : fs::directory_iterator(folder, error)) {
        const auto touched = fs::last_write_time(each.path(), error);
        if (!error && now - touched > kept_for && !is_held(each.path()))
            fs::remove(each.path(), error);
    }
}

}  // namespace

ArrivingFile ArrivingFile::of_one_request(fs::path path) {
    auto lock = FileLock::try_take(path);
    if (!lock) throw fault::IoError(path.string() + ": is being written");
    return {std::move(path), std::move(*lock)};
}

std::optional<ArrivingFile> ArrivingFile::resumable(const fs::path& folder,
                                                    const std::string& name) {
    remove_old_ones(folder);
    const fs::path path = folder / name;
    while (true) {
        auto lock = FileLock::try_take(path);
        if (!lock) return std::nullopt;
        if (is_at(path, *lock)) return ArrivingFile(path, std::move(*lock));
    }
}

/// After a move to its place another file may have the path: it stays.
ArrivingFile::~ArrivingFile() {
    std::error_code error;
    if (lock_.descriptor() >= 0 && !kept_ && is_at(path_, lock_)) fs::remove(path_, error);
}

std::int64_t ArrivingFile::bytes() const { return status_of(lock_).st_size; }

void ArrivingFile::begin_anew() {
    if (ftruncate(lock_.descriptor(), 0) != 0) throw refusal_of(path_);
}

void ArrivingFile::append(const char* data, std::size_t size) {
    off_t end = bytes();
    for (std::size_t done = 0; done < size;) {
        const auto step = pwrite(lock_.descriptor(), data + done, size - done, end);
        if (step <= 0) throw refusal_of(path_);
        done += static_cast<std::size_t>(step);
        end += step;
    }
}

void ArrivingFile::sync() {
    if (fsync(lock_.descriptor()) != 0) throw refusal_of(path_);
}

std::int64_t arrived_bytes(const fs::path& folder, const std::string& sha256) {
    std::error_code error;
    for (const auto& each : fs::directory_iterator(folder, error))
        if (each.path().stem() == sha256) {
            const auto size = fs::file_size(each.path(), error);
            return error ? 0 : static_cast<std::int64_t>(size);
        }
    return 0;
}

}  // namespace breach::orchestrator
