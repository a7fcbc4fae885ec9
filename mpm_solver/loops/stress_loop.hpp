// Stress update of a zone. Compiled once per instruction set.
// The order in update_stress (step.cpp): dissipate with the viscosity that the force had, stress
// with the law, settle with the finished cell averages. Velocity gradients are those of the end of
// the step (update stress last).
#pragma once

#include "mpm_solver/loops/loop_blocks.hpp"
#include "mpm_solver/loops/turn.hpp"

namespace breach::mpm {

/// A value of each point's cell.
template <int N>
[[gnu::always_inline]] inline Lanes<N> of_cells(const CellSum* cells, const std::int32_t* cell,
                                                double CellSum::*number) {
    Lanes<N> a;
    for (int k = 0; k < N; ++k) a.v[k] = cells[cell[k]].*number;
    return a;
}

/// sqrt(2/3 e:e) of a strain [-].
template <class Real>
[[gnu::always_inline]] inline Real equivalent(const Real& xx, const Real& yy, const Real& zz,
                                              const Real& gamma_xy) {
    const Real mean = (xx + yy + zz) * Real(1.0 / 3.0);
    const Real e_xx = xx - mean;
    const Real e_yy = yy - mean;
    const Real e_zz = zz - mean;
    const Real e_e = e_xx * e_xx + e_yy * e_yy + e_zz * e_zz + Real(0.5) * gamma_xy * gamma_xy;
    return materials::lanes::root(Real(2.0 / 3.0) * e_e);
}

/// Dissipation by viscosity and damping, sum of V 2 eta dev D : dev D dt [J].
template <class Isa>
void dissipate(const ZoneWork& work, Span span, Totals& sums) {
    using Real = Lanes<Isa::lanes>;
    Real V_eta_D_D(0.0);
    for_each_block<Isa>(
        work.points, span, [&](const Block& block) __attribute__((always_inline)) {
            const auto& [a, p, first, count] = block;
            const Real Lxx = load<Real>(a.Lxx + p);
            const Real Lyy = load<Real>(a.Lyy + p);
            const Real mean = (Lxx + Lyy) * Real(1.0 / 3.0);
            const Real xx = Lxx - mean;
            const Real yy = Lyy - mean;
            const Real shear = load<Real>(a.Lxy + p) + load<Real>(a.Lyx + p);
            const Real D_D = xx * xx + yy * yy + mean * mean + Real(0.5) * shear * shear;
            V_eta_D_D = V_eta_D_D +
                        materials::lanes::select(own_lanes<Real>(block),
                                                 load<Real>(a.V + p) * load<Real>(a.eta + p) * D_D,
                                                 Real(0.0));
        });
    sums.viscous += 2.0 * work.dt * sum_of(V_eta_D_D);
}

/// Strain of a block in the step, for its law.
template <class Real>
struct Increment {
    materials::StressOf<Real> trial;  ///< rotated with the soil, then strained elastically
    Real d_epsilon_q;                 ///< of the total strain [-]
    Real sigma_m;                     ///< before the step [Pa]
    Real hidden;                      ///< compression added by the overlap correction [-]
    Real gap;                         ///< volumetric strain still open [-]
    materials::MaskOf<Real> opens;    ///< may open further
};

/// Computes the increments from the velocity gradients; updates volume and total strain, which do
/// not depend on the law.
template <class Isa, Averages averages, Overlap overlap, VolumeRule volume_rule>
class Increments {
    static constexpr int N = Isa::lanes;
    using Real = Lanes<N>;

  public:
    [[gnu::always_inline]] explicit Increments(const ZoneWork& work)
        : work_(work),
          dt_(work.dt),
          lambda_(work.moduli.lambda),
          G_(work.moduli.G),
          two_G_(2.0 * work.moduli.G) {}

