// Random numbers that are equal on every machine: the standard defines std::mt19937_64, but not the
// output of std's distributions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace breach::statistics {

class Random {
  public:
    /// Streams of the same seed are independent sequences.
    Random(std::uint64_t seed, std::uint64_t stream) {
        std::seed_seq mixed{
            static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32),
            static_cast<std::uint32_t>(stream), static_cast<std::uint32_t>(stream >> 32)};
        engine_.seed(mixed);
    }

    std::uint64_t bits() { return engine_(); }
    /// 0 <= x < 1, in steps of 2^-53.
    double share() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
    /// 0 <= i < n, uniform up to 2^-53 n.
    std::size_t below(std::size_t n) {
        return static_cast<std::size_t>(share() * static_cast<double>(n));
    }
    template <class T>
    void shuffle(std::vector<T>& list) {
        for (std::size_t i = list.size(); i > 1; --i) std::swap(list[i - 1], list[below(i)]);
    }

  private:
    std::mt19937_64 engine_;
};

}  // namespace breach::statistics
