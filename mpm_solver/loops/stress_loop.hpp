// Stress update of a zone. Compiled once per instruction set.
#pragma once

#include "mpm_solver/loops/loop_blocks.hpp"
#include "mpm_solver/loops/turn.hpp"

namespace breach::mpm {

/// A number of each point's cell.
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

constexpr materials::Softens softens_of(LawKind law) {
    switch (law) {
        case LawKind::softens_with_plastic_strain:
            return materials::Softens::with_plastic_strain;
        case LawKind::softens_with_total_strain:
            return materials::Softens::with_total_strain;
        default:
            return materials::Softens::never;
    }
}

/// Out of line: it is long, and whole blocks that stay elastic pass it by.
template <class Isa, materials::Softens softens>
[[gnu::noinline]] void return_block(
    const materials::MohrCoulombNumbers& law,
    const materials::mohr_coulomb_lanes::ConeOf<Lanes<Isa::lanes>>& cone,
    materials::UpdateOf<Lanes<Isa::lanes>>& update) {
    update = materials::return_from<softens>(law, cone, update.sigma);
}

/// Dissipation by viscosity, sum of V 2 eta dev D : dev D dt [J].
template <class Isa>
void dissipate(const ZoneWork& work, Span span, Totals& sums) {
    using Real = Lanes<Isa::lanes>;
    Real V_D_D(0.0);
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
            V_D_D = V_D_D + materials::lanes::select(own_lanes<Real>(block),
                                                     load<Real>(a.V + p) * D_D, Real(0.0));
        });
    sums.viscous += 2.0 * work.eta * work.dt * sum_of(V_D_D);
}

