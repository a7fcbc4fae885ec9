// Words of the scene's enums, for readers, results and plans. The schema lists the same words
// (tests/unit/scene/words_test.cpp).
#pragma once

#include "core/scene/scene.hpp"
#include "core/words/words.hpp"

namespace breach::materials {

constexpr auto words_of(SofteningDriver) {
    using enum SofteningDriver;
    return words::in_order<SofteningDriver>({{plastic, "plastic"}, {total, "total"}});
}

constexpr auto words_of(Along) {
    using enum Along;
    return words::in_order<Along>(
        {{depth, "depth"}, {elevation, "elevation"}, {sigma_v0, "sigma_v0"}});
}

constexpr auto words_of(OnPath) {
    using enum OnPath;
    return words::in_order<OnPath>({{peak, "peak"}, {residual, "residual"}});
}

constexpr auto words_of(Relation) {
    using enum Relation;
    return words::in_order<Relation>(
        {{weber_2015, "weber_2015"},
         {kramer_wang_2015, "kramer_wang_2015"},
         {olson_stark_2002_spt, "olson_stark_2002_spt"},
         {olson_stark_2002_cpt, "olson_stark_2002_cpt"},
         {idriss_boulanger_2008_spt, "idriss_boulanger_2008_spt"},
         {idriss_boulanger_2008_spt_redistribution, "idriss_boulanger_2008_spt_redistribution"},
         {idriss_boulanger_2008_cpt, "idriss_boulanger_2008_cpt"},
         {idriss_boulanger_2008_cpt_redistribution, "idriss_boulanger_2008_cpt_redistribution"}});
}

}  // namespace breach::materials

namespace breach::scene {

constexpr auto words_of(RegionMesh) {
    using enum RegionMesh;
    return words::in_order<RegionMesh>({{block, "block"}, {unstructured, "unstructured"}});
}

constexpr auto words_of(PhreaticCorrection) {
    using enum PhreaticCorrection;
    return words::in_order<PhreaticCorrection>({{none, "none"}, {cos2, "cos2"}});
}

constexpr auto words_of(VariedSurface) {
    using enum VariedSurface;
    return words::in_order<VariedSurface>({{fixed, "fixed"}, {searched, "searched"}});
}

constexpr auto words_of(Parameter) {
    using enum Parameter;
    return words::in_order<Parameter>({{cohesion, "cohesion"},
                                       {friction_angle, "friction_angle"},
                                       {density, "density"},
                                       {undrained_strength, "undrained_strength"},
                                       {residual_strength, "residual_strength"},
                                       {seismic_coefficient, "seismic_coefficient"}});
}

constexpr auto words_of(Distribution) {
    using enum Distribution;
    return words::in_order<Distribution>({{normal, "normal"}, {lognormal, "lognormal"}});
}

constexpr auto words_of(ElementKind) {
    using enum ElementKind;
    return words::in_order<ElementKind>({{bbar, "bbar"}, {ssp, "ssp"}});
}

constexpr auto words_of(HourglassKind) {
    using enum HourglassKind;
    return words::in_order<HourglassKind>({{current, "current"}, {elastic, "elastic"}});
}

constexpr auto words_of(PressureIntegration) {
    using enum PressureIntegration;
    return words::in_order<PressureIntegration>({{full, "full"}, {one_point, "one_point"}});
}

constexpr auto words_of(StageKind) {
    using enum StageKind;
    return words::in_order<StageKind>({{static_equilibrium, "static"}, {dynamic, "dynamic"}});
}

constexpr auto words_of(StageLaws) {
    return words::in_order<StageLaws>(
        {{StageLaws::elastic, "elastic"}, {StageLaws::scene, "scene"}});
}

constexpr auto words_of(StagePermeability) {
    return words::in_order<StagePermeability>(
        {{StagePermeability::free_drainage, "free_drainage"}, {StagePermeability::scene, "scene"}});
}

constexpr auto words_of(AboveWater) {
    using enum AboveWater;
    return words::in_order<AboveWater>({{drained, "drained"}, {dry, "dry"}});
}

constexpr auto words_of(MotionAt) {
    using enum MotionAt;
    return words::in_order<MotionAt>({{outcrop, "outcrop"}, {upgoing, "upgoing"}});
}

constexpr auto words_of(Baseline) {
    using enum Baseline;
    return words::in_order<Baseline>({{as_recorded, "as_recorded"}, {corrected, "corrected"}});
}

constexpr auto words_of(FreeFieldSides) {
    using enum FreeFieldSides;
    return words::in_order<FreeFieldSides>({{left, "left"}, {right, "right"}, {both, "both"}});
}

constexpr auto words_of(Interpolation) {
    using enum Interpolation;
    return words::in_order<Interpolation>({{local, "local"}, {paper, "paper"}});
}

constexpr auto words_of(BaseDisplacement) {
    using enum BaseDisplacement;
    return words::in_order<BaseDisplacement>({{kept, "kept"}, {subtracted, "subtracted"}});
}
constexpr auto words_of(OutOfPlaneStress) {
    using enum OutOfPlaneStress;
    return words::in_order<OutOfPlaneStress>({{carried, "carried"}, {zero, "zero"}});
}
constexpr auto words_of(LiquefiedWhen) {
    using enum LiquefiedWhen;
    return words::in_order<LiquefiedWhen>({{ever, "ever"}, {at_transfer, "at_transfer"}});
}

constexpr auto words_of(LiquefiedBy) {
    using enum LiquefiedBy;
    return words::in_order<LiquefiedBy>({{column, "column"}, {point, "point"}});
}

constexpr auto words_of(Entangled) {
    using enum Entangled;
    return words::in_order<Entangled>({{refuse, "refuse"}, {rebuild, "rebuild"}});
}

constexpr auto words_of(TransferredStress) {
    using enum TransferredStress;
    return words::in_order<TransferredStress>({{total, "total"}, {effective, "effective"}});
}

constexpr auto words_of(AntiLocking) {
    using enum AntiLocking;
    return words::in_order<AntiLocking>({{on, "on"}, {off, "off"}, {automatic, "auto"}});
}

constexpr auto words_of(Wall) {
    using enum Wall;
    return words::in_order<Wall>({{roller, "roller"}, {fixed, "fixed"}, {open, "open"}});
}

constexpr auto words_of(FillStress) {
    using enum FillStress;
    return words::in_order<FillStress>({{none, "none"}, {overburden, "overburden"}});
}

constexpr auto words_of(PointField) {
    using enum PointField;
    return words::in_order<PointField>({{velocity, "velocity"},
                                        {velocity_gradient, "velocity_gradient"},
                                        {mass, "mass"},
                                        {volume_0, "volume_0"},
                                        {volume, "volume"},
                                        {stress, "stress"},
                                        {epsilon_q, "epsilon_q"},
                                        {epsilon_q_plastic, "epsilon_q_plastic"},
                                        {gap, "gap"},
                                        {r_u, "r_u"}});
}

constexpr auto words_of(Shaking) {
    using enum Shaking;
    return words::in_order<Shaking>({{off, "off"}, {goes_on, "on"}});
}

using words::word_at;

}  // namespace breach::scene
