#include "core/phases/files.hpp"

#include <array>
#include <cstdio>

namespace breach::phases::files {

std::string spelt(double time) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%.6f", time);
    return text.data();
}

std::string snapshot_name(double time) {
    return snapshot_prefix + spelt(time) + snapshot_extension;
}

std::string frame_name(double time) { return frame_prefix + spelt(time) + snapshot_extension; }

}  // namespace breach::phases::files
