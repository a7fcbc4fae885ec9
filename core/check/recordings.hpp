// Motions that were read: many scenes of one study name the same file, and checking them must not
// read it as often. For several threads at once.
#pragma once

#include <filesystem>
#include <map>
#include <mutex>

#include "core/motion/read_motion.hpp"

namespace breach::check {

class Recordings {
  public:
    /// Throws as motion::read_motion does; what could not be read is tried again the next time.
    motion::Recording of(const std::filesystem::path& file);

  private:
    std::mutex mutex_;
    std::map<std::filesystem::path, motion::Recording> known_;
};

}  // namespace breach::check
