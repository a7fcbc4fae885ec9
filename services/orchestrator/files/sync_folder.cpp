// A new or renamed file survives a power cut only when its folder is written, too.
#include "services/orchestrator/files/sync_folder.hpp"

#include <fcntl.h>
#include <unistd.h>

namespace breach::orchestrator {

void sync_folder(const std::filesystem::path& folder) {
    const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    fsync(descriptor);
    close(descriptor);
}

}  // namespace breach::orchestrator