    [[gnu::always_inline]] Increment<Real> of(const Block& block) const {
        using namespace materials::lanes;
        const auto& [a, p, first, count] = block;
        const Real none(0.0);
        const Real third(1.0 / 3.0);
        const Real Lxx = load<Real>(a.Lxx + p);
        const Real Lyy = load<Real>(a.Lyy + p);
        const Real Lxy = load<Real>(a.Lxy + p);
        const Real Lyx = load<Real>(a.Lyx + p);
        const Real sxx = load<Real>(a.sxx + p);
        const Real syy = load<Real>(a.syy + p);
        const Real szz = load<Real>(a.szz + p);
        Increment<Real> made;
        made.sigma_m = (sxx + syy + szz) * third;
        made.hidden = none;
        Real d_epsilon_v = (Lxx + Lyy) * dt_;
        if constexpr (averages == Averages::per_cell) {
            // Only the volume is averaged: the shape changes by each point's own gradient (`shift`
            // below).
            d_epsilon_v = of_cells<N>(work_.cells, a.cell + p, &CellSum::trD) * dt_;
        }
        // Additional compression for the law only, not for the point's volume.
        if constexpr (overlap == Overlap::corrected) {
            made.hidden = Real(work_.overlap_rate) * load<Real>(a.excess + p) * dt_;
            d_epsilon_v = d_epsilon_v - made.hidden;
        }
        const Real volume = load<Real>(a.volume + p);
        const Real grown = volume * (Real(1.0) + d_epsilon_v);
        // Compression first closes the volumetric strain opened in tension; the law gets the rest.
        made.gap = none;
        made.opens = none < none;
        if constexpr (volume_rule == VolumeRule::tracked) {
            store(a.volume + p, grown);
        } else {
            made.opens = volume < Real(work_.widest);
            store(a.volume + p, select(made.opens, grown, smaller(grown, volume)));
            const Real gap = load<Real>(a.gap + p);
            // Debris whose grains come together is compressed only after its cracks are closed.
            const Real closing = smaller(positive(-d_epsilon_v), gap);
            made.gap = gap - closing;
            d_epsilon_v = d_epsilon_v + closing;
        }
        const Real exx = Lxx * dt_;
        const Real eyy = Lyy * dt_;
        const Real shift = (d_epsilon_v - exx - eyy) * third;
        const Real gamma_xy = (Lxy + Lyx) * dt_;
        // The spin rotates the old stress first; the strain increment then acts on the rotated one.
        const InPlane<Real> old =
            turned<Real>({sxx, syy, load<Real>(a.sxy + p)}, Real(0.5) * (Lyx - Lxy) * dt_);
        const Real volumetric = lambda_ * d_epsilon_v;
        made.trial = {old.xx + volumetric + two_G_ * (exx + shift),
                      old.yy + volumetric + two_G_ * (eyy + shift),
                      szz + volumetric + two_G_ * shift, old.xy + G_ * gamma_xy};
        made.d_epsilon_q = equivalent(exx + shift, eyy + shift, shift, gamma_xy);
        store(a.epsilon_q + p, load<Real>(a.epsilon_q + p) + made.d_epsilon_q);
        return made;
    }

