#include "transfer_tool/rbf.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>
#include <utility>

#include "transfer_tool/dense_system.hpp"

namespace breach::transfer {
namespace {

constexpr double coincident = 1e-9;  // over the extent of the centres
constexpr double flat = 1e-6;        // ratio of the spreads across and along a line
// In spreads from the middle. Elements in two rows reach 2. One row of single Gauss points, bent by
// the failure, reaches hundreds: the slope across it is due to the bend.
constexpr double farthest_across = 8.0;

double phi(const Vec2& a, const Vec2& b, double epsilon) {
    return std::sqrt((a - b).squaredNorm() + epsilon * epsilon);
}

std::pair<Vec2, Vec2> bounds(std::span<const Vec2> position) {
    Vec2 low = position.front();
    Vec2 high = position.front();
    for (const Vec2& x : position) {
        low = low.cwiseMin(x);
        high = high.cwiseMax(x);
    }
    return {low, high};
}

}  // namespace

Centres merge_coincident(const std::vector<Vec2>& position, const Values& value) {
    const auto [low, high] = bounds(position);
    const double reach = coincident * (high - low).norm();
    Centres centres{{}, Values(value.rows(), value.cols()), 0};
    std::vector<double> members;
    for (std::size_t i = 0; i < position.size(); ++i) {
        std::size_t k = 0;
        while (k < centres.position.size() && (centres.position[k] - position[i]).norm() > reach)
            ++k;
        const auto from = value.row(static_cast<Eigen::Index>(i));
        auto to = centres.value.row(static_cast<Eigen::Index>(k));
        if (k == centres.position.size()) {
            centres.position.push_back(position[i]);
            members.push_back(1.0);
            to = from;
        } else {
            members[k] += 1.0;
            to += (from - to) / members[k];
            ++centres.merged;
        }
    }
    centres.value.conservativeResize(static_cast<Eigen::Index>(centres.position.size()),
                                     value.cols());
    return centres;
}

double average_distance(std::span<const Vec2> position) {
    const auto [low, high] = bounds(position);
    const Vec2 edge = high - low;
    const auto N = static_cast<double>(position.size());
    // The shape parameter epsilon follows the density of the centres, so that no user has to give
    // it.
    if (edge.minCoeff() > 0.0) return std::sqrt(edge.x() * edge.y() / N);
    if (edge.maxCoeff() > 0.0) return edge.maxCoeff() / N;
    return 1.0;  // a single centre: any length
}

LocalInterpolant::LocalInterpolant(const Centres& centres, std::span<const Vec2> wanted) {
    normalise(centres.position, wanted);
    for (const Vec2& x : centres.position) centre_.push_back(normalised(x));
    epsilon_ = average_distance(centre_);

    const auto k = static_cast<Eigen::Index>(centre_.size());
    const Eigen::Index t = 1 + directions_;
    Eigen::MatrixXd P(k, t);
    P.col(0).setOnes();
    for (Eigen::Index i = 0; i < k; ++i)
        P.row(i).tail(directions_) = centre_[i].head(directions_).transpose();
    // Subtracts the best linear field first: the rest is small for nearly linear fields, and so is
    // the round-off of the system.
    const Eigen::MatrixXd linear = P.householderQr().solve(centres.value);
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(k + t, k + t);
    for (Eigen::Index i = 0; i < k; ++i)
        for (Eigen::Index j = 0; j <= i; ++j)
            system(i, j) = system(j, i) = phi(centre_[i], centre_[j], epsilon_);
    system.topRightCorner(k, t) = P;
    system.bottomLeftCorner(t, k) = P.transpose();
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(k + t, centres.value.cols());
    right.topRows(k) = centres.value - P * linear;
    coefficient_ = system.partialPivLu().solve(right);
    coefficient_.bottomRows(t) += linear;
}

void LocalInterpolant::normalise(const std::vector<Vec2>& position, std::span<const Vec2> wanted) {
    const auto k = static_cast<double>(position.size());
    for (const Vec2& x : position) middle_ += x / k;
    Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
    for (const Vec2& x : position) scatter += (x - middle_) * (x - middle_).transpose() / k;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> spread(scatter);
    const double along = std::sqrt(std::max(0.0, spread.eigenvalues()[1]));
    const double across = std::sqrt(std::max(0.0, spread.eigenvalues()[0]));
    // All centres at one place: no direction, and the field is constant.
    if (along == 0.0) return;
    axes_.col(0) = spread.eigenvectors().col(1) / along;
    directions_ = 1;
    if (across <= flat * along) return;
    const Vec2 beside = spread.eigenvectors().col(0) / across;
    for (const Vec2& place : wanted)
        if (std::abs(beside.dot(place - middle_)) > farthest_across) return;
    axes_.col(1) = beside;
    directions_ = 2;
}

Vec2 LocalInterpolant::normalised(const Vec2& place) const {
    return axes_.transpose() * (place - middle_);
}

void LocalInterpolant::at(const Vec2& place, Eigen::Ref<Eigen::RowVectorXd> value) const {
    const auto k = static_cast<Eigen::Index>(centre_.size());
    const Vec2 x = normalised(place);
    value = coefficient_.row(k);
    for (int d = 0; d < directions_; ++d) value += x[d] * coefficient_.row(k + 1 + d);
    for (Eigen::Index i = 0; i < k; ++i)
        value += phi(x, centre_[i], epsilon_) * coefficient_.row(i);
}

GlobalInterpolant::GlobalInterpolant(Centres centres)
    : centre_(std::move(centres.position)),
      epsilon_(average_distance(centre_)),
      mean_(centres.value.colwise().mean()),
      coefficient_(centres.value.rowwise() - mean_) {}

Eigen::MatrixXd GlobalInterpolant::system() const {
    const auto N = static_cast<Eigen::Index>(centre_.size());
    Eigen::MatrixXd system(N, N);
    for (Eigen::Index j = 0; j < N; ++j)
        for (Eigen::Index i = 0; i < N; ++i) system(i, j) = phi(centre_[i], centre_[j], epsilon_);
    return system;
}

std::optional<GlobalInterpolant> GlobalInterpolant::through(Centres centres, int threads,
                                                            const Watch& watch) {
    GlobalInterpolant interpolant(std::move(centres));
    Eigen::MatrixXd system = interpolant.system();
    if (solve_in_place(system, interpolant.coefficient_, threads, watch) == Solved::stopped)
        return std::nullopt;
    return interpolant;
}

void GlobalInterpolant::at(const Vec2& place, Eigen::Ref<Eigen::RowVectorXd> value) const {
    value = mean_;
    for (Eigen::Index i = 0; i < coefficient_.rows(); ++i)
        value += phi(place, centre_[i], epsilon_) * coefficient_.row(i);
}

}  // namespace breach::transfer
