// How slow a client may be.
#pragma once

#include <chrono>

namespace breach::orchestrator {

/// A head, and a handshake, must be there whole within `patience`. A body, and what reads an answer, may pause as long at a
/// time; in all as long and one second more for every `least_rate` bytes that went through.
struct Patience {
    std::chrono::milliseconds patience{10000};
    double least_rate = 8192;  ///< [bytes/s]
};

}  // namespace breach::orchestrator
