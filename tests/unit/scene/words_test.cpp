// The readers know the same words as the schema.
#include "core/scene/words.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "core/scene/schema.hpp"

namespace breach::scene {
namespace {

using nlohmann::json;
using Words = std::set<std::string>;

/// Lists of words in the schema without an enum.
const std::set<std::string> without_enum{
    "/$defs/support/properties/fixes",                         // two flags
    "/properties/transfer/properties/window/properties/pick",  // criteria::Pick
    "/$defs/pm4sand/properties/compat",                        // pm4sand::Scheme, in sand.cpp
    "/$defs/norsand/properties/flow",                          // norsand::FlowRule, in norsand.cpp
    "/$defs/norsand/properties/unloading",                     // norsand::Unloading, in norsand.cpp
    "/$defs/norsand/properties/psi_0_profile/properties/by",   // materials::Along without sigma_v0
    "/$defs/static_stage/properties/at_limit",                 // a flag
    "/properties/mpm/properties/duration/oneOf/1",             // a number, or this word
    "/properties/mpm/properties/blending_rate/oneOf/1",
    "/properties/mpm/properties/longest_duration/oneOf/1",
    "/properties/mpm/properties/rest_change/oneOf/1",
    "/properties/mpm/properties/rest_window/oneOf/1",
    "/properties/mpm/properties/rest_earliest/oneOf/1",
    "/properties/mpm/properties/rest_speed/oneOf/1",
    "/properties/mpm/properties/stiffness_scale/oneOf/1",
};

class WordsOfTheSchema {
  public:
    /// These entries of the schema together have exactly the enum's words.
    template <class Enum>
    void are_those_of(const std::vector<std::string>& pointers) {
        Words listed;
        for (const std::string& each : pointers) {
            const json& entry = scene_schema().at(json::json_pointer(each));
            if (entry.contains("const")) listed.insert(entry.at("const").get<std::string>());
            if (!entry.contains("enum")) continue;
            covered_.insert(each);
            for (const json& word : entry.at("enum")) listed.insert(word.get<std::string>());
        }
        Words known;
        for (const Enum each : words::values<Enum>) {
            known.insert(std::string(words::name_of(each)));
            EXPECT_EQ(words::named<Enum>(words::name_of(each)), each);
        }
        EXPECT_EQ(known, listed) << pointers.front();
    }

    void are_all_covered() const { look_at(scene_schema(), ""); }

  private:
    void look_at(const json& entry, const std::string& pointer) const {
        if (!entry.is_structured()) return;
        const bool listed = covered_.contains(pointer) || without_enum.contains(pointer);
        if (entry.is_object() && entry.contains("enum") && !listed)
            ADD_FAILURE() << pointer << ": no enum of core/scene/words.hpp is held to it";
        for (const auto& [key, part] : entry.items()) look_at(part, pointer + "/" + key);
    }

    std::set<std::string> covered_;
};

TEST(Words, AreTheSchemas) {
    const std::string lem = "/properties/lem/properties", fem = "/properties/fem/properties",
                      transfer = "/properties/transfer/properties",
                      mpm = "/properties/mpm/properties";
    const std::string variable = lem + "/probability/properties/variables/items/properties";
    WordsOfTheSchema words;
    words.are_those_of<RegionMesh>(
        {"/$defs/block_mesh/properties/type", "/$defs/unstructured_mesh/properties/type"});
    words.are_those_of<materials::SofteningDriver>({"/$defs/softening/properties/driver"});
    words.are_those_of<materials::SofteningDriver>(
        {"/$defs/strength/properties/softening/properties/driver"});
    words.are_those_of<materials::Along>(
        {"/$defs/table_strength/properties/by", "/$defs/relation_strength/properties/by"});
    words.are_those_of<materials::Relation>({"/$defs/relation_strength/properties/relation"});
    words.are_those_of<PhreaticCorrection>(
        {lem + "/water/properties/correction",
         lem + "/piezometric_lines/items/properties/correction"});
    for (const char* list : {"/undrained", "/liquefaction"})
        words.are_those_of<materials::OnPath>({lem + list + "/items/properties/norsand"});
    words.are_those_of<VariedSurface>({lem + "/probability/properties/surface"});
    words.are_those_of<VariedSurface>({lem + "/probability/properties/surface"});
    words.are_those_of<Parameter>({variable + "/parameter"});
    words.are_those_of<Distribution>({variable + "/distribution"});
    words.are_those_of<ElementKind>({fem + "/element"});
    words.are_those_of<HourglassKind>({fem + "/hourglass"});
    words.are_those_of<StageKind>(
        {"/$defs/static_stage/properties/type", "/$defs/dynamic_stage/properties/type"});
    for (const std::string stage : {"/$defs/static_stage", "/$defs/dynamic_stage"}) {
        words.are_those_of<StageLaws>({stage + "/properties/laws"});
        words.are_those_of<StagePermeability>({stage + "/properties/permeability"});
    }
    words.are_those_of<AboveWater>({fem + "/water/properties/above"});
    words.are_those_of<PressureIntegration>({fem + "/water/properties/pressure_integration"});
    words.are_those_of<MotionAt>({fem + "/base/properties/motion_at"});
    words.are_those_of<Baseline>({fem + "/motion/properties/baseline"});
    words.are_those_of<FreeFieldSides>({fem + "/free_field/properties/sides"});
    words.are_those_of<Interpolation>({transfer + "/interpolation"});
    words.are_those_of<LiquefiedWhen>({transfer + "/liquefied/properties/when"});
    words.are_those_of<LiquefiedBy>({transfer + "/liquefied/properties/by"});
    words.are_those_of<BaseDisplacement>({transfer + "/base_displacement"});
    words.are_those_of<OutOfPlaneStress>({transfer + "/sigma_zz"});
    words.are_those_of<Entangled>({transfer + "/entangled"});
    words.are_those_of<TransferredStress>({transfer + "/stress"});
    words.are_those_of<AntiLocking>({mpm + "/anti_locking"});
    for (const char* side : {"/left", "/right"}) words.are_those_of<Wall>({mpm + side});
    words.are_those_of<PointField>({mpm + "/output/properties/fields/items"});
    words.are_those_of<FillStress>({mpm + "/fill_stress"});
    words.are_those_of<Shaking>({mpm + "/shaking"});
    words.are_all_covered();
}

TEST(Words, OfNoEnumAreOurOwnMistake) {
    EXPECT_FALSE(words::find<ElementKind>("spline"));
    EXPECT_THROW(words::named<ElementKind>("spline"), std::logic_error);
}

}  // namespace
}  // namespace breach::scene
