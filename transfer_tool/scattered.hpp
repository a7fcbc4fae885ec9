// Interpolates values between two sets of places in the same regions, from Gauss points to material
// points and back.
// "local" exists because "paper" smears stress across the borders between regions and needs N^2
// memory.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/scene.hpp"
#include "transfer_tool/rbf.hpp"
#include "transfer_tool/watch.hpp"

namespace breach::transfer {

/// Places with known values.
struct Sources {
    std::vector<Vec2> place;           ///< [m]
    std::vector<std::int32_t> region;  ///< of each
    std::size_t regions = 0;
};

/// Places to interpolate to, in groups of neighbours (one per element).
struct Targets {
    std::vector<Vec2> place;           ///< [m]
    std::vector<std::size_t> first;    ///< [n_groups + 1]
    std::vector<std::int32_t> region;  ///< [n_groups]
    std::vector<Vec2> middle;          ///< [n_groups]
    std::vector<std::int64_t> same;    ///< [n_targets] the source at the same place, or -1
};

/// Special cases of the interpolation.
struct GaussFieldReport {
    std::size_t merged_centres = 0;          ///< coincident sources merged
    std::size_t raised_strains = 0;          ///< epsilon_q below -1e-12, set to zero
    std::size_t smallest_neighbourhood = 0;  ///< fewest centres of a group; local only
};

struct Interpolated {
    Values value;  ///< one row per target
    GaussFieldReport report;
};

struct Work {
    int threads = 1;
    Watch watch = {};
};

/// local: one interpolant per group through the `neighbours` sources of its region nearest to its
/// middle. Values do not cross a region's border, memory is linear in the number of targets, and
/// the result does not depend on the number of threads. A target at a source gets its value. paper:
/// one interpolant through all sources; throws BadInput if they are too many for a dense system.
/// None if stopped by the watch.
std::optional<Interpolated> interpolate(const Sources& from, const Values& value, const Targets& to,
                                        const scene::Transfer& settings, const Work& work);

}  // namespace breach::transfer
