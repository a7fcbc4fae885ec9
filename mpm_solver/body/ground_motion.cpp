#include "mpm_solver/body/ground_motion.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace breach::mpm {

GroundMotion::GroundMotion(exchange::BaseMotion base, double transfer_time)
    : base_(std::move(base)), transfer_time_(transfer_time) {}

double GroundMotion::velocity(double t) const {
    const std::vector<double>& v = base_.velocity;
    const double place = (transfer_time_ + t) / base_.time_step;
    if (place <= 0.0) return v.front();
    if (place >= static_cast<double>(v.size() - 1)) return v.back();
    const auto k = static_cast<std::size_t>(place);
    return v[k] + (place - static_cast<double>(k)) * (v[k + 1] - v[k]);
}

double GroundMotion::acceleration(double t, double dt) const {
    // Not the record's acceleration at t: only the difference makes the impulses of all steps add
    // up to the change of the ground's velocity.
    return (velocity(t + dt) - velocity(t)) / dt;
}

double GroundMotion::displacement(double t) const {
    // Trapezoids between samples, and one to `until`: exact for a velocity that is linear in
    // between.
    const double until = transfer_time_ + t;
    const auto at = [&](double time) { return velocity(time - transfer_time_); };
    double sum = 0.0, from = 0.0;
    for (std::size_t k = 1; k < base_.velocity.size(); ++k) {
        const double to = static_cast<double>(k) * base_.time_step;
        if (to >= until) break;
        sum += 0.5 * (to - from) * (at(from) + at(to));
        from = to;
    }
    return sum + 0.5 * (until - from) * (at(from) + at(until));
}

double GroundMotion::end() const {
    return static_cast<double>(base_.velocity.size() - 1) * base_.time_step - transfer_time_;
}

double GroundMotion::peak_acceleration() const {
    double peak = 0.0;
    for (std::size_t k = first_sample(); k + 1 < base_.velocity.size(); ++k) {
        peak = std::max(peak, std::abs(base_.velocity[k + 1] - base_.velocity[k]));
    }
    return peak / base_.time_step;
}

double GroundMotion::largest_swing() const {
    const double start = velocity(0.0);
    double swing = 0.0;
    for (std::size_t k = first_sample(); k < base_.velocity.size(); ++k) {
        swing = std::max(swing, std::abs(base_.velocity[k] - start));
    }
    return swing;
}

std::size_t GroundMotion::first_sample() const {
    return static_cast<std::size_t>(std::max(std::ceil(transfer_time_ / base_.time_step), 0.0));
}

}  // namespace breach::mpm
