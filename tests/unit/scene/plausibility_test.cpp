// Wrong units and contradictory entries are refused or flagged, with the likely mistake.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <ostream>

#include "core/scene/scene.hpp"
#include "core/scene/schema.hpp"

namespace breach {
namespace {

using nlohmann::json;

enum class Caught { refused, flagged };

struct Slip {
    const char* pointer;
    const char* value;  ///< JSON
    Caught caught;
    const char* says;  ///< part of the fault's or the flag's text
};

void PrintTo(const Slip& slip, std::ostream* stream) {
    *stream << slip.pointer << " = " << slip.value;
}

/// A dam on a foundation under water, with every part of a scene and no implausible entry.
json dam() {
    return json::parse(R"({
        "format": "breachline-scene/1", "name": "dam",
        "materials": {
            "fill": {"density": 1900, "viscosity": 100, "void_ratio": 0.8, "permeability": [1e-6, 1e-6],
                "limit_strength": {"c_kPa": 10, "phi_deg": 32},
                "law": {"type": "mohr_coulomb", "E_MPa": 40, "nu": 0.3, "c_kPa": 10, "phi_deg": 32, "psi_deg": 2,
                    "tension_cutoff_kPa": 2,
                    "softening": {"epsilon_q_start": 0.02, "epsilon_q_end": 0.3, "c_residual_kPa": 1,
                        "phi_residual_deg": 20}}},
            "sand": {"density": 1850, "void_ratio": 0.9, "permeability": [1e-5, 1e-6],
                "law": {"type": "pm4sand", "D_R": 0.4, "G_0": 500, "h_po": 1, "p_atm_kPa": 101.3, "phi_cv_deg": 33}},
            "rock": {"density": 2000, "void_ratio": 0.5, "permeability": [1e-7, 1e-7],
                "law": {"type": "linear_elastic", "E_MPa": 500, "nu": 0.3}}},
        "section": {"element_size": 1, "regions": [
            {"name": "rock", "material": "rock", "polygon": [[0,-5],[100,-5],[100,0],[0,0],[0,-5]],
                "mesh": {"type": "block"}},
            {"name": "dam", "material": "fill", "polygon": [[0,0],[60,0],[30,15],[0,15],[0,0]],
                "mesh": {"type": "block"}}]},
        "lem": {"search": {"entry": [5, 29], "exit": [40, 70]}, "water": {"line": [[0, 10], [60, 0]]},
            "pore_pressure_ratios": [{"region": "dam", "r_u": 0.2}], "seismic_coefficient": 0.1,
            "surcharge": [{"from": 5, "to": 10, "pressure_kPa": 20}],
            "undrained": [{"region": "rock", "strength_kPa": 40}],
            "liquefaction": [{"region": "dam", "residual_strength_kPa": 5}]},
        "fem": {"supports": [{"name": "base", "from": [0,-5], "to": [100,-5], "fixes": "xy"}],
            "water": {"line": [[0, 10], [60, 0]], "bulk_modulus_MPa": 2200},
            "base": {"density": 2300, "V_s": 760},
            "liquefaction": {"regions": ["dam"], "x": [0, 50], "level": 15, "r_u": 0.7},
            "stages": [{"type": "static", "name": "gravity"},
                {"type": "dynamic", "name": "shaking", "duration": 10, "time_step": 0.005}],
            "strain_threshold": 0.03, "crest": [30, 15]},
        "transfer": {"phreatic_line": [[0, 10], [60, 0]]},
        "mpm": {"cell_size": 1, "domain_x": [0, 200], "domain_y": [-5, 25], "right": "roller",
            "floor": {"level": -5, "friction": [{"from": 0, "to": 200, "coefficient": 0.4}]},
            "duration": 30, "runout": {"toe": [60, 0], "regions": ["dam"]}}})");
}

json with(const Slip& slip) {
    json document = dam();
    document[json::json_pointer(slip.pointer)] = json::parse(slip.value);
    return document;
}

/// Warnings about entries, without those about cell sizes.
std::vector<fault::Flag> warnings_of(const scene::Scene& read) {
    std::vector<fault::Flag> warnings = read.warnings;
    std::erase_if(warnings, [](const fault::Flag& each) { return each.code != "implausible"; });
    return warnings;
}

class UnitSlip : public testing::TestWithParam<Slip> {};

TEST_P(UnitSlip, IsCaughtAndNamed) {
    const Slip& slip = GetParam();
    std::string said;
    Caught caught = Caught::refused;
    try {
        const scene::Scene read = scene::parse_scene(with(slip).dump(), "dam");
        caught = Caught::flagged;
        for (const fault::Flag& flag : warnings_of(read)) {
            if (flag.pointer != slip.pointer) continue;
            EXPECT_EQ(flag.severity, fault::Severity::warning);
            said += flag.message + "\n";
        }
        ASSERT_FALSE(said.empty()) << "passes without a word";
    } catch (const fault::BadInput& error) {
        const auto fault = std::ranges::find(error.faults(), slip.pointer, &fault::Fault::pointer);
        ASSERT_NE(fault, error.faults().end()) << error.what();
        said = fault->cause + "; " + fault->remedy;
    }
    EXPECT_TRUE(caught == slip.caught) << said;
    EXPECT_NE(said.find(slip.says), std::string::npos) << said;
}

// Grouped by the confused unit.
const Slip unit_slips[] = {
    {"/materials/fill/density", "19", Caught::refused, "19 looks like kN/m3: write 1937 kg/m3"},
    {"/materials/fill/density", "1.9", Caught::refused, "1.9 looks like t/m3 (g/cm3): write 1900"},
    {"/materials/fill/density", "120", Caught::refused, "120 looks like lb/ft3: write 1922"},
    {"/materials/fill/density", "19000", Caught::refused, "19000 looks like N/m3: write 1937"},
    {"/materials/fill/density", "600", Caught::flagged, "outside the plausible 1000 to 3200 kg/m3"},
    {"/lem/water/density", "9.81", Caught::refused, "9.81 looks like kN/m3: write 1000"},
    {"/fem/water/density", "1", Caught::refused, "1 looks like t/m3 (g/cm3): write 1000"},
    {"/fem/water/density", "1900", Caught::flagged, "density of water"},
    {"/fem/base/density", "2.3", Caught::refused, "write 2300 kg/m3"},
    {"/materials/fill/law/c_kPa", "10000", Caught::flagged, "10000 looks like Pa: write 10 kPa"},
    {"/materials/fill/law/c_kPa", "25000", Caught::refused, "25000 looks like Pa: write 25 kPa"},
    {"/materials/fill/law/softening/c_residual_kPa", "0.01", Caught::flagged,
     "0.01 looks like MPa: write 10 kPa"},
    {"/materials/fill/limit_strength/c_kPa", "5000", Caught::flagged, "looks like Pa: write 5 kPa"},
    {"/materials/fill/law/tension_cutoff_kPa", "2000", Caught::flagged, "looks like Pa: write 2"},
    {"/lem/undrained/0/strength_kPa", "40000", Caught::refused, "looks like Pa: write 40 kPa"},
    {"/lem/liquefaction/0/residual_strength_kPa", "5000", Caught::flagged, "Pa: write 5 kPa"},
    {"/lem/surcharge/0/pressure_kPa", "20000", Caught::flagged, "looks like Pa: write 20 kPa"},
    {"/materials/fill/law/E_MPa", "40000", Caught::flagged, "40000 looks like kPa: write 40 MPa"},
    {"/materials/fill/law/E_MPa", "40e6", Caught::refused, "looks like Pa: write 40 MPa"},
    {"/materials/fill/law/E_MPa", "0.04", Caught::flagged, "0.04 looks like GPa: write 40 MPa"},
    {"/materials/rock/law/E_MPa", "5e8", Caught::refused, "looks like Pa: write 500 MPa"},
    {"/materials/fill/law/softening/phi_residual_deg", "0.35", Caught::flagged,
     "0.35 looks like radians: write 20.05 deg"},
    {"/materials/fill/law/psi_deg", "0.035", Caught::flagged, "radians: write 2.005 deg"},
    {"/materials/fill/limit_strength/phi_deg", "0.5585", Caught::flagged, "radians: write 32 deg"},
    {"/materials/sand/law/phi_cv_deg", "0.576", Caught::flagged, "radians: write 33 deg"},
    {"/materials/fill/law/nu", "30", Caught::refused, "30 looks like %: write 0.3"},
    {"/materials/sand/law/D_R", "40", Caught::refused, "40 looks like %: write 0.4"},
    {"/materials/sand/law/p_atm_kPa", "101325", Caught::refused, "looks like Pa: write 101.3 kPa"},
    {"/materials/fill/void_ratio", "80", Caught::refused, "80 looks like %: write 0.8"},
    {"/materials/fill/permeability/0", "0.05", Caught::flagged, "cm/s: write 0.0005 m/s"},
    {"/materials/fill/viscosity", "1e6", Caught::flagged, "mPa s: write 1000 Pa s"},
    {"/gravity", "-9.81", Caught::refused, "-9.81 looks like m/s2 upwards: write 9.81 m/s2"},
    {"/gravity", "1", Caught::flagged, "1 looks like g: write 9.807 m/s2"},
    {"/gravity", "981", Caught::flagged, "981 looks like cm/s2: write 9.81 m/s2"},
    {"/gravity", "32.2", Caught::flagged, "32.2 looks like ft/s2"},
    {"/thickness", "1000", Caught::flagged, "1000 looks like mm: write 1 m"},
    {"/section/element_size", "500", Caught::refused, "more than the whole section"},
    {"/mpm/cell_size", "2000", Caught::refused, "2000 looks like mm: write 2 m"},
    {"/lem/seismic_coefficient", "15", Caught::refused, "15 looks like %: write 0.15"},
    {"/lem/seismic_coefficient", "1.5", Caught::flagged, "1.5 looks like m/s2: write 0.153"},
    {"/lem/pore_pressure_ratios/0/r_u", "20", Caught::refused, "20 looks like %: write 0.2"},
    {"/fem/liquefaction/r_u", "70", Caught::refused, "70 looks like %: write 0.7"},
    {"/fem/water/bulk_modulus_MPa", "2.2", Caught::flagged, "2.2 looks like GPa: write 2200 MPa"},
    {"/fem/water/bulk_modulus_MPa", "2.2e9", Caught::refused, "looks like Pa: write 2200 MPa"},
    {"/fem/base/V_s", "0.76", Caught::refused, "0.76 looks like km/s: write 760 m/s"},
    {"/fem/strain_threshold", "3", Caught::refused, "3 looks like %: write 0.03"},
    {"/fem/failure_surfaces/epsilon_q", "10", Caught::refused, "10 looks like %: write 0.1"},
    {"/materials/fill/law/softening/epsilon_q_end", "30", Caught::flagged, "%: write 0.3"},
    {"/fem/stages/1/duration", "12000", Caught::flagged, "12000 looks like ms: write 12 s"},
    {"/fem/stages/1/time_step", "5", Caught::flagged, "5 looks like ms: write 0.005 s"},
    {"/fem/stages/1/time_step", "20", Caught::refused, "longer than the stage's 10 s"},
    {"/mpm/duration", "30000", Caught::flagged, "30000 looks like ms: write 30 s"},
    {"/mpm/floor/friction/0/coefficient", "22", Caught::refused, "degrees: write 0.404"},
};

TEST(UnitSlips, AreMany) { EXPECT_GE(std::size(unit_slips), 50U); }

INSTANTIATE_TEST_SUITE_P(Scene, UnitSlip, testing::ValuesIn(unit_slips));

// Entries compared with each other.
INSTANTIATE_TEST_SUITE_P(
    Together, UnitSlip,
    testing::Values(
        Slip{"/lem/water/line", "[[0, 65], [100, 65]]", Caught::flagged,
             "stands 50 m above the section's highest ground (15 m)"},
        Slip{"/lem/water/line", "[[0, 65], [60, 55]]", Caught::refused, "no free water does"},
        Slip{"/lem/water/line", "[[0, 14], [30, 14], [100, 4]]", Caught::flagged,
             "and slopes there, as no free water does"},
        Slip{"/fem/water/line", "[[0, 17], [60, 0]]", Caught::flagged, "highest ground is drowned"},
        Slip{"/fem/water/line", "[[0, 17]]", Caught::flagged, "whole section is drowned"},
        Slip{"/transfer/phreatic_line", "[[0, 65]]", Caught::flagged, "stands 50 m above"},
        Slip{"/lem/water/line", "[[0, 4], [60, 0]]", Caught::flagged,
             "lies 6 m from that of /fem/water/line at x = 0 m"},
        Slip{"/gravity", "0", Caught::flagged, "gravity is zero"},
        Slip{"/mpm/runout/toe", "[0, 0]", Caught::refused, "100 % of the soil that counts"},
        Slip{"/mpm/runout/toe", "[-60, 0]", Caught::refused, "x points downstream"},
        Slip{"/mpm/runout/toe", "[45, 0]", Caught::flagged, "before anything has moved"},
        Slip{"/mpm/runout/toe", "[160, 0]", Caught::flagged, "the ground rises only"},
        Slip{"/mpm/floor/friction", R"([{"from": 60, "to": 200, "coefficient": 0.4}])",
             Caught::flagged, "no zone covers x = 0 to 60 m"},
        Slip{"/mpm/time_step", "40", Caught::refused, "longer than the duration of 30 s"},
        Slip{"/section/element_size", "0.01", Caught::flagged, "sizes are in m"}));

TEST(Plausibility, ADamWithoutSlipsPassesWithoutAWord) {
    const scene::Scene read = scene::parse_scene(dam().dump(), "dam");
    for (const fault::Flag& flag : warnings_of(read)) {
        ADD_FAILURE() << flag.pointer << ": " << flag.message;
    }
}

TEST(Plausibility, ShippedScenesPassWithoutAWord) {
    const auto folder = std::filesystem::path(BREACH_ROOT) / "workflows/scenes";
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        for (const fault::Flag& flag : warnings_of(scene::read_scene(entry.path()))) {
            ADD_FAILURE() << entry.path() << flag.pointer << ": " << flag.message;
        }
    }
}