/// Strain increment, rotation and law; adds up what is dissipated.
template <class Isa, LawKind law, Averages averages, Overlap overlap, VolumeRule volume_rule>
void stress(const ZoneWork& work, Span span, Totals& sums) {
    using namespace materials::lanes;
    constexpr int N = Isa::lanes;
    using Real = Lanes<N>;
    constexpr materials::Softens softens = softens_of(law);
    const Real none(0.0);
    const Real third(1.0 / 3.0);
    const Real dt(work.dt);
    const materials::MohrCoulombNumbers numbers = work.law;
    const Real lambda(numbers.lambda);
    const Real G(numbers.G);
    const Real two_G(2.0 * numbers.G);
    auto cone = materials::mohr_coulomb_lanes::cone_at<materials::Softens::never>(numbers, none);
    Real plastic(0.0);
    Real pushed_in(0.0);
    for_each_block<Isa>(
        work.points, span, [&](const Block& block) __attribute__((always_inline)) {
            const auto& [a, p, first, count] = block;
            const auto own = own_lanes<Real>(block);
            const Real Lxx = load<Real>(a.Lxx + p);
            const Real Lyy = load<Real>(a.Lyy + p);
            const Real Lxy = load<Real>(a.Lxy + p);
            const Real Lyx = load<Real>(a.Lyx + p);
            const Real V = select(own, load<Real>(a.V + p), none);
            const Real sxx = load<Real>(a.sxx + p);
            const Real syy = load<Real>(a.syy + p);
            const Real szz = load<Real>(a.szz + p);
            Real d_epsilon_v = (Lxx + Lyy) * dt;
            if constexpr (averages == Averages::per_cell) {
                d_epsilon_v = of_cells<N>(work.cells, a.cell + p, &CellSum::trD) * dt;
            }
            // The law is told of a compression that the soil's points do not show.
            if constexpr (overlap == Overlap::corrected) {
                const Real hidden = Real(work.overlap_rate) * load<Real>(a.excess + p) * dt;
                d_epsilon_v = d_epsilon_v - hidden;
                pushed_in = pushed_in - V * ((sxx + syy + szz) * third) * hidden;
            }
            const Real volume = load<Real>(a.volume + p);
            const Real grown = volume * (Real(1.0) + d_epsilon_v);
            // Volume strain that the soil opened in tension closes first; the law gets what is
            // left.
            Real gap = none;
            [[maybe_unused]] auto opens = own;
            if constexpr (volume_rule == VolumeRule::tracked) {
                store(a.volume + p, grown);
            } else {
                opens = volume < Real(work.widest);
                store(a.volume + p, select(opens, grown, smaller(grown, volume)));
                gap = load<Real>(a.gap + p);
                const Real closing = smaller(positive(-d_epsilon_v), gap);
                gap = gap - closing;
                d_epsilon_v = d_epsilon_v + closing;
            }
            const Real exx = Lxx * dt;
            const Real eyy = Lyy * dt;
            const Real shift = (d_epsilon_v - exx - eyy) * third;
            const Real gamma_xy = (Lxy + Lyx) * dt;
            const InPlane<Real> old =
                turned<Real>({sxx, syy, load<Real>(a.sxy + p)}, Real(0.5) * (Lyx - Lxy) * dt);
            const Real volumetric = lambda * d_epsilon_v;
            const materials::StressOf<Real> trial{old.xx + volumetric + two_G * (exx + shift),
                                                  old.yy + volumetric + two_G * (eyy + shift),
                                                  szz + volumetric + two_G * shift,
                                                  old.xy + G * gamma_xy};
            const Real d_epsilon_q = equivalent(exx + shift, eyy + shift, shift, gamma_xy);
            store(a.epsilon_q + p, load<Real>(a.epsilon_q + p) + d_epsilon_q);
            if constexpr (law == LawKind::elastic) {
                store(a.sxx + p, trial.xx), store(a.syy + p, trial.yy);
                store(a.szz + p, trial.zz), store(a.sxy + p, trial.xy);
            } else {
                if constexpr (softens != materials::Softens::never) {
                    cone = materials::mohr_coulomb_lanes::cone_at<softens>(
                        numbers, load<Real>(a.epsilon_q_plastic + p));
                }
                materials::UpdateOf<Real> update = materials::elastic_update(trial);
                if (any(materials::lies_outside(cone, trial))) {
                    return_block<Isa, softens>(numbers, cone, update);
                }
                store(a.sxx + p, update.sigma.xx), store(a.syy + p, update.sigma.yy);
                store(a.szz + p, update.sigma.zz), store(a.sxy + p, update.sigma.xy);
                plastic = plastic + V * update.plastic_work;
                if constexpr (volume_rule == VolumeRule::from_stress) {
                    store(a.gap + p, gap + select(opens, update.opened, none));
                }
                if constexpr (softens != materials::Softens::never) {
                    const Real drives = softens == materials::Softens::with_total_strain
                                            ? d_epsilon_q
                                            : update.d_epsilon_q;
                    store(a.epsilon_q_plastic + p, load<Real>(a.epsilon_q_plastic + p) + drives);
                }
            }
            if constexpr (averages == Averages::per_cell) {
                const Real V_sigma_m =
                    load<Real>(a.V + p) *
                    ((load<Real>(a.sxx + p) + load<Real>(a.syy + p) + load<Real>(a.szz + p)) *
                     third);
                for (int k = 0; k < count; ++k) work.cells[a.cell[p + k]].sigma_m += V_sigma_m.v[k];
            }
        });
    sums.plastic += sum_of(plastic);
    sums.pushed_in += sum_of(pushed_in);
}

/// Mean stress replaced by its cell's average, then the volume that the force uses.
template <class Isa, Averages averages, VolumeRule volume_rule>
void settle(const ZoneWork& work, Span span, Totals& sums) {
    using namespace materials::lanes;
    constexpr int N = Isa::lanes;
    using Real = Lanes<N>;
    const Real third(1.0 / 3.0);
    const Real per_K(1.0 / work.law.K);
    Real largest(0.0);
    for_each_block<Isa>(
        work.points, span, [&](const Block& block) __attribute__((always_inline)) {
            const auto& [a, p, first, count] = block;
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
