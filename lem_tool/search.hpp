// The critical circle: entry-exit search, coarse grid first, then a descent from every promising
// minimum. Deterministic; the result does not depend on the number of threads.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lem_tool/arc.hpp"
#include "lem_tool/bishop.hpp"
#include "lem_tool/strata.hpp"

namespace breach::lem {

/// Input of an analysis: soil, strengths and the number of slices.
struct Model {
    Strata strata;
    std::vector<Soil> soils;  ///< by region
    int slices;
    double k_h = 0.0;  ///< horizontal seismic coefficient [-]
    scene::MAlphaLimit m_alpha{};
    /// By region: the residual strength of its material's profile, where it has one
    std::vector<std::optional<materials::StrengthCurve>> residual{};
};
Model make_model(const scene::Scene& scene);

/// The soils after the first `count` layers have liquefied, below their phreatic line: c = s_r, phi =
/// 0. Above it they are unchanged.
std::vector<Soil> liquefied(const Model& model, const std::vector<scene::UndrainedRegion>& layers,
                            std::size_t count);

/// A surface with its factor of safety.
struct Critical {
    Surface surface;
    Bishop bishop;
};

/// Number of tried surfaces, and of those without an answer by reason.
struct Tally {
    std::int64_t analysed = 0;       ///< a factor of safety was computed
    std::int64_t not_a_surface = 0;  ///< left the soil, the model, or met a closed region
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
    Tally tally;
    std::vector<PairBest> pairs;
};

/// Limit of slices in the coarse grid; the descents, and so the result, use the
/// model's.
inline constexpr int coarse_slices = 25;
/// coarse: the best of the grid, an upper bound of the result of the whole search.
enum class Effort { whole, coarse };
SearchResult search(const Model& model, const scene::SlipSearch& ranges, int threads = 1,
                    Effort effort = Effort::whole);

}  // namespace breach::lem
