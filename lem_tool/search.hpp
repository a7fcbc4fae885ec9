// The critical circle: search over entries and exits, first on a coarse grid, then a descent from
// every promising minimum. Deterministic for any number of threads.
// Called by search_families (answer.cpp) for each state, by bounds.cpp with other ranges and by
// variation.cpp per sample.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "lem_tool/arc.hpp"
#include "lem_tool/bishop.hpp"
#include "lem_tool/strata.hpp"

namespace breach::lem {

/// Input of an analysis.
struct Model {
    Strata strata;
    std::vector<Soil> soils;  ///< by region
    int slices;
    double k_h = 0.0;  ///< horizontal seismic coefficient [-]
    /// By region: residual strength of its material's profile, if any
    std::vector<std::optional<materials::StrengthCurve>> residual{};
};
Model make_model(const scene::Scene& scene);

/// The soils with the first `count` layers liquefied: c = s_r, phi = 0 below their phreatic line,
/// unchanged above it.
std::vector<Soil> liquefied(const Model& model, const std::vector<scene::UndrainedRegion>& layers,
                            std::size_t count);

/// A surface with its factor of safety.
struct Critical {
    Surface surface;
    Bishop bishop;
};

/// Numbers of surfaces: analysed, and refused by reason.
/// For messages: a search that finds nothing says why (refuse_search).
struct Tally {
    std::int64_t analysed = 0;       ///< with a factor of safety
    std::int64_t not_a_surface = 0;  ///< leaves the soil or the model, or crosses a closed region
    std::int64_t too_shallow = 0;
    std::int64_t no_answer = 0;  ///< no driving moment, m_alpha too small, not converged

    Tally& operator+=(const Tally& other);
};

/// The best circle of one pair of ends, for the figure of the search.
struct PairBest {
    double entry;
    double exit;
    Critical critical;
};

struct SearchResult {
    std::optional<Critical> critical;
    /// Relative gap between the two best descents; infinite: fewer than two ended.
    double error = std::numeric_limits<double>::infinity();
    Tally tally;
    std::vector<PairBest> pairs;
};

/// Slices in the coarse grid, at most. The descents, and so the result, use the model's number.
inline constexpr int coarse_slices = 25;
/// sample: a coarser grid and fewer descents, for one of many similar slopes. coarse: only the grid,
/// an upper bound of the whole search's result.
enum class Effort { whole, sample, coarse };
/// All straight boundaries below ground, each once.
std::vector<Line> boundaries_of(const Strata& strata);

SearchResult search(const Model& model, const scene::SlipSearch& ranges, int threads = 1,
                    Effort effort = Effort::whole);

}  // namespace breach::lem
