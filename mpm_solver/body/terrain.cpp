#include "mpm_solver/body/terrain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace breach::mpm {

namespace {

/// Length of the extrapolated first and last segments, longer than any grid [m].
constexpr double far_away = 1e6;

double distance_to(const Vec2& from, const Vec2& to, const Vec2& place) {
    return geometry::distance_to_segment(place, from, to);
}

/// Removes velocity into the plane and reduces sliding along it; returns the impulse of friction.
Vec2 press_on(const Vec2& normal, double mu, double m, Vec2& v) {
    const double into = -normal.dot(v);
    if (into <= 0.0) return Vec2::Zero();  // lifts off
    const Vec2 along{normal.y(), -normal.x()};
    const double free = along.dot(v);
    const double slides = std::copysign(std::max(std::abs(free) - mu * into, 0.0), free);
    v = slides * along;
    return m * (slides - free) * along;
}

/// By more than the round-off of the projection onto the other slope.
bool enters(const Vec2& normal, const Vec2& v) { return normal.dot(v) < -1e-12 * v.norm(); }

}  // namespace

Terrain::Terrain(const std::vector<Vec2>& profile) {
    for (std::size_t k = 0; k + 1 < profile.size(); ++k) {
        const Vec2 along = (profile[k + 1] - profile[k]).normalized();
        edges_.push_back({profile[k], profile[k + 1], {-along.y(), along.x()}});
    }
    Edge& first = edges_.front();
    Edge& last = edges_.back();
    first.from -= far_away * (first.to - first.from).normalized();
    last.to += far_away * (last.to - last.from).normalized();
}

std::pair<std::size_t, std::size_t> Terrain::beside(double x, double width) const {
    const auto first = std::partition_point(
        edges_.begin(), edges_.end(), [&](const Edge& edge) { return edge.to.x() < x - width; });
    const auto last = std::partition_point(
        first, edges_.end(), [&](const Edge& edge) { return edge.from.x() <= x + width; });
    return {first - edges_.begin(), last - edges_.begin()};
}

double Terrain::level(double x) const {
    const Edge& edge = edges_[beside(x, 0.0).first];
    return edge.from.y() +
           (edge.to.y() - edge.from.y()) * (x - edge.from.x()) / (edge.to.x() - edge.from.x());
}

/// Used per point by checks (refuse_buried_points, guard.cpp), hence the search among few segments.
double Terrain::distance(const Vec2& place) const {
    const double height = place.y() - level(place.x());
    // The nearest segment is at most as far as the ground straight below or above.
    const auto [first, last] = beside(place.x(), std::abs(height));
    double nearest = std::abs(height);
    for (std::size_t k = first; k < last; ++k) {
        nearest = std::min(nearest, distance_to(edges_[k].from, edges_[k].to, place));
    }
    return std::copysign(nearest, height);
}

bool Terrain::near(const Vec2& place, double reach) const {
    const auto [first, last] = beside(place.x(), reach);
    for (std::size_t k = first; k < last; ++k) {
        if (distance_to(edges_[k].from, edges_[k].to, place) <= reach) return true;
    }
    return false;
}

Vec2 Terrain::ridge_normal(const Vec2& node, double nearest, double reach) const {
    const auto [first, last] = beside(node.x(), nearest + reach);
    Vec2 sum = Vec2::Zero();
    for (std::size_t k = first; k < last; ++k) {
        const double d = distance_to(edges_[k].from, edges_[k].to, node);
        sum += std::max(1.0 - (d - nearest) / reach, 0.0) * edges_[k].normal;
    }
    return sum.normalized();
}

std::optional<Contact> Terrain::contact(const Vec2& node, double reach, double friction) const {
    if (node.y() > level(node.x()) && !near(node, reach)) return std::nullopt;
    const double nearest = std::abs(distance(node));
    // A node deep below the ground is beyond reach of all segments: it feels the nearest.
    const double felt = std::max(reach, nearest * (1.0 + 1e-9));
    const auto [from, to] = beside(node.x(), felt);
    const Edge* left = nullptr;
    const Edge* right = nullptr;
    for (std::size_t k = from; k < to; ++k) {
        if (distance_to(edges_[k].from, edges_[k].to, node) > felt) continue;
        if (!left) left = &edges_[k];
        right = &edges_[k];
    }
    // Normals that lean towards each other.
    const bool is_valley = left->normal.x() > right->normal.x() + 1e-12;
    if (is_valley) return Contact{left->normal, right->normal, friction};
    return Contact{ridge_normal(node, nearest, reach), std::nullopt, friction};
}

double rub(const Contact& contact, double m, const Vec2& v_before, Vec2& v) {
    Vec2 impulse = press_on(contact.normal, contact.friction, m, v);
    if (contact.second) {
        impulse += press_on(*contact.second, contact.friction, m, v);
        // Pressed into both slopes: the node stays in the corner.
        if (enters(contact.normal, v)) v.setZero();
    }
    return -0.5 * impulse.dot(v_before + v);
}

}  // namespace breach::mpm
