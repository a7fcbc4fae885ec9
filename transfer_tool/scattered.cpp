#include "transfer_tool/scattered.hpp"

#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>
#include <nanoflann.hpp>
#include <span>

#include "core/fault/fault.hpp"
#include "core/numerics/blocks.hpp"

namespace breach::transfer {
namespace {

constexpr std::size_t largest_dense_system = 16384;  // 2 GiB of coefficients
constexpr std::size_t groups_between_looks = 64;

/// The sources of one region, in nanoflann's interface.
struct Cloud {
    std::vector<std::size_t> member;
    const std::vector<Vec2>* places;

    std::size_t kdtree_get_point_count() const { return member.size(); }
    double kdtree_get_pt(std::size_t i, std::size_t direction) const {
        return (*places)[member[i]][static_cast<Eigen::Index>(direction)];
    }
    template <typename Box>
    bool kdtree_get_bbox(Box&) const {
        return false;
    }
};

class Neighbourhoods {
  public:
    Neighbourhoods(const Sources& from, std::size_t wanted)
        : clouds_(from.regions), wanted_(wanted) {
        for (Cloud& cloud : clouds_) cloud.places = &from.place;
        for (std::size_t i = 0; i < from.place.size(); ++i)
            clouds_[from.region[i]].member.push_back(i);
        for (const Cloud& cloud : clouds_) trees_.push_back(std::make_unique<Tree>(2, cloud));
    }

    /// Numbers of the sources of `region` nearest to `place`, ascending.
    std::vector<std::size_t> nearest(std::size_t region, const Vec2& place) const {
        std::vector<std::size_t> found(std::min(wanted_, clouds_[region].member.size()));
        std::vector<double> distance(found.size());
        found.resize(
            trees_[region]->knnSearch(place.data(), found.size(), found.data(), distance.data()));
        for (std::size_t& i : found) i = clouds_[region].member[i];
        // The tree finds them in the order of its search; sums over sources need a fixed one.
        std::ranges::sort(found);
        return found;
    }

  private:
    using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>,
                                                     Cloud, 2, std::size_t>;
    std::vector<Cloud> clouds_;
    std::size_t wanted_;
    std::vector<std::unique_ptr<Tree>> trees_;
};

struct Task {
    const Sources& from;
    const Values& value;
    const Targets& to;
};

LocalInterpolant interpolant_of(const Task& task, const Neighbourhoods& neighbourhoods,
                                std::size_t group, GaussFieldReport& report) {
    const std::vector<std::size_t> near =
        neighbourhoods.nearest(task.to.region[group], task.to.middle[group]);
    std::vector<Vec2> where;
    Values value(static_cast<Eigen::Index>(near.size()), task.value.cols());
    for (const std::size_t i : near) {
        value.row(static_cast<Eigen::Index>(where.size())) =
            task.value.row(static_cast<Eigen::Index>(i));
        where.push_back(task.from.place[i]);
    }
    const Centres centres = merge_coincident(where, value);
    report.merged_centres += centres.merged;
    report.smallest_neighbourhood =
        std::min(report.smallest_neighbourhood, centres.position.size());
    const std::size_t first = task.to.first[group], end = task.to.first[group + 1];
    return LocalInterpolant(centres, std::span(task.to.place).subspan(first, end - first));
}

void carry_group(const Task& task, const Neighbourhoods& neighbourhoods, std::size_t group,
                 Values& to, GaussFieldReport& report) {
    std::optional<LocalInterpolant> interpolant;
    for (std::size_t p = task.to.first[group]; p < task.to.first[group + 1]; ++p) {
        auto value = to.row(static_cast<Eigen::Index>(p));
        if (task.to.same[p] >= 0) {
            value = task.value.row(task.to.same[p]);
            continue;
        }
        // One system per element and not per point; none where all points lie on Gauss points.
        if (!interpolant) interpolant.emplace(interpolant_of(task, neighbourhoods, group, report));
        interpolant->at(task.to.place[p], value);
    }
}

std::optional<Interpolated> interpolate_locally(const Task& task, std::size_t neighbours,
                                                const Work& work) {
    const Neighbourhoods neighbourhoods(task.from, neighbours);
    const GaussFieldReport none{.smallest_neighbourhood = task.from.place.size()};
    Interpolated result{Values(static_cast<Eigen::Index>(task.to.place.size()), task.value.cols()),
                        none};
    std::mutex reporting;
    std::atomic<bool> stopped = false;
    numerics::run_parts(
        task.to.region.size(), work.threads,
        [&](std::size_t begin, std::size_t end, std::size_t thread) {
            GaussFieldReport own = none;
            for (std::size_t g = begin; g < end && !stopped; ++g) {
                const double done =
                    static_cast<double>(g - begin) / static_cast<double>(end - begin);
                // From the first thread alone, as Watch promises; the others see `stopped`.
                if (thread == 0 && g % groups_between_looks == 0 && !work.watch.go_on(done))
                    stopped = true;
                carry_group(task, neighbourhoods, g, result.value, own);
            }
            const std::lock_guard lock(reporting);
            result.report.merged_centres += own.merged_centres;
            result.report.smallest_neighbourhood =
                std::min(result.report.smallest_neighbourhood, own.smallest_neighbourhood);
        });
    if (stopped) return std::nullopt;
    return result;
}

void refuse_too_many(std::size_t centres) {
    if (centres <= largest_dense_system) return;
    throw fault::BadInput("scene",
                          {{"/transfer/interpolation",
                            "\"paper\" solves one dense system of all " + std::to_string(centres) +
                                " points (at most " + std::to_string(largest_dense_system) + ")",
                            "use \"local\""}});
}

std::optional<Interpolated> interpolate_globally(const Task& task, const Work& work) {
    // Before anything of that size is allocated.
    refuse_too_many(task.from.place.size());
    Centres centres = merge_coincident(task.from.place, task.value);
    Interpolated result{
        Values(static_cast<Eigen::Index>(task.to.place.size()), task.value.cols()),
        {.merged_centres = centres.merged, .smallest_neighbourhood = centres.position.size()}};
    const auto interpolant =
        GlobalInterpolant::through(std::move(centres), work.threads, work.watch);
    if (!interpolant) return std::nullopt;
    numerics::run_parts(
        task.to.place.size(), work.threads, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t p = begin; p < end; ++p)
                interpolant->at(task.to.place[p], result.value.row(static_cast<Eigen::Index>(p)));
        });
    return result;
}

}  // namespace

std::optional<Interpolated> interpolate(const Sources& from, const Values& value, const Targets& to,
                                        const scene::Transfer& settings, const Work& work) {
    const Task task{from, value, to};
    if (settings.interpolation == scene::Interpolation::paper)
        return interpolate_globally(task, work);
    return interpolate_locally(task, static_cast<std::size_t>(settings.neighbours), work);
}

}  // namespace breach::transfer
