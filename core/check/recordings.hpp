// Cache of motions: reads a file that several scenes of a study name once. Thread-safe.
#pragma once

#include <filesystem>
#include <map>
#include <mutex>

#include "core/motion/read_motion.hpp"

namespace breach::check {

class Recordings {
  public:
    /// Throws as motion::read_motion does; a failed read is not cached.
    motion::Recording of(const std::filesystem::path& file);

  private:
    std::mutex mutex_;
    std::map<std::filesystem::path, motion::Recording> known_;
};

}  // namespace breach::check
