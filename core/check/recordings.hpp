// Cache of motions: the scenes of one study often name the same file, which is read
// once. Thread-safe.
#pragma once

#include <filesystem>
#include <map>
#include <mutex>

#include "core/motion/read_motion.hpp"

namespace breach::check {

class Recordings {
  public:
    /// Throws as motion::read_motion does; a file that could not be read is tried again next time.
    motion::Recording of(const std::filesystem::path& file);

  private:
    std::mutex mutex_;
    std::map<std::filesystem::path, motion::Recording> known_;
};

}  // namespace breach::check
