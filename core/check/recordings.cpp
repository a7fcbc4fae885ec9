#include "core/check/recordings.hpp"

namespace breach::check {

motion::Recording Recordings::of(const std::filesystem::path& file) {
    const std::lock_guard lock(mutex_);
    const auto known = known_.find(file);
    return known != known_.end() ? known->second
                                 : known_.emplace(file, motion::read_motion(file)).first->second;
}

}  // namespace breach::check
