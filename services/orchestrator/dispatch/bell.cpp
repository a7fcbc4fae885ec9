#include "services/orchestrator/dispatch/bell.hpp"

#include <sys/eventfd.h>
#include <unistd.h>

namespace breach::orchestrator {

Bell::Bell() : descriptor_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {}
Bell::~Bell() { close(descriptor_); }
void Bell::ring() const { eventfd_write(descriptor_, 1); }
void Bell::silence() const {
    eventfd_t count = 0;
    eventfd_read(descriptor_, &count);
}

}  // namespace breach::orchestrator
