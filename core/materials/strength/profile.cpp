#include "core/materials/strength/profile.hpp"

#include <algorithm>
#include <cmath>

#include "core/mechanics/atmosphere.hpp"

namespace breach::materials {

namespace {

double coordinate(Along along, const Place& place) {
    switch (along) {
        case Along::depth:
            return place.depth;
        case Along::elevation:
            return place.elevation;
        case Along::sigma_v0:
            break;
    }
    return place.sigma_v0;
}

struct AtPlace {
    const Place& place;

    double operator()(const Effective& kind) const { return kind.c; }
    double operator()(const Undrained& kind) const {
        double s_u = kind.constant + kind.per_metre * place.depth;
        if (kind.coefficient > 0.0)
            s_u += kind.coefficient *
                   std::pow(std::max(place.sigma_v0, 0.0) / mechanics::standard_atmosphere,
                            kind.exponent);
        return s_u;
    }
    double operator()(const Table& kind) const { return kind.at(place); }
    double operator()(const BySounding& kind) const {
        return residual_strength(kind.relation, kind.sounding.at(place), place.sigma_v0);
    }
};

}  // namespace

double Table::at(const Place& place) const {
    const double x = coordinate(along, place);
    const auto next = std::find_if(points.begin(), points.end(),
                                   [&](const std::array<double, 2>& each) { return each[0] > x; });
    if (next == points.begin()) return points.front()[1];
    if (next == points.end()) return points.back()[1];
    const auto& [x0, y0] = *std::prev(next);
    const auto& [x1, y1] = *next;
    return y0 + (y1 - y0) * (x - x0) / (x1 - x0);
}

Strength strength_at(const StrengthCurve& curve, const Place& place) {
    const double c = std::visit(AtPlace{place}, curve.kind);
    const auto* effective = std::get_if<Effective>(&curve.kind);
    return {curve.factor * std::max(c, curve.least),
            effective != nullptr ? std::tan(effective->phi) : 0.0};
}

bool is_uniform(const StrengthCurve& curve) {
    if (std::holds_alternative<Effective>(curve.kind)) return true;
    if (const auto* form = std::get_if<Undrained>(&curve.kind))
        return form->per_metre == 0.0 && form->coefficient == 0.0;
    if (const auto* table = std::get_if<Table>(&curve.kind)) return table->points.size() == 1;
    return false;
}

PointStrength strength_of_point(const StrengthProfile& profile, const Place& place,
                                Liquefaction liquefaction) {
    const Strength peak = strength_at(profile.peak, place);
    const Strength residual = profile.residual ? strength_at(*profile.residual, place) : peak;
    const Strength& first = liquefaction == Liquefaction::liquefied ? residual : peak;
    const Strength& last = profile.softening ? residual : first;
    return {first.c, first.tan_phi, last.c, last.tan_phi};
}

}  // namespace breach::materials
