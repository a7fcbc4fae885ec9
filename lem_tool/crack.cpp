// Coarse searches find the share of the crack, a whole one its surface.
#include "lem_tool/crack.hpp"

#include <cmath>
#include <limits>

#include "lem_tool/slip_circle.hpp"

namespace breach::lem {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

double factor_of(const SearchResult& found) {
    return found.critical ? found.critical->bishop.factor_of_safety : infinite;
}

/// Minimum of a unimodal function in [0, 1] to 0.02 (golden section).
double bottom_of(const std::function<double(double)>& f) {
    constexpr double golden = 0.6180339887498949;
    double low = 0.0, high = 1.0;
    double left = high - golden * (high - low), right = low + golden * (high - low);
    double at_left = f(left), at_right = f(right);
    while (high - low > 0.02) {
        if (at_left < at_right) {
            high = right;
            right = left;
            at_right = at_left;
            left = high - golden * (high - low);
            at_left = f(left);
        } else {
            low = left;
            left = right;
            at_left = at_right;
            right = low + golden * (high - low);
            at_right = f(right);
        }
    }
    return at_left < at_right ? left : right;
}

}  // namespace

double Searched::factor() const { return factor_of(found); }

Searched with_worst_crack(const Model& model, const std::vector<scene::Vec2>& floor,
                          const std::function<SearchResult(const Model&, Effort)>& look) {
    Searched best{model, look(model, Effort::whole), floor, 0.0};
    best.factor_with_whole_crack = best.factor();
    if (model.strata.crack.reach == Crack::Reach::none) return best;
    Model other = model;
    const auto coarse = [&](double share) {
        other.strata.crack.share = share;
        return factor_of(look(other, Effort::coarse));
    };
    const auto consider = [&](double share) {
        other.strata.crack.share = share;
        SearchResult found = look(other, Effort::whole);
        if (factor_of(found) >= best.factor()) return;
        best.model.strata.crack.share = share;
        best.found = std::move(found);
    };
    // Unimodal: the factor decreases while the crack removes tension, and increases below it.
    const double whole = coarse(1.0);
    // A shallower crack is searched only where it lowers the factor: the whole depth is the usual
    // answer.
    if (whole == infinite || coarse(0.9) < whole) consider(bottom_of(coarse));
    // Without a crack, too: the golden section ends near 0 and never at it.
    consider(0.0);
    return best;
}

double tension_zone(const Model& model, const Surface& surface) {
    Slices slices = make_slices(model.strata, model.slices);
    cut(model.strata, model.soils, surface, model.slices, slices);
    const std::size_t i = slide_of(slices) == Slide::to_right ? 0 : slices.count - 1;
    const double x = slices.left[i] + 0.5 * slices.width[i];
    const Strip& strip = model.strata.strips[strip_at(model.strata, x)];
    std::size_t layer = strip.first;
    while (layer + 1 < strip.last && model.strata.layers[layer + 1].top.at(x) > slices.base[i])
        ++layer;
    const double gamma = model.strata.layers[layer].gamma;
    // Of the slice at the upper end, with its undrained or liquefied strength.
    const double phi = std::atan(slices.tan_phi[i]);
    return 2.0 * slices.c[i] / gamma * std::tan(0.25 * M_PI + 0.5 * phi);
}

}  // namespace breach::lem
