// Blocks of the grid and descents run on threads; each has its own Probe, and the results are
// compared in a fixed order, so that the number of threads changes nothing.
#include "lem_tool/search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include "core/numerics/blocks.hpp"
#include "lem_tool/simplex.hpp"
#include "lem_tool/slip_circle.hpp"

namespace breach::lem {

namespace {

constexpr double none = std::numeric_limits<double>::infinity();
constexpr std::size_t valleys_followed = 24;
constexpr std::size_t valleys_of_sample = 8;
constexpr double least_gain = 1e-5;  // relative: a tenth of the resolution with 50 slices
constexpr double least_gain_polished = 1e-7;
constexpr double most_gain_polished =
    0.01;  // relative; descents farther from the best stay as they are
/// Flatter arcs are practically infinite slopes; radii beyond 100 chords lose digits.
constexpr double flattest = 1e-3;  // sagitta over chord

/// Depth of the arc between two ends. touching: follows the kink in F at a weak layer or hard
/// floor. shallowest: minimum_depth, at which soil without cohesion has its critical surface.
enum class Sag { share_of_deepest, touching, shallowest };

/// A point of the search: entry and exit as shares of their ranges, and the arc.
struct Place {
    double entry;
    double exit;
    double depth;  ///< share of the largest sagitta
    Sag sag = Sag::share_of_deepest;
    int line = 0;   ///< touching: index of a boundary line
    int which = 0;  ///< touching: which of the two circles
};

/// Analyses places one by one; keeps the best and counts.
class Probe {
  public:
    Probe(const Model& model, const scene::SlipSearch& ranges, const std::vector<Line>& boundaries,
          int slices)
        : model_(model),
          ranges_(ranges),
          boundaries_(boundaries),
          wanted_(slices),
          slices_(make_slices(model.strata, slices)) {}

    const Tally& tally() const { return tally_; }
    const std::optional<Critical>& best() const { return best_; }
    /// The surface of the last finite factor.
    const Critical& last() const { return last_; }

    double entry_of(const Place& place) const { return at(ranges_.entry, place.entry); }
    double exit_of(const Place& place) const { return at(ranges_.exit, place.exit); }

    /// Place of the best surface, with its depth as a share: it may leave the boundary.
    const Place& best_place() const { return best_place_; }

    /// F at a place; infinite without a valid surface.
    double try_at(const Place& place) {
        const auto ends = ends_of(place);
        if (!ends) return none;
        const bool to_left = entry_of(place) > exit_of(place);
        const double sagitta =
            // An infinite sagitta (no such arc) stays infinite.
            std::max(sagitta_at(place, *ends, to_left), flattest * 2.0 * ends->half_chord());
        if (sagitta == none) return none;
        if (!cut_at(*ends, sagitta, to_left)) {
            ++tally_.not_a_surface;
            return none;
        }
        if (slices_.depth < ranges_.minimum_depth) {
            ++tally_.too_shallow;
            return none;
        }
        const Bishop result =
            bishop(slices_, to_left ? Slide::to_left : Slide::to_right, model_.k_h);
        if (result.balance != Balance::found) {
            ++tally_.no_answer;
            return none;
        }
        ++tally_.analysed;
        last_ = {surface_, result};
        if (!best_ || result.factor_of_safety < best_->bishop.factor_of_safety) {
            best_ = last_;
            // Polishing may leave the boundary or least depth on which the descent moved.
            best_place_ = {place.entry, place.exit, sagitta / ends->largest_sagitta()};
        }
        return result.factor_of_safety;
    }

  private:
    /// Cuts the mass above the arc into slices.
    bool cut_at(const Ends& ends, double sagitta, bool to_left) {
        const auto surface = with_crack(model_.strata, surface_through(ends, sagitta),
                                        to_left ? UpperEnd::right : UpperEnd::left);
        if (!surface) return false;
        surface_ = *surface;
        return cut(model_.strata, model_.soils, surface_, wanted_, slices_) == Cut::done;
    }

