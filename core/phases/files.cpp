#include "core/phases/files.hpp"

#include <array>
#include <charconv>
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

std::optional<double> time_in(std::string_view name, std::string_view prefix) {
    if (!name.starts_with(prefix) || !name.ends_with(snapshot_extension)) return std::nullopt;
    name.remove_prefix(prefix.size());
    name.remove_suffix(std::string_view(snapshot_extension).size());
    double time = 0.0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), time);
    if (error != std::errc{} || end != name.data() + name.size()) return std::nullopt;
    return time;
}

}  // namespace breach::phases::files
