#include <algorithm>
#include <numeric>

#include "core/statistics/points.hpp"
#include "core/statistics/random.hpp"

namespace breach::statistics {

namespace {

/// A coordinate as slice number and position within the slice, which halving keeps exact.
struct SlicePlace {
    std::size_t slice;
    double within;  ///< 0 <= x < 1
};

class Dimension {
  public:
    Dimension(std::size_t first, Random& random) : slices_(first) {
        std::vector<std::size_t> order(first);
        std::iota(order.begin(), order.end(), 0);
        place(std::move(order), random);
    }

    void cut(Random& random) {
        std::vector<bool> taken(2 * slices_, false);
        for (SlicePlace& each : places_) {
            const bool upper = each.within >= 0.5;
            each = {2 * each.slice + (upper ? 1 : 0), 2.0 * each.within - (upper ? 1.0 : 0.0)};
            taken[each.slice] = true;
        }
        slices_ *= 2;
        std::vector<std::size_t> empty;
        for (std::size_t i = 0; i < slices_; ++i)
            if (!taken[i]) empty.push_back(i);
        place(std::move(empty), random);
    }

    const std::vector<double>& values() const { return values_; }

  private:
    void place(std::vector<std::size_t> empty, Random& random) {
        constexpr double above_zero = 0x1p-54;  // a quantile of 0 may be infinite
        random.shuffle(empty);
        for (const std::size_t slice : empty) {
            places_.push_back({slice, random.share()});
            const double u =
                (static_cast<double>(slice) + places_.back().within) / static_cast<double>(slices_);
            values_.push_back(std::clamp(u, above_zero, 1.0 - 2.0 * above_zero));
        }
    }

    std::size_t slices_;
    std::vector<SlicePlace> places_;
    std::vector<double> values_;  ///< unchanged by later halvings
};

}  // namespace

std::vector<std::size_t> blocks_of(std::size_t points, std::size_t first) {
    std::vector<std::size_t> ends{first};
    while (ends.back() < points) ends.push_back(2 * ends.back());
    return ends;
}

Points latin_hypercube(std::size_t points, std::size_t first, std::size_t dimensions,
                       std::uint64_t seed) {
    Points cube(points, std::vector<double>(dimensions));
    const std::size_t whole = blocks_of(points, first).back();
    for (std::size_t d = 0; d < dimensions; ++d) {
        Random random(seed, d);
        Dimension dimension(first, random);
        while (dimension.values().size() < whole) dimension.cut(random);
        for (std::size_t i = 0; i < points; ++i) cube[i][d] = dimension.values()[i];
    }
    return cube;
}

}  // namespace breach::statistics
