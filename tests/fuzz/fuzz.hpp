// Shared by the fuzz targets: the function that libFuzzer and replay.cpp call, files for readers
// that need a path, and decisions from the input. A target returns if its input was accepted or
// refused as bad input; any other exception, or a sanitizer's finding, is a defect.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/fault/fault.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace breach::fuzz {

/// Fails if this input breaks a promise of the code.
inline void require(bool kept, const char* promise) {
    if (!kept) throw std::logic_error(std::string("broken promise: ") + promise);
}

/// Runs `read`; true: input accepted, false: refused as bad input with a fault.
template <class Read>
bool taken(Read&& read) {
    try {
        read();
        return true;
    } catch (const fault::BadInput& refusal) {
        require(!refusal.faults().empty(), "a refusal names a fault");
        return false;
    }
}

/// A file that exists as long as this object.
class File {
  public:
    explicit File(std::string_view content)
        : path_(std::filesystem::temp_directory_path() /
                ("breach_fuzz_" + std::to_string(getpid()))) {
        std::ofstream(path_, std::ios::binary) << content;
    }
    ~File() { std::filesystem::remove(path_); }
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

/// Decisions from the input's bytes; zeros when they are used up.
class Purse {
  public:
    Purse(const std::uint8_t* data, std::size_t size) : rest_(data, data + size) {}
    bool empty() const { return at_ >= rest_.size(); }
    std::uint8_t byte() { return empty() ? 0 : rest_[at_++]; }
    /// Little endian, `bytes` of them.
    std::uint64_t number(int bytes) {
        std::uint64_t value = 0;
        for (int i = 0; i < bytes; ++i) value |= std::uint64_t{byte()} << (8 * i);
        return value;
    }
    /// In [0, n); 0 for n = 0.
    std::size_t below(std::size_t n) { return n == 0 ? 0 : number(2) % n; }

  private:
    std::basic_string<std::uint8_t> rest_;
    std::size_t at_ = 0;
};

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

}  // namespace breach::fuzz
