// Radial basis functions: interpolates scattered values with the multiquadric phi(r) = sqrt(r^2 +
// epsilon^2).
// One system serves all fields, as columns of its right side; scattered.hpp chooses the centres.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "core/mechanics/tensor.hpp"
#include "transfer_tool/watch.hpp"

namespace breach::transfer {

using mechanics::Vec2;
/// One row per place, one column per field.
using Values = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Scattered values at distinct places.
struct Centres {
    std::vector<Vec2> position;  ///< [m]
    Values value;
    std::size_t merged = 0;  ///< number of coincident centres removed
};
/// Merges places closer than 1e-9 of the extent, with the mean of their values. Compares all pairs.
/// Two centres at one place would make the system singular.
Centres merge_coincident(const std::vector<Vec2>& position, const Values& value);

/// sqrt(bounding-box area / N) [m]; on a line, its length / N (Sordo et al. 2024, in their
/// reference code).
double average_distance(std::span<const Vec2> position);

/// Interpolant through a few centres: multiquadric plus linear tail, exact for constant and linear
/// fields. Distances are scaled by the centres' spread along their principal directions, so that an
/// aspect ratio of 1:100 is as well conditioned as a square mesh. If the centres are on a line, or
/// so near to one that `wanted` places are many spreads away from it, the field is linear along the
/// line and constant across. One centre gives its value.
class LocalInterpolant {
  public:
    /// Needs at least one centre.
    explicit LocalInterpolant(const Centres& centres, std::span<const Vec2> wanted = {});
    /// Writes one value per field.
    void at(const Vec2& place, Eigen::Ref<Eigen::RowVectorXd> value) const;

  private:
    void normalise(const std::vector<Vec2>& position, std::span<const Vec2> wanted);
    Vec2 normalised(const Vec2& place) const;

    Vec2 middle_ = Vec2::Zero();
    /// Columns: principal directions over the spread [1/m].
    Eigen::Matrix2d axes_ = Eigen::Matrix2d::Zero();
    int directions_ = 0;           ///< number of directions with spread
    std::vector<Vec2> centre_;     ///< normalised [-]
    double epsilon_ = 1.0;         ///< [-]
    Eigen::MatrixXd coefficient_;  ///< multiquadrics, then constant, then slopes
};

/// One interpolant through all centres, without tail, about the mean of the values so that a
/// constant stays constant. Dense: N^2 memory, N^3 time. Departs from: Sordo et al. 2024, who do
/// not subtract the mean.
class GlobalInterpolant {
  public:
    /// None if stopped by the watch.
    static std::optional<GlobalInterpolant> through(Centres centres, int threads = 1,
                                                    const Watch& watch = {});
    void at(const Vec2& place, Eigen::Ref<Eigen::RowVectorXd> value) const;

  private:
    explicit GlobalInterpolant(Centres centres);
    Eigen::MatrixXd system() const;

    std::vector<Vec2> centre_;
    double epsilon_;
    Eigen::RowVectorXd mean_;
    Eigen::MatrixXd coefficient_;
};

}  // namespace breach::transfer
