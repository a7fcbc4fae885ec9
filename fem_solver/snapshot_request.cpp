#include "fem_solver/snapshot_request.hpp"

#include <cstdio>
#include <string>

#include "core/phases/files.hpp"

namespace breach::fem {

namespace {

std::filesystem::path taken_file(const std::filesystem::path& output) {
    return output / (std::string(phases::files::request) + ".taken");
}

}  // namespace

/// By renaming, so that a request during the writing of the snapshot is a new one.
bool request_is_taken(const std::filesystem::path& output) {
    return std::rename((output / phases::files::request).c_str(), taken_file(output).c_str()) == 0;
}

void answer_request(const std::filesystem::path& output) {
    std::remove(taken_file(output).c_str());
}

}  // namespace breach::fem
