// Snapshots of a task for the dashboard: a list of them, and their points as flat float32
// arrays.
#pragma once

#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "services/orchestrator/records/records.hpp"

namespace breach::orchestrator {

struct Frame {
    double time;  ///< from the file's name [s]
    std::string name;
    std::string kind;  ///< "particles" or "mesh"
};

/// Complete snapshot files in a phase's output folder, ascending in time; also while the phase
/// still writes.
std::vector<Frame> frames_in(const std::filesystem::path& output, const std::string& phase);

/// Whether a frame's name from a request is safe: a plain .vtkhdf file name without any path.
bool is_frame_name(const std::string& name);

/// A snapshot has no such field; what() lists its fields.
struct NoSuchField : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Reads snapshots for drawing. HDF5's serial library is not safe in two threads: one reader at a
/// time.
class FrameReader {
  public:
    /// One JSON line padded with spaces to a multiple of 4 bytes, then little-endian float32
    /// arrays, then the quads of a mesh as uint32. Takes every stride-th particle; a mesh is never
    /// thinned. wanted: fields besides x and y; empty: all. Throws IoError (the file vanished),
    /// BadInput (it is damaged) or NoSuchField.
    std::string points(const std::filesystem::path& file, const std::string& phase,
                       std::size_t stride, const std::vector<std::string>& wanted = {});

    /// Runs work while no other thread uses HDF5.
    void alone(const std::function<void()>& work) {
        const std::lock_guard lock(mutex_);
        work();
    }

  private:
    std::mutex mutex_;
};

}  // namespace breach::orchestrator
