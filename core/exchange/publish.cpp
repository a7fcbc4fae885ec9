// How phases and service put a finished file under its final name. The order matters: data to the
// disk, then the name, then the folder that has the name. After a power failure the name leads to
// the whole file or to none.
#include "core/exchange/publish.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

#include "core/fault/fault.hpp"

namespace breach::exchange {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const std::string& what, int cause) {
    std::string remedy;
    if (cause == ENOSPC || cause == EDQUOT) remedy = "; free some space or choose another folder";
    if (cause == EACCES || cause == EROFS) remedy = "; choose a folder that can be written";
    if (cause == ENOENT) remedy = "; does the folder exist?";
    throw fault::IoError(path.string() + ": " + what + ": " + std::strerror(cause) + remedy);
}

class Descriptor {
  public:
    Descriptor(const fs::path& path, int flags) : number_(::open(path.c_str(), flags, 0666)) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() {
        if (number_ >= 0) ::close(number_);
    }
    int number() const { return number_; }
    /// Some file systems report a full disk only here.
    bool close() { return ::close(std::exchange(number_, -1)) == 0; }

  private:
    int number_;
};

void sync(const fs::path& path, int flags, const fs::path& final_path) {
    Descriptor file(path, flags);
    if (file.number() < 0) fail(final_path, "cannot be opened to be synced", errno);
    // Some network file systems cannot sync a folder; then only the rename protects.
    if (::fsync(file.number()) != 0 && errno != EINVAL)
        fail(final_path, "cannot be synced to the disk", errno);
}

/// Removes the temporary file unless it was published.
class Temporary {
  public:
    explicit Temporary(fs::path path) : path_(std::move(path)) { remove(); }
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;
    ~Temporary() {
        if (!published_) remove();
    }
    const fs::path& path() const { return path_; }
    void published() { published_ = true; }

  private:
    void remove() const {
        std::error_code ignored;
        fs::remove(path_, ignored);
    }
    fs::path path_;
    bool published_ = false;
};

void write_all(const fs::path& path, std::string_view text, const fs::path& final_path) {
    Descriptor file(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC);
    if (file.number() < 0) fail(final_path, "cannot be written", errno);
    while (!text.empty()) {
        const ssize_t written = ::write(file.number(), text.data(), text.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail(final_path, "cannot be written", errno);
        text.remove_prefix(static_cast<std::size_t>(written));
    }
    if (!file.close()) fail(final_path, "cannot be written", errno);
}

}  // namespace

void publish(const fs::path& path, const std::function<void(const fs::path&)>& write) {
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    // A fixed name is enough, as each output folder has one writer; it replaces the rest of a
    // killed attempt.
    std::string name = ".";
    name.append(path.filename().string()).append(".partial");
    // In the same folder, because a rename is atomic within one file system only.
    Temporary temporary(folder / name);
    write(temporary.path());
    sync(temporary.path(), O_RDONLY | O_CLOEXEC, path);
    if (::rename(temporary.path().c_str(), path.c_str()) != 0)
        fail(path, "cannot take its final name", errno);
    temporary.published();
    sync(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC, path);
}

void publish_text(const fs::path& path, std::string_view text) {
    publish(path, [&](const fs::path& temporary) { write_all(temporary, text, path); });
}

}  // namespace breach::exchange
