#include "lem_tool/search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "lem_tool/simplex.hpp"
#include "lem_tool/slip_circle.hpp"

namespace breach::lem {

namespace {

constexpr double none = std::numeric_limits<double>::infinity();
constexpr std::size_t valleys_followed = 12;
constexpr double least_gain = 1e-5;  // relative: a tenth of what 50 slices resolve
/// Flatter arcs are an infinite slope in all but name, and radii beyond 100 chords cost digits.
constexpr double flattest = 1e-3;  // sagitta over chord

/// A point of the search: entry and exit as shares of their ranges, depth either as a share of the
/// deepest arc or as "touching this boundary". The latter follows the kink that a weak layer or a
/// hard floor makes in F.
struct Place {
    double entry;
    double exit;
    double depth;
    int touches = -1;  ///< index of a boundary line; -1: depth counts
    int which = 0;     ///< which of the two touching circles
};

/// All straight boundaries below ground, each once.
std::vector<Line> boundaries_of(const Strata& strata) {
    std::vector<Line> lines;
    const double middle = 0.5 * (strata.left() + strata.right());
    const double width = strata.right() - strata.left();
    const auto add = [&](const Line& line) {
        const auto same = [&](const Line& other) {
            return std::abs(other.at(middle) - line.at(middle)) < 1e-9 * width &&
                   std::abs(other.slope - line.slope) < 1e-9;
        };
        if (std::none_of(lines.begin(), lines.end(), same)) lines.push_back(line);
    };
    for (const Strip& strip : strata.strips) {
        for (std::size_t k = strip.first + 1; k < strip.last; ++k) add(strata.layers[k].top);
        add(strip.bottom);
    }
    return lines;
}

class Search {
  public:
    Search(const Model& model, const scene::SlipSearch& ranges)
        : model_(model),
          ranges_(ranges),
          boundaries_(boundaries_of(model.strata)),
          slices_(make_slices(model.strata, model.slices)) {}

    SearchResult run() {
        std::vector<Place> best_of_pair = coarse();
        for (const Place& start : valleys(best_of_pair)) follow(start);
        return std::move(result_);
    }

  private:
    double at(const std::array<double, 2>& range, double share) const {
        return range[0] + share * (range[1] - range[0]);
    }

    std::optional<Ends> ends_of(const Place& place) const {
        const double entry = at(ranges_.entry, place.entry);
        const double exit = at(ranges_.exit, place.exit);
        // on a vertical face the surface starts at its head and ends at its foot
        const scene::Vec2 top(entry, std::max(ground_level(model_.strata, entry, From::left),
                                              ground_level(model_.strata, entry, From::right)));
        const scene::Vec2 toe(exit, std::min(ground_level(model_.strata, exit, From::left),
                                             ground_level(model_.strata, exit, From::right)));
        const double least_chord = 1e-6 * (model_.strata.right() - model_.strata.left());
        if (std::abs(entry - exit) < least_chord) return std::nullopt;
        return entry < exit ? Ends{top, toe} : Ends{toe, top};
    }

    /// F at a place, infinite where there is no valid surface. Remembers the best.
    double try_at(const Place& place) {
        const auto ends = ends_of(place);
        if (!ends) return none;
        double sagitta = place.depth * ends->largest_sagitta();
        if (place.touches >= 0) {
            const Touching circles = touching(*ends, boundaries_[place.touches]);
            if (place.which >= circles.count) return none;
            sagitta = circles.sagitta[place.which] * (1.0 - 1e-9);  // touches, does not cut
        }
        sagitta = std::max(sagitta, flattest * 2.0 * ends->half_chord());
        const Surface surface = surface_through(*ends, sagitta);
        if (cut(model_.strata, model_.soils, surface, model_.slices, slices_) != Cut::done) {
            ++result_.tally.not_a_surface;
            return none;
        }
        if (slices_.depth < ranges_.minimum_depth) {
            ++result_.tally.too_shallow;
            return none;
        }
        const double entry = at(ranges_.entry, place.entry);
        const Slide slide = entry == surface.right ? Slide::to_left : Slide::to_right;
        const Bishop bishop_result = bishop(slices_, slide, model_.k_h);
        if (bishop_result.balance != Balance::found) {
            ++result_.tally.no_answer;
            return none;
        }
        ++result_.tally.analysed;
        last_ = {surface, bishop_result};
        if (!result_.critical ||
            bishop_result.factor_of_safety < result_.critical->bishop.factor_of_safety) {
            result_.critical = last_;
        }
        return bishop_result.factor_of_safety;
    }

    /// Every pair of ends with every depth and every touching circle; the best place of each pair.
    std::vector<Place> coarse() {
        std::vector<Place> places;
        places.reserve(static_cast<std::size_t>(ranges_.entry_points) * ranges_.exit_points);
        values_.clear();
        for (int i = 0; i < ranges_.entry_points; ++i) {
            for (int j = 0; j < ranges_.exit_points; ++j) {
                places.push_back(best_of_pair(i / (ranges_.entry_points - 1.0),
                                              j / (ranges_.exit_points - 1.0)));
            }
        }
        return places;
    }

    Place best_of_pair(double entry, double exit) {
        Place best{entry, exit, 0.5};
        double least = none;
        std::optional<Critical> critical;
        const auto consider = [&](const Place& place) {
            const double F = try_at(place);
            if (F >= least) return;
            least = F;
            best = place;
            critical = last_;
        };
        for (int k = 1; k <= ranges_.depths; ++k) {
            consider({entry, exit, static_cast<double>(k) / ranges_.depths});
        }
        for (int line = 0; line < static_cast<int>(boundaries_.size()); ++line) {
            for (int which = 0; which < 2; ++which) consider({entry, exit, 0.5, line, which});
        }
        values_.push_back(least);
        if (critical) {
            result_.pairs.push_back({at(ranges_.entry, entry), at(ranges_.exit, exit), *critical});
        }
        return best;
    }

    /// The best pairs, each a twelfth of the ranges away from every better one.
    std::vector<Place> valleys(const std::vector<Place>& places) const {
        std::vector<std::size_t> order(places.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::stable_sort(order.begin(), order.end(),
                         [&](std::size_t a, std::size_t b) { return values_[a] < values_[b]; });
        std::vector<Place> starts;
        for (const std::size_t n : order) {
            if (values_[n] == none || starts.size() == valleys_followed) break;
            const auto near = [&](const Place& other) {
                return std::abs(other.entry - places[n].entry) < 1.0 / 12.0 &&
                       std::abs(other.exit - places[n].exit) < 1.0 / 12.0;
            };
            if (std::none_of(starts.begin(), starts.end(), near)) starts.push_back(places[n]);
        }
        return starts;
    }

    void follow(const Place& start) {
        const double depth_step = start.touches < 0 ? 1.0 / ranges_.depths : 0.0;
        const auto value = [&](const std::array<double, 3>& at) {
            return try_at({at[0], at[1], at[2], start.touches, start.which});
        };
        const std::array<double, 3> at{start.entry, start.exit, start.depth};
        descend(value, {at, value(at)},
                {1.0 / (ranges_.entry_points - 1), 1.0 / (ranges_.exit_points - 1), depth_step},
                least_gain);
    }

    const Model& model_;
    const scene::SlipSearch& ranges_;
    std::vector<Line> boundaries_;
    Slices slices_;
    std::vector<double> values_;
    Critical last_{};
    SearchResult result_;
};

}  // namespace

SearchResult search(const Model& model, const scene::SlipSearch& ranges) {
    return Search(model, ranges).run();
}

}  // namespace breach::lem