    /// Infinite if there is no such arc.
    double sagitta_at(const Place& place, const Ends& ends, bool to_left) {
        if (place.sag == Sag::share_of_deepest) return place.depth * ends.largest_sagitta();
        if (place.sag == Sag::shallowest) return shallowest(ends, to_left);
        const Touching circles = touching(ends, boundaries_[place.line]);
        if (place.which >= circles.count) return none;
        return circles.sagitta[place.which] * (1.0 - 1e-9);  // just above the tangent
    }

    /// The arc whose mass has the depth minimum_depth, nearly proportional to the sagitta.
    double shallowest(const Ends& ends, bool to_left) {
        const double wanted = ranges_.minimum_depth * (1.0 + 1e-9);
        double sagitta = std::min(wanted, ends.largest_sagitta());
        for (int n = 0; n < 8; ++n) {
            if (!cut_at(ends, sagitta, to_left) || slices_.depth <= 0.0) return none;
            if (slices_.depth >= ranges_.minimum_depth && slices_.depth <= wanted * (1.0 + 1e-6))
                return sagitta;
            sagitta *= wanted / slices_.depth;
            if (sagitta > ends.largest_sagitta()) return none;
        }
        return none;
    }

    static double at(const std::array<double, 2>& range, double share) {
        return range[0] + share * (range[1] - range[0]);
    }

    std::optional<Ends> ends_of(const Place& place) const {
        const double entry = entry_of(place);
        const double exit = exit_of(place);
        // On a vertical face the surface starts at the top and ends at the bottom.
        const scene::Vec2 top(entry, std::max(ground_level(model_.strata, entry, From::left),
                                              ground_level(model_.strata, entry, From::right)));
        const scene::Vec2 toe(exit, std::min(ground_level(model_.strata, exit, From::left),
                                             ground_level(model_.strata, exit, From::right)));
        const double least_chord = 1e-6 * (model_.strata.right() - model_.strata.left());
        if (std::abs(entry - exit) < least_chord) return std::nullopt;
        return entry < exit ? Ends{top, toe} : Ends{toe, top};
    }

    const Model& model_;
    const scene::SlipSearch& ranges_;
    const std::vector<Line>& boundaries_;
    int wanted_;
    Slices slices_;
    Surface surface_{};
    Critical last_{};
    std::optional<Critical> best_;
    Place best_place_{};
    Tally tally_;
};

class Search {
  public:
    Search(const Model& model, const scene::SlipSearch& ranges, int threads, Effort effort)
        : model_(model),
          ranges_(effort == Effort::sample ? halved(ranges) : ranges),
          threads_(threads),
          effort_(effort),
          boundaries_(boundaries_of(model.strata)) {}

    SearchResult run() {
        coarse();
        if (effort_ == Effort::coarse) {
            for (const PairBest& each : result_.pairs) keep(each.critical);
            return std::move(result_);
        }
        const std::vector<Place> starts = valleys();
        std::vector<Probe> probes;
        probes.reserve(starts.size());
        for (std::size_t i = 0; i < starts.size(); ++i) probes.push_back(probe(model_.slices));
        numerics::run_blocks(starts.size(), threads_, [&](std::size_t i) {
            follow(starts[i], probes[i], grid_step(), least_gain);
        });
        double least = none;
        for (const Probe& each : probes) least = std::min(least, value_of(each));
        numerics::run_blocks(probes.size(), threads_, [&](std::size_t i) {
            if (value_of(probes[i]) <= least * (1.0 + most_gain_polished)) polish(probes[i]);
        });
        double second = none;
        for (const Probe& each : probes) {
            result_.tally += each.tally();
            if (!each.best()) continue;
            const double best = result_.critical ? result_.critical->bishop.factor_of_safety : none;
            second = std::min(second, std::max(value_of(each), best));
            keep(*each.best());
        }
        if (second < none) result_.error = second / result_.critical->bishop.factor_of_safety - 1.0;
        return std::move(result_);
    }

  private:
    static scene::SlipSearch halved(scene::SlipSearch ranges) {
        constexpr int fewest = 8;
        for (int* each : {&ranges.entry_points, &ranges.exit_points, &ranges.depths})
            *each = std::min(*each, std::max(fewest, *each / 2));
        return ranges;
    }

