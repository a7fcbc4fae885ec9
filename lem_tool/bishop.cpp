#include "lem_tool/bishop.hpp"

#include <algorithm>
#include <cmath>

namespace breach::lem {

namespace {

double sum_of_driving(const Slices& slices) {
    double sum = 0.0;
    for (std::size_t i = 0; i < slices.count; ++i) sum += slices.driving[i];
    return sum;
}

/// The resisting sum S(F) and its derivative.
struct Resistance {
    double sum;
    double slope;
};

Resistance resistance(const Slices& slices, double sense, double F) {
    Resistance total{0.0, 0.0};
    for (std::size_t i = 0; i < slices.count; ++i) {
        const double turn = sense * slices.sin_a[i] * slices.tan_phi[i] / F;
        const double inverse = 1.0 / (slices.cos_a[i] + turn);
        const double share = slices.force[i] * inverse;
        total.sum += share;
        total.slope += share * inverse * turn;
    }
    total.slope /= F;
    return total;
}

double smallest_m_alpha(const Slices& slices, double sense, double F) {
    double least = 1.0;
    for (std::size_t i = 0; i < slices.count; ++i) {
        if (slices.tan_phi[i] == 0.0) continue;
        least = std::min(least, slices.cos_a[i] + sense * slices.sin_a[i] * slices.tan_phi[i] / F);
    }
    return least;
}

/// Lower limit of F for which every m_alpha is positive.
double pole(const Slices& slices, double sense) {
    double largest = 0.0;
    for (std::size_t i = 0; i < slices.count; ++i) {
        largest = std::max(largest, -sense * slices.sin_a[i] * slices.tan_phi[i] / slices.cos_a[i]);
    }
    return largest;
}

}  // namespace

Slide slide_of(const Slices& slices) {
    return sum_of_driving(slices) >= 0.0 ? Slide::to_left : Slide::to_right;
}

Bishop bishop(const Slices& slices, Slide slide, double k_h) {
    const double sense = slide == Slide::to_left ? 1.0 : -1.0;
    double driving = sense * sum_of_driving(slices);
    for (std::size_t i = 0; k_h != 0.0 && i < slices.count; ++i) driving += k_h * slices.shaking[i];
    Bishop result{Balance::not_converged, 0.0, 1.0, 0};
    double scale = 0.0;
    for (std::size_t i = 0; i < slices.count; ++i) scale += std::abs(slices.driving[i]);
    // Without a driving moment F is infinite, and round-off would decide on its sign.
    if (!(driving > 1e-9 * scale)) return {Balance::no_driving_moment, 0.0, 1.0, 0};

    // F -> S(F)/F - driving decreases from +inf at the pole to -driving: one root, with positive
    // m_alpha.
    const double least = pole(slices, sense);
    double plain = 0.0;
    for (std::size_t i = 0; i < slices.count; ++i) {
        plain += slices.force[i];
    }
    if (plain <= 0.0) return {Balance::found, 0.0, 1.0, 0};  // no strength
    double F = std::max(plain / driving, 1.01 * least);
    for (result.iterations = 1; result.iterations <= 100; ++result.iterations) {
        const Resistance S = resistance(slices, sense, F);
        // Newton on F - S(F) / driving = 0
        double next = F - (F - S.sum / driving) / (1.0 - S.slope / driving);
        // Below the pole, another branch of the equation has roots that are no factors of safety.
        if (!(next > least)) next = 0.5 * (F + least);
        const double change = std::abs(next - F);
        F = next;
        if (change <= 1e-10 * F) {
            result.balance = Balance::found;
            break;
        }
    }
    result.factor_of_safety = F;
    result.m_alpha = smallest_m_alpha(slices, sense, F);
    // The factor is kept: a given circle is answered with it, a search refuses it.
    if (result.balance == Balance::found && result.m_alpha < least_m_alpha) {
        result.balance = Balance::small_m_alpha;
    }
    return result;
}

}  // namespace breach::lem
