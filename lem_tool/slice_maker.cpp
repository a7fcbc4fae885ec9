// Loads and their arms are linear between a slice's sides, so that weights and moments have closed
// forms.
#include "lem_tool/slice_maker.hpp"

#include "lem_tool/snapshot_strength.hpp"

namespace breach::lem {

namespace {

/// Exact integral of a linear load (w0 to w1) times a linear arm (d0 to d1).
double moment(double dx, double w0, double w1, double d0, double d1) {
    return dx * ((w0 + w1) * (d0 + d1) / 4.0 + (w1 - w0) * (d1 - d0) / 12.0);
}

/// Adds a push to one slice.
void add_push(const scene::Circle& pivot, const WaterPush& push, std::size_t i, Slices& slices) {
    slices.push[i] += push.left;
    slices.driving[i] += push.left * (pivot.center.y() - push.level) / pivot.radius;
}

/// An end of the mass with the water in front of it.
struct EndFace {
    double foot;
    double head;
    double water;    ///< its level [m]
    double gamma_w;  ///< [N/m3]
};

EndFace face_of(const Strata& strata, const MassEnd& end, From outside) {
    const From inside = outside == From::left ? From::right : From::left;
    const std::size_t i = strip_at(strata, end.x);
    const bool on_border = end.x >= strata.strips[i].to && i + 1 < strata.strips.size();
    const Strip& within = strata.strips[on_border && inside == From::right ? i + 1 : i];
    const Strip& beyond = strata.strips[on_border && outside == From::right ? i + 1 : i];
    EndFace face{end.base, strata.ground(within).at(end.x), beyond.water.at(end.x), strata.gamma_w};
    if (end.kind == MassEnd::Kind::ground) return face;
    face.gamma_w = strata.crack.gamma_w;
    // A crack under free water is full.
    const bool drowned = strata.gamma_w > 0.0 && within.water.at(end.x) > face.head;
    face.water = drowned ? within.water.at(end.x)
                         : face.foot + strata.crack.filled * (face.head - face.foot);
    return face;
}

}  // namespace

void SliceMaker::add_slice(const Strip& strip, const Layer& layer, const Soil& soil, Base kind,
                           const Chord& ends) {
    const auto& [x0, y0, x1, y1] = ends;
    const double R = pivot_.radius;
    const double dx = x1 - x0;
    const double dy = y1 - y0;
    const double chord = std::sqrt(dx * dx + dy * dy);
    const double bend = kind == Base::arc ? chord * chord / (R * R) : 0.0;
    // Area between chord and arc: (theta - sin theta) R^2 / 2, to the next order in theta.
    const double segment = bend * chord * R * (1.0 / 12.0) * (1.0 + 0.075 * bend);
    const double w0 = layer.weight_above.at(x0) + layer.gamma * (layer.top.at(x0) - y0);
    const double w1 = layer.weight_above.at(x1) + layer.gamma * (layer.top.at(x1) - y1);
    const double d0 = x0 - pivot_.center.x();
    const double d1 = x1 - pivot_.center.x();
    const double middle = 0.5 * (x0 + x1);
    const std::size_t i = slices_.count++;
    const double soil_weight = 0.5 * dx * (w0 + w1) + layer.gamma * segment;
    slices_.left[i] = x0;
    slices_.width[i] = dx;
    slices_.base[i] = 0.5 * (y0 + y1);
    slices_.cos_a[i] = dx / chord;
    slices_.sin_a[i] = dy / chord;
    slices_.length[i] = chord * (1.0 + bend / 24.0);
    slices_.soil_weight[i] = soil_weight;
    slices_.weight[i] = soil_weight + strip.surcharge * dx;
    slices_.push[i] = 0.0;
    slices_.stands_on[i] = kind;
    slices_.driving[i] = (moment(dx, w0, w1, d0, d1) +
                          (layer.gamma * segment + strip.surcharge * dx) * 0.5 * (d0 + d1)) /
                         R;
    const double mid_height = 0.5 * (strata_.ground(strip).at(middle) + slices_.base[i]);
    slices_.shaking[i] = soil_weight * (pivot_.center.y() - mid_height) / R;
    double u = soil.line
                   ? strata_.pressures[strip.pressures + *soil.line].at(middle, slices_.base[i])
                   : 0.0;
    // r_u counts where the region's line gives no pressure.
    if (u == 0.0) u = soil.r_u * soil_weight / dx;
    slices_.u[i] = u;
    double turned_sideways = 0.0;
    if (strata_.gamma_w > 0.0) turned_sideways = add_free_water(strip, i, ends);
    slices_.lever[i] = 1.0;
    if (kind == Base::straight) {
        const double h = pivot_.center.y() - slices_.base[i];
        slices_.lever[i] = h * chord / (R * dx);
        // On a straight base Bishop's equation takes W h tan a (arc.hpp); the moment about the
        // centre is no part of it.
        slices_.driving[i] = slices_.weight[i] * h * dy / (dx * R);
    }
    slices_.driving[i] += turned_sideways;
    slices_.c[i] = soil.c;
    // After free water was added to the weight, which sigma'_v0 contains.
    if (soil.coefficient > 0.0) slices_.c[i] += undrained(strip, layer, soil, middle, i);
    if (soil.profile || soil.by_state) slices_.c[i] = by_place(strip, layer, soil, middle, i);
    slices_.tan_phi[i] = soil.tan_phi;
    if (soil.of_snapshot) take_snapshot(*soil.of_snapshot, middle, i);
    const double flat = slices_.length[i] * slices_.cos_a[i];
    slices_.force[i] =
        (slices_.c[i] * flat + (slices_.weight[i] - slices_.u[i] * flat) * slices_.tan_phi[i]) *
        slices_.lever[i];
}

/// Part of s_u that increases with the vertical effective stress below soil and free water.
double SliceMaker::undrained(const Strip& strip, const Layer& layer, const Soil& soil, double x,
                             std::size_t i) const {
    const double dx = slices_.width[i];
    const double sigma_v0 =
        // Without loads that came too late to consolidate the soil.
        slices_.weight[i] / dx - strip.surcharge - slices_.u[i] - layer.unconsolidated.at(x);
    return soil.coefficient * std::pow(std::max(0.0, sigma_v0) / p_a, soil.exponent);
}

/// s_u by the profile or by state, at the middle of the chord; with the quantities of
/// scene::Ground.
double SliceMaker::by_place(const Strip& strip, const Layer& layer, const Soil& soil, double x,
                            std::size_t i) const {
    const double y = slices_.base[i];
    const Line& ground = strata_.ground(strip);
    double weight = layer.weight_above.at(x) + layer.gamma * (layer.top.at(x) - y);
    double u = soil.line ? strata_.pressures[strip.pressures + *soil.line].at(x, y) : 0.0;
    if (u == 0.0) u = soil.r_u * weight;
    weight += strata_.gamma_w * std::max(0.0, strip.water.at(x) - ground.at(x));
    weight -= layer.unconsolidated.at(x);
    const materials::Place place{ground.at(x) - y, y, weight - u};
    return soil.factor * (soil.by_state ? (*soil.by_state)(place, u)
                                        : materials::strength_at(*soil.profile, place).c);
}

/// Excess pressure is at most the whole weight: what the FEM has above that is inertia.
void SliceMaker::take_snapshot(const SnapshotStrength& snapshot, double x, std::size_t i) {
    const SnapshotStrength::Place* found = snapshot.at({x, slices_.base[i]});
    if (!found) return;
    slices_.c[i] = found->c;
    slices_.tan_phi[i] = found->tan_phi;
    const double most = slices_.weight[i] / slices_.width[i];
    slices_.u[i] = std::max(slices_.u[i], std::min(slices_.u[i] + found->excess, most));
}

/// Adds the weight of free water and its thrust on the slope; returns the thrust's moment over R.
double SliceMaker::add_free_water(const Strip& strip, std::size_t i, const Chord& ends) {
    const double x0 = ends.x0;
    const double x1 = ends.x1;
    const double dx = x1 - x0;
    const Line& ground = strata_.ground(strip);
    const double p0 = strata_.gamma_w * std::max(0.0, strip.water.at(x0) - ground.at(x0));
    const double p1 = strata_.gamma_w * std::max(0.0, strip.water.at(x1) - ground.at(x1));
    if (p0 + p1 <= 0.0) return 0.0;
    const scene::Vec2& center = pivot_.center;
    const double R = pivot_.radius;
    slices_.weight[i] += 0.5 * dx * (p0 + p1);
    slices_.driving[i] += moment(dx, p0, p1, x0 - center.x(), x1 - center.x()) / R;
    // Pressure acts at right angles to the slope: its horizontal part is that of the inclination.
    slices_.push[i] = -ground.slope * 0.5 * dx * (p0 + p1);
    return ground.slope *
           moment(dx, p0, p1, ground.at(x0) - center.y(), ground.at(x1) - center.y()) / R;
}

void add_pushes(const Strata& strata, const scene::Circle& pivot, double left, double right,
                Slices& slices) {
    for (const WaterPush& push : strata.pushes) {
        if (push.x <= left || push.x >= right) continue;
        const auto end = slices.left.begin() + static_cast<std::ptrdiff_t>(slices.count);
        const auto next = std::upper_bound(slices.left.begin(), end, push.x);
        std::size_t i = static_cast<std::size_t>(next - slices.left.begin()) - 1;
        // Water acts on the soil behind the face, not on the slice in front of it.
        if (push.left > 0.0 && push.x <= slices.left[i] && i > 0) --i;
        add_push(pivot, push, i, slices);
    }
}

void add_end(const Strata& strata, const scene::Circle& pivot, const MassEnd& end, From outside,
             Slices& slices) {
    const EndFace face = face_of(strata, end, outside);
    if (face.gamma_w == 0.0 || face.head - face.foot <= 1e-9 * pivot.radius) return;
    const Thrust push = thrust(face.gamma_w, face.water, face.foot, face.head);
    add_push(pivot, {end.x, push.level, outside == From::left ? -push.force : push.force},
             outside == From::left ? 0 : slices.count - 1, slices);
}

}  // namespace breach::lem