    struct Valued {
        Place place;
        double value;
    };

    /// The surfaces of a pair of ends: the best of the depths, and those that follow something.
    struct Pair {
        std::vector<Valued> places;
        std::optional<PairBest> best;
    };

    static double value_of(const Probe& probe) {
        return probe.best() ? probe.best()->bishop.factor_of_safety : none;
    }

    void keep(const Critical& each) {
        if (!result_.critical ||
            each.bishop.factor_of_safety < result_.critical->bishop.factor_of_safety)
            result_.critical = each;
    }

    Probe probe(int slices) const { return {model_, ranges_, boundaries_, slices}; }

    /// Ends as shares of a range: equally spaced, and where another region begins on the ground. A
    /// surface tangent to a boundary may have to end within a narrow stretch above its outcrop.
    std::vector<double> ends_in(const std::array<double, 2>& range, int count) const {
        std::vector<double> shares(static_cast<std::size_t>(count));
        for (int i = 0; i < count; ++i)
            shares[static_cast<std::size_t>(i)] = static_cast<double>(i) / (count - 1);
        if (effort_ == Effort::coarse) return shares;
        const Strata& strata = model_.strata;
        const auto on_ground = [&](const Strip& strip) {
            return strata.layers[strip.first].region;
        };
        for (std::size_t k = 0; k + 1 < strata.strips.size(); ++k) {
            const double share = (strata.strips[k].to - range[0]) / (range[1] - range[0]);
            if (on_ground(strata.strips[k]) != on_ground(strata.strips[k + 1]) && share > 0.0 &&
                share < 1.0)
                shares.push_back(share);
        }
        return shares;
    }

    /// All pairs of ends with all depths and tangent circles; one block per entry.
    void coarse() {
        const auto from = ends_in(ranges_.entry, ranges_.entry_points);
        const auto to = ends_in(ranges_.exit, ranges_.exit_points);
        const std::size_t entries = from.size();
        const std::size_t exits = to.size();
        pairs_.resize(entries * exits);
        std::vector<Tally> tallies(entries);
        numerics::run_blocks(entries, threads_, [&](std::size_t i) {
            // Fewer slices: the grid only has to find the places from which the descents start.
            Probe here = probe(std::min(model_.slices, coarse_slices));
            for (std::size_t j = 0; j < exits; ++j) {
                pairs_[i * exits + j] = pair_of(here, from[i], to[j]);
            }
            tallies[i] = here.tally();
        });
        for (const Tally& tally : tallies) result_.tally += tally;
        for (const Pair& pair : pairs_) {
            if (pair.best) result_.pairs.push_back(*pair.best);
        }
    }

    Pair pair_of(Probe& here, double entry, double exit) const {
        Pair pair{{{{entry, exit, 0.5}, none}}, std::nullopt};
        const auto value_of = [&](const Place& place) {
            const double F = here.try_at(place);
            // Depths first, then tangents: of equal factors the first one stays.
            if (F < none && (!pair.best || F < pair.best->critical.bishop.factor_of_safety))
                pair.best = PairBest{here.entry_of(place), here.exit_of(place), here.last()};
            return F;
        };
        for (int k = 1; k <= ranges_.depths; ++k) {
            const Place place{entry, exit, static_cast<double>(k) / ranges_.depths};
            const double F = value_of(place);
            if (F < pair.places[0].value) pair.places[0] = {place, F};
        }
        const auto add = [&](const Place& place) {
            if (const double F = value_of(place); F < none) pair.places.push_back({place, F});
        };
        for (int line = 0; line < static_cast<int>(boundaries_.size()); ++line) {
            for (int which = 0; which < 2; ++which)
                add({entry, exit, 0.5, Sag::touching, line, which});
        }
        if (ranges_.minimum_depth > 0.0) add({entry, exit, 0.5, Sag::shallowest});
        return pair;
    }

