// Nelder & Mead (1965): minimises a function of a few variables without derivatives. Provides the
// simplex and its moves; the caller decides when to stop, restart or clip to a box.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace breach::numerics {

/// Place: an array or vector of coordinates.
template <class Place>
struct Corner {
    Place at;
    double value;
};

/// Corners, sorted by ascending value.
template <class Place>
class Simplex {
  public:
    explicit Simplex(std::vector<Corner<Place>> corners) : corners_(std::move(corners)) { sort(); }

    const Corner<Place>& lowest() const { return corners_.front(); }

    /// Largest coordinate difference from the lowest corner.
    double extent() const {
        double extent = 0.0;
        for (const auto& each : corners_) {
            for (std::size_t d = 0; d < each.at.size(); ++d) {
                extent = std::max(extent, std::abs(each.at[d] - lowest().at[d]));
            }
        }
        return extent;
    }

    /// Moves the worst corner, or shrinks all. corner(place) evaluates a corner there.
    template <class CornerAt>
    void move(const CornerAt& corner) {
        const Place centre = centre_of_the_better();
        Corner<Place>& worst = corners_.back();
        const Corner<Place> reflected = corner(along(worst.at, centre, 2.0));
        if (reflected.value < lowest().value) {
            const Corner<Place> expanded = corner(along(worst.at, centre, 3.0));
            worst = expanded.value < reflected.value ? expanded : reflected;
        } else if (reflected.value < corners_[corners_.size() - 2].value) {
            worst = reflected;
        } else {
            const double side = reflected.value < worst.value ? 1.5 : 0.5;
            const Corner<Place> contracted = corner(along(worst.at, centre, side));
            if (contracted.value < std::min(reflected.value, worst.value)) {
                worst = contracted;
            } else {
                for (std::size_t i = 1; i < corners_.size(); ++i) {
                    corners_[i] = corner(along(lowest().at, corners_[i].at, 0.5));
                }
            }
        }
        sort();
    }

  private:
    /// from + factor (to - from)
    static Place along(const Place& from, const Place& to, double factor) {
        Place result = from;
        for (std::size_t d = 0; d < from.size(); ++d) {
            result[d] = from[d] + factor * (to[d] - from[d]);
        }
        return result;
    }

    Place centre_of_the_better() const {
        Place centre = corners_.front().at;
        std::ranges::fill(centre, 0.0);
        for (std::size_t i = 0; i + 1 < corners_.size(); ++i) {
            for (std::size_t d = 0; d < centre.size(); ++d) {
                centre[d] += corners_[i].at[d] / static_cast<double>(corners_.size() - 1);
            }
        }
        return centre;
    }

    void sort() { std::ranges::stable_sort(corners_, {}, &Corner<Place>::value); }

    std::vector<Corner<Place>> corners_;
};

}  // namespace breach::numerics