TEST(Plausibility, AnEntryHasOneFlagWithAllThatIsSaidOfIt) {
    const json document = with({"/fem/stages/1/time_step", "5", Caught::flagged, ""});
    const scene::Scene read = scene::parse_scene(document.dump(), "dam");
    const auto warnings = warnings_of(read);
    ASSERT_EQ(warnings.size(), 1U);
    for (const char* part : {"5 looks like ms", "section's natural period of about"}) {
        EXPECT_NE(warnings[0].message.find(part), std::string::npos) << part;
    }
}

TEST(Plausibility, AFaultMentionsTheWarningThatExplainsIt) {
    // phi in radians below psi in degrees: the fault alone would mislead to psi.
    const json document = with({"/materials/fill/law/phi_deg", "0.5585", Caught::refused, ""});
    try {
        scene::parse_scene(document.dump(), "dam");
        FAIL();
    } catch (const fault::BadInput& error) {
        for (const fault::Fault& each : error.faults()) {
            EXPECT_NE(each.remedy.find("/materials/fill/law/phi_deg: 0.5585"), std::string::npos);
            EXPECT_NE(each.remedy.find("looks like radians: write 32 deg"), std::string::npos);
        }
    }
}

TEST(Plausibility, ZeroMeansNone) {
    for (const char* pointer : {"/materials/fill/viscosity", "/lem/seismic_coefficient"}) {
        const json document = with({pointer, "0", Caught::flagged, ""});
        EXPECT_TRUE(warnings_of(scene::parse_scene(document.dump(), "dam")).empty()) << pointer;
    }
}