    /// The best places; those that follow the same at least a twelfth of the ranges apart: each
    /// boundary has valleys of its own, which other circles through the same ends may hide.
    std::vector<Place> valleys() const {
        std::vector<Valued> all;
        for (const Pair& pair : pairs_)
            std::ranges::copy_if(pair.places, std::back_inserter(all),
                                 [](const Valued& each) { return each.value < none; });
        // Stable: equal factors keep the order of the grid.
        std::ranges::stable_sort(all, {}, &Valued::value);
        const std::size_t most = effort_ == Effort::sample ? valleys_of_sample : valleys_followed;
        std::vector<Place> starts;
        for (const Valued& each : all) {
            if (starts.size() == most) break;
            const Place& place = each.place;
            const auto near = [&](const Place& other) {
                return other.sag == place.sag && other.line == place.line &&
                       other.which == place.which &&
                       std::abs(other.entry - place.entry) < 1.0 / 12.0 &&
                       std::abs(other.exit - place.exit) < 1.0 / 12.0;
            };
            if (std::ranges::none_of(starts, near)) starts.push_back(place);
        }
        return starts;
    }

    std::array<double, 3> grid_step() const {
        return {1.0 / (ranges_.entry_points - 1), 1.0 / (ranges_.exit_points - 1),
                1.0 / ranges_.depths};
    }

    void follow(const Place& start, Probe& here, std::array<double, 3> step, double gain) const {
        // The depth then follows from the boundary or the least depth: two variables are left.
        if (start.sag != Sag::share_of_deepest) step[2] = 0.0;
        const auto value = [&](const std::array<double, 3>& at) {
            return here.try_at({at[0], at[1], at[2], start.sag, start.line, start.which});
        };
        const std::array<double, 3> at{start.entry, start.exit, start.depth};
        descend(value, {at, value(at)}, step, gain);
    }

    /// Continues from a descent's result in small steps, away from its boundary and at
    /// minimum_depth, for flat minima.
    void polish(Probe& here) const {
        if (!here.best()) return;
        std::array<double, 3> step = grid_step();
        for (double& each : step) each *= 0.25;
        follow(here.best_place(), here, step, least_gain_polished);
        if (ranges_.minimum_depth <= 0.0) return;
        Place edge = here.best_place();
        edge.sag = Sag::shallowest;
        follow(edge, here, step, least_gain_polished);
    }

    const Model& model_;
    const scene::SlipSearch ranges_;
    int threads_;
    Effort effort_;
    std::vector<Line> boundaries_;
    std::vector<Pair> pairs_;
    SearchResult result_;
};

}  // namespace

std::vector<Line> boundaries_of(const Strata& strata) {
    std::vector<Line> lines;
    const double middle = 0.5 * (strata.left() + strata.right());
    const double width = strata.right() - strata.left();
    const auto add = [&](const Line& line) {
        // The same boundary in many strips is tried once.
        const auto same = [&](const Line& other) {
            return std::abs(other.at(middle) - line.at(middle)) < 1e-9 * width &&
                   std::abs(other.slope - line.slope) < 1e-9;
        };
        if (std::none_of(lines.begin(), lines.end(), same)) lines.push_back(line);
    };
    for (const Strip& strip : strata.strips) {
        const double x = 0.5 * (strip.from + strip.to);
        const double limit = std::max(strip.bottom.at(x), strip.floor.at(x));
        for (std::size_t k = strip.first + 1; k < strip.last; ++k) {
            if (strata.layers[k].top.at(x) > limit) add(strata.layers[k].top);
        }
        add(strip.floor.at(x) >= strip.bottom.at(x) ? strip.floor : strip.bottom);
    }
    return lines;
}

Tally& Tally::operator+=(const Tally& other) {
    analysed += other.analysed;
    not_a_surface += other.not_a_surface;
    too_shallow += other.too_shallow;
    no_answer += other.no_answer;
    return *this;
}

SearchResult search(const Model& model, const scene::SlipSearch& ranges, int threads,
                    Effort effort) {
    return Search(model, ranges, threads, effort).run();
}

}  // namespace breach::lem
