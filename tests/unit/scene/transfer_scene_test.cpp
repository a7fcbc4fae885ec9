// /transfer in scenes: soils of points, and refusals.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/scene/scene.hpp"

namespace breach::scene {
namespace {

using nlohmann::json;

json sound_scene() {
    return json::parse(R"({
        "format": "breachline-scene/1", "name": "dam",
        "materials": {
            "sand": {"density": 1900, "law": {"type": "pm4sand", "D_R": 0.35, "G_0": 476}},
            "tailings": {"density": 1900, "law": {"type": "mohr_coulomb", "E_MPa": 120, "nu": 0.495,
                         "c_kPa": 1, "phi_deg": 30}},
            "dry": {"density": 1700, "law": {"type": "mohr_coulomb", "E_MPa": 124, "nu": 0.3,
                    "c_kPa": 25, "phi_deg": 35}},
            "wet": {"density": 1700, "law": {"type": "mohr_coulomb", "E_MPa": 142, "nu": 0.492,
                    "c_kPa": 25, "phi_deg": 35}},
            "liquefied": {"density": 1900, "law": {"type": "mohr_coulomb", "E_MPa": 72, "nu": 0.495,
                "c_kPa": 3, "phi_deg": 0, "softening": {"epsilon_q_start": 0, "epsilon_q_end": 1,
                "c_residual_kPa": 1.5, "phi_residual_deg": 0}}}
        },
        "section": {"regions": [
            {"name": "pond", "material": "sand", "polygon": [[0,0],[1,0],[1,1],[0,1],[0,0]]},
            {"name": "dike", "material": "sand", "polygon": [[1,0],[2,0],[2,1],[1,1],[1,0]]}]},
        "transfer": {
            "phreatic_line": [[0, 1], [2, 0.5]],
            "mapping": [{"region": "pond", "to": "tailings"},
                        {"region": "dike", "to": "dry", "saturated": "wet"}],
            "liquefied": {"regions": ["pond"],
                          "layers": [{"sigma_v0_kPa": [0, 50], "material": "liquefied"},
                                     {"sigma_v0_kPa": [50, 100]}, {"sigma_v0_kPa": [100, 150]}],
                          "residual_strength": {"like": "liquefied", "coefficient_kPa": 6.609,
                                                "exponent": 0.5763}}}
    })");
}

std::vector<std::string> pointers_at_fault(const json& scene) {
    try {
        parse_scene(scene.dump(), "scene");
    } catch (const fault::BadInput& refusal) {
        std::vector<std::string> pointers;
        for (const auto& each : refusal.faults()) pointers.push_back(each.pointer);
        return pointers;
    }
    return {};
}

TEST(TransferScene, EverySoilThatPointsCanBeIsListedRegionsFirst) {
    const Scene scene = parse_scene(sound_scene().dump(), "scene");
    std::vector<std::pair<std::string, std::string>> soils;
    for (const Soil& each : soils_of(scene))
        soils.emplace_back(scene.section.regions[each.region].name,
                           scene.materials[each.material].name);
    const std::vector<std::pair<std::string, std::string>> expected{
        {"pond", "tailings"},  {"dike", "dry"},         {"dike", "wet"},
        {"pond", "liquefied"}, {"pond", "liquefied_2"}, {"pond", "liquefied_3"}};
    EXPECT_EQ(soils, expected);
}

// s_r = 6.609 kPa (sigma'_v0 / 101.325 kPa)^0.5763 in the middle of 50-100 kPa; residual still
// half.
TEST(TransferScene, LayersWithoutMaterialGetTheirStrengthFromTheFunction) {
    const Scene scene = parse_scene(sound_scene().dump(), "scene");
    const auto made = std::ranges::find(scene.materials, "liquefied_2", &Material::name);
    ASSERT_NE(made, scene.materials.end());
    const auto& law = std::get<materials::MohrCoulomb>(made->law);
    EXPECT_NEAR(law.c, 6.609e3 * std::pow(75.0 / 101.325, 0.5763), 1e-9);
    EXPECT_NEAR(law.softening->c_residual, 0.5 * law.c, 1e-9);
    EXPECT_EQ(law.elasticity.E, 72e6);
}

TEST(TransferScene, WithoutTransferEverySoilIsItsRegions) {
    json scene = sound_scene();
    scene.erase("transfer");
    EXPECT_EQ(soils_of(parse_scene(scene.dump(), "scene")).size(), 2u);
}

TEST(TransferScene, EveryFaultIsNamedAtOnce) {
    json scene = sound_scene();
    scene["transfer"].erase("phreatic_line");
    scene["transfer"]["mapping"][0]["to"] = "sand";
    scene["transfer"]["mapping"][1]["region"] = "dyke";
    scene["transfer"]["liquefied"]["regions"] = {"pond", "lake"};
    scene["transfer"]["liquefied"]["layers"][0]["sigma_v0_kPa"] = {10, 50};
    scene["transfer"]["liquefied"]["layers"][1]["material"] = "glue";
    scene["transfer"]["liquefied"]["layers"][2]["sigma_v0_kPa"] = {110, 100};
    scene["transfer"]["points_per_cell"] = 4;
    const std::vector<std::string> expected{"/transfer/points_per_cell",  // needs /mpm
                                            "/transfer/mapping/0/to",
                                            "/transfer/mapping/1/region",
                                            "/transfer/liquefied/regions/1",
                                            "/transfer/liquefied/layers/0/sigma_v0_kPa",
                                            "/transfer/liquefied/layers/1/material",
                                            "/transfer/liquefied/layers/2/sigma_v0_kPa",
                                            "/transfer/liquefied/layers/2/sigma_v0_kPa"};
    EXPECT_EQ(pointers_at_fault(scene), expected);
}

TEST(TransferScene, PointsAndColumnsHaveTheirOwnEntries) {
    using Pointers = std::vector<std::string>;
    const auto with = [](const json& entries) {
        json scene = sound_scene();
        scene["transfer"]["liquefied"].update(entries);
        return pointers_at_fault(scene);
    };
    EXPECT_EQ(with({{"by", "point"}, {"shear_strain", 0.08}}), Pointers{});
    EXPECT_EQ(with({{"shear_strain", 0.08}}), Pointers{"/transfer/liquefied/shear_strain"});
    EXPECT_EQ(with({{"by", "point"}, {"narrowest_wall", 2}}),
              Pointers{"/transfer/liquefied/narrowest_wall"});
    EXPECT_EQ(with({{"by", "point"}, {"when", "at_transfer"}}),
              Pointers{"/transfer/liquefied/when"});
    const json line = json::parse(R"([{"transfer_time": 1, "points": [[0, 0.5], [1, 0.2]]}])");
    EXPECT_EQ(with({{"by", "point"}, {"line", line}}), Pointers{"/transfer/liquefied/line"});
}

TEST(TransferScene, ASaturatedPartNeedsThePhreaticLine) {
    json scene = sound_scene();
    scene["transfer"].erase("phreatic_line");
    EXPECT_EQ(pointers_at_fault(scene), std::vector<std::string>{"/transfer/mapping/1/saturated"});
}

TEST(TransferScene, ALayerNeedsAMaterialOrTheFunction) {
    json scene = sound_scene();
    scene["transfer"]["liquefied"].erase("residual_strength");
    EXPECT_EQ(pointers_at_fault(scene), (std::vector<std::string>{"/transfer/liquefied/layers/1",
                                                                  "/transfer/liquefied/layers/2"}));
    scene = sound_scene();
    scene["transfer"]["liquefied"]["residual_strength"]["like"] = "tailings";  // phi = 30
    EXPECT_EQ(pointers_at_fault(scene),
              std::vector<std::string>{"/transfer/liquefied/residual_strength/like"});
}

}  // namespace
}  // namespace breach::scene