  private:
    const ZoneWork& work_;
    const Real dt_, lambda_, G_, two_G_;
};

/// The law's result, with the individual strengths of the points if they have them.
template <class Law, class Real, class InLoop>
[[gnu::always_inline]] inline materials::UpdateOf<Real> answer(InLoop& law, const Block& block,
                                                               const Increment<Real>& increment) {
    const auto& [a, p, first, count] = block;
    const Real epsilon_q = load<Real>(a.epsilon_q_plastic + p);
    if constexpr (requires { Law::strength_of; }) {
        return law.update(increment.trial, epsilon_q,
                          materials::StrengthOfPoint<Real>{
                              load<Real>(a.c + p), load<Real>(a.tan_phi + p),
                              load<Real>(a.c_residual + p), load<Real>(a.tan_phi_residual + p)});
    } else {
        return law.update(increment.trial, epsilon_q);
    }
}

/// Stores the results of the step.
template <class Law, VolumeRule volume_rule, class Real>
[[gnu::always_inline]] inline void keep(const Block& block, const Increment<Real>& increment,
                                        const materials::UpdateOf<Real>& update) {
    const auto& [a, p, first, count] = block;
    store(a.sxx + p, update.sigma.xx), store(a.syy + p, update.sigma.yy);
    store(a.szz + p, update.sigma.zz), store(a.sxy + p, update.sigma.xy);
    if constexpr (volume_rule == VolumeRule::from_stress) {
        const Real opened = materials::lanes::select(increment.opens, update.opened, Real(0.0));
        store(a.gap + p, increment.gap + opened);
    }
    if constexpr (Law::softens != materials::Softens::never) {
        // The law has used the strength at the start of the step: softening is explicit.
        const Real drives = Law::softens == materials::Softens::with_total_strain
                                ? increment.d_epsilon_q
                                : update.d_epsilon_q;
        store(a.epsilon_q_plastic + p, load<Real>(a.epsilon_q_plastic + p) + drives);
    }
}

/// Damping ends when the law returns a stress and is restored gradually while the soil is elastic:
/// flowing soil has only the law's dissipation.
template <class Real>
[[gnu::always_inline]] inline void damp(const Block& block, const ZoneWork& work,
                                        const materials::StressOf<Real>& trial,
                                        const materials::StressOf<Real>& sigma) {
    using materials::lanes::magnitude;
    const Real returned = magnitude(sigma.xx - trial.xx) + magnitude(sigma.yy - trial.yy) +
                          magnitude(sigma.zz - trial.zz) + magnitude(sigma.xy - trial.xy);
    double* const eta = block.arrays.eta + block.p;
    const Real least(work.eta);
    const Real now = load<Real>(eta);
    const Real next = now + Real(work.damping_return) * (least + Real(work.damping) - now);
    store(eta, materials::lanes::select(returned > Real(0.0), least, next));
}

/// Anti-locking: adds the block's mean stress to the sums of its cells.
template <int N>
[[gnu::always_inline]] inline void add_mean_stress(const Block& block, CellSum* cells,
                                                   const materials::StressOf<Lanes<N>>& sigma) {
    using Real = Lanes<N>;
    const auto& [a, p, first, count] = block;
    const Real V_sigma_m =
        load<Real>(a.V + p) * ((sigma.xx + sigma.yy + sigma.zz) * Real(1.0 / 3.0));
    for (int k = 0; k < count; ++k) cells[a.cell[p + k]].sigma_m += V_sigma_m.v[k];
}

/// Increment, law, storage; sums the dissipation.
template <class Isa, class Law, Averages averages, Overlap overlap, VolumeRule volume_rule>
void stress(const ZoneWork& work, Span span, Totals& sums) {
    using Real = Lanes<Isa::lanes>;
    const Increments<Isa, averages, overlap, volume_rule> increments(work);
    typename Law::template InLoop<Isa> law(static_cast<const Law*>(work.law)->numbers);
    Real plastic(0.0);
    Real pushed_in(0.0);
    for_each_block<Isa>(
        work.points, span, [&](const Block& block) __attribute__((always_inline)) {
            const auto& [a, p, first, count] = block;
            ask_ahead(block, {a.Lxx, a.Lxy, a.Lyx, a.Lyy, a.sxx, a.syy, a.szz, a.sxy, a.V, a.volume,
                              a.gap, a.epsilon_q});
            const Real V =
                materials::lanes::select(own_lanes<Real>(block), load<Real>(a.V + p), Real(0.0));
            const Increment<Real> increment = increments.of(block);
            const materials::UpdateOf<Real> update = answer<Law>(law, block, increment);
            keep<Law, volume_rule>(block, increment, update);
            if (work.damping > 0.0) damp(block, work, increment.trial, update.sigma);
            if constexpr (Law::yields) plastic = plastic + V * update.plastic_work;
            if constexpr (overlap == Overlap::corrected) {
                pushed_in = pushed_in - V * increment.sigma_m * increment.hidden;
            }
            if constexpr (averages == Averages::per_cell) {
                add_mean_stress<Isa::lanes>(block, work.cells, update.sigma);
            }
        });
    sums.plastic += sum_of(plastic);
    sums.pushed_in += sum_of(pushed_in);
}

/// Replaces the mean stress by its cell's average, then sets the volume in the force.
template <class Isa, Averages averages, VolumeRule volume_rule>
void settle(const ZoneWork& work, Span span, Totals& sums) {
    using namespace materials::lanes;
    constexpr int N = Isa::lanes;
    using Real = Lanes<N>;
    const Real third(1.0 / 3.0);
    const Real per_K(1.0 / work.moduli.K);
    Real largest(0.0);
    for_each_block<Isa>(
        work.points, span, [&](const Block& block) __attribute__((always_inline)) {
            const auto& [a, p, first, count] = block;
            ask_ahead(block, {a.sxx, a.syy, a.szz, a.V_0, a.V, a.m});
            Real sigma_m(0.0);
            if constexpr (averages == Averages::per_cell ||
                          volume_rule == VolumeRule::from_stress) {
                const Real sxx = load<Real>(a.sxx + p);
                const Real syy = load<Real>(a.syy + p);
                const Real szz = load<Real>(a.szz + p);
                sigma_m = (sxx + syy + szz) * third;
                if constexpr (averages == Averages::per_cell) {
                    const Real average = of_cells<N>(work.cells, a.cell + p, &CellSum::sigma_m);
                    const Real shift = average - sigma_m;
                    store(a.sxx + p, sxx + shift);
                    store(a.syy + p, syy + shift);
                    store(a.szz + p, szz + shift);
                    sigma_m = average;
                }
            }
            const Real V = volume_rule == VolumeRule::from_stress
                               ? load<Real>(a.V_0 + p) * (Real(1.0) + sigma_m * per_K)
                               : load<Real>(a.volume + p);
            store(a.V + p, V);
            largest = larger(V / load<Real>(a.m + p), largest);
        });
    sums.largest_specific_volume = largest_of(larger(largest, Real(sums.largest_specific_volume)));
}

}  // namespace breach::mpm
