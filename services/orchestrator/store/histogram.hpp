// Counts of values below fixed bounds in Prometheus' format. Thread-safe.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

namespace breach::orchestrator {

class Histogram {
  public:
    /// `bounds` ascending; values above the last are counted too.
    explicit Histogram(std::vector<double> bounds)
        : bounds_(std::move(bounds)), counts_(bounds_.size() + 1) {}

    void add(double value) {
        std::size_t i = 0;
        while (i < bounds_.size() && value > bounds_[i]) ++i;
        ++counts_[i];
        sum_.fetch_add(value);
    }

    /// Lines of the text format, version 0.0.4.
    std::string as_text(const std::string& name, const std::string& help) const;

  private:
    std::vector<double> bounds_;
    std::vector<std::atomic<std::uint64_t>> counts_;
    std::atomic<double> sum_ = 0.0;
};

}  // namespace breach::orchestrator
