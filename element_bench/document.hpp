// Reads an element-test document (workflows/schema/element_test.schema.json) into structs in SI
// units and radians. Only this file knows its keys.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/fault/flag.hpp"
#include "core/scene/norsand.hpp"
#include "core/scene/scene.hpp"
#include "element_bench/calibration.hpp"

namespace breach::element_bench {

/// A law in its initial state.
struct SandLaw {
    SandParameters parameters;
    materials::pm4sand::Options options;
};
struct NorSandLaw {
    materials::norsand::Parameters parameters;
    materials::norsand::Options options;
};
using TestLaw = std::variant<PlainLaw, SandLaw, NorSandLaw>;

struct NorSandTest {
    scene::NorSandStart start;
    double S;  ///< additional softening [-]
};

/// Consolidation before a test.
struct Consolidation {
    Boundary boundary;
    std::vector<double> sigma_v;  ///< [Pa]
    double K0;
    double static_shear = 0.0;  ///< tau / sigma_v [-]
    std::optional<NorSandTest> norsand;
};

struct MonotonicTest {
    double strain;
    Pace pace;
};
struct CyclicStrengthTest {
    std::vector<double> CSR;
    Limit limit;
    Pace pace;
};
struct CyclicStrainTest {
    double amplitude;
    int cycles;
    Pace pace;
};
struct ModulusReductionTest {
    std::vector<double> amplitudes;
    int cycles;
    int steps;
};

struct TestPlan {
    std::string name;
    Consolidation consolidation;
    std::variant<MonotonicTest, CyclicStrengthTest, CyclicStrainTest, ModulusReductionTest> kind;
};

struct Bench {
    TestLaw law;
    std::vector<TestPlan> tests;
    std::optional<CalibrationProblem> calibration;
};

/// Reads, completes and checks the document; adds PM4Sand's defaults. The returned scene has only
/// the name and the completed text. Throws BadInput with every fault.
scene::Scene read_document(const std::filesystem::path& file,
                           const std::vector<std::string>& overrides);

/// The structs of a completed document. Throws BadInput for contradictory entries.
Bench bench_of(const scene::Scene& scene);

/// A specimen of the law consolidated to sigma_v [Pa].
Specimen consolidated(const TestLaw& law, const Consolidation& consolidation, double sigma_v);

/// Flags possible but implausible entries of the tests.
std::vector<fault::Flag> warnings_of(const Bench& bench);

}  // namespace breach::element_bench