TEST(Plausibility, ASectionInMillimetresIsRefused) {
    json document = dam();
    for (json& region : document["section"]["regions"]) {
        for (json& vertex : region["polygon"])
            vertex = {1e3 * double(vertex[0]), 1e3 * double(vertex[1])};
    }
    for (const char* part : {"lem", "fem", "transfer", "mpm"}) document.erase(part);
    try {
        scene::parse_scene(document.dump(), "dam");
        FAIL();
    } catch (const fault::BadInput& error) {
        ASSERT_EQ(error.faults().size(), 1U);
        EXPECT_EQ(error.faults()[0].pointer, "/section/regions");
        EXPECT_NE(error.faults()[0].remedy.find("mm: divide by 1000"), std::string::npos);
    }
}

/// Every entry of the schema with a plausible range.
template <class Visit>
void each_range(const json& node, const std::string& path, const Visit& visit) {
    if (node.is_object() && node.contains("x-plausible")) visit(node, path);
    if (!node.is_structured()) return;
    for (const auto& [key, child] : node.items()) each_range(child, path + "/" + key, visit);
}

TEST(PlausibleRange, LiesWithinThePossibleOneAndHoldsTheDefault) {
    int count = 0;
    each_range(scene::scene_schema(), "", [&](const json& entry, const std::string& path) {
        ++count;
        const double low = entry.at("x-plausible").at(0), high = entry.at("x-plausible").at(1);
        EXPECT_LT(low, high) << path;
        EXPECT_TRUE(entry.contains("unit")) << path;
        EXPECT_GE(low, entry.value("minimum", low)) << path;
        EXPECT_GT(low, entry.value("exclusiveMinimum", low - 1.0)) << path;
        EXPECT_LE(high, entry.value("maximum", high)) << path;
        EXPECT_LT(high, entry.value("exclusiveMaximum", high + 1.0)) << path;
        const double usual = entry.value("default", low);
        EXPECT_TRUE(usual == 0.0 || (usual >= low && usual <= high)) << path;
    });
    EXPECT_GE(count, 60);
}

}  // namespace
}  // namespace breach
