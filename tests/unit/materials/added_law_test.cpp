// Laws added to the list by this test: one without memory, and one with every interface. They
// compile with these functions alone; a law that lacks one does not compile.
#include <gtest/gtest.h>

#include "core/materials/law.hpp"

namespace breach::materials::added_law_test {

struct Rock {
    mechanics::Elasticity elasticity;
};
inline const Rock& ready(const Rock& law) { return law; }
inline Traits traits(const Rock&) {
    return {.type = "rock",
            .name = "rock",
            .yields = false,
            .opens = false,
            .frictional = false,
            .c_and_phi = false,
            .symmetric_tangent = true,
            .tells_plastic_strain = true};
}
inline std::optional<Strength> limit_strength(const Rock&) { return std::nullopt; }
inline const Softening* softening(const Rock&) { return nullptr; }
inline StrengthEntries strength_entries(Rock&) { return {}; }
inline double yield_excess(const Rock&, const State&) { return -1.0; }
inline Voigt return_to_surface(const Rock&, const State& state) { return state.sigma; }
inline std::optional<LawLanes> for_particles(const Rock&) { return std::nullopt; }

/// Elastic, with Rock's functions; undrained strength (1 - S) times twice p' + u.
struct Peat : Rock {
    static constexpr bool has_state_parameter = true;
    struct Memory {
        Voigt sigma;
        double psi;
    };
    enum class Outcome { done, refused };
    struct Counts {
        int evaluations = 0;
    };
    struct Update {
        Memory state;
        Outcome outcome = Outcome::done;
        Counts counts{};
    };
    double psi_0 = 0.0;
    double S = 0.0;
};
inline Peat::Memory first_memory(const Peat& law, const Voigt& sigma, double) {
    return {sigma, law.psi_0};
}
inline Voigt stress(const Peat&, const Peat::Memory& memory) { return memory.sigma; }
inline Matrix4 elastic_tangent(const Peat& law, const Peat::Memory&) {
    return mechanics::elastic_stiffness(law.elasticity);
}
inline void integrate(const Peat& law, std::span<const Peat::Memory> old,
                      std::span<const Voigt> d_epsilon, std::span<Peat::Update> updates) {
    const Matrix4 D = mechanics::elastic_stiffness(law.elasticity);
    for (std::size_t i = 0; i < old.size(); ++i)
        updates[i] = {.state = {old[i].sigma + D * d_epsilon[i], old[i].psi}};
}
inline double shear_modulus(const Peat& law, const Peat::Memory&) {
    return law.elasticity.shear_modulus();
}
inline double friction(const Peat&, const Peat::Memory&) { return 0.5; }
inline double stress_outside(const Peat&, const Peat::Memory&) { return 0.0; }
inline bool has_fallen(const Peat&, const Peat::Memory&) { return false; }
template <class Memory, class Visit>
requires std::same_as<std::remove_const_t<Memory>, Peat::Memory>
void for_each_number(Memory& memory, Visit visit) {
    for (auto& each : memory.sigma) visit(each);
    visit(memory.psi);
}
inline double psi_at(const Peat& law, const Place& place) { return law.psi_0 * place.depth; }
inline Instability instability(const Peat&, const Peat::Memory& memory) {
    return {memory.psi, 0.5, false};
}
inline double least_mean_stress(const Peat&) { return 1e3; }
inline UndrainedStrength strength_of(const Peat& law, double bound) {
    return {2.0 * bound, (1.0 - law.S) * 2.0 * bound};
}
inline std::vector<UndrainedStrength> undrained_strengths(const Peat& law,
                                                          std::span<const Peat::Memory>,
                                                          std::span<const double> bounds) {
    std::vector<UndrainedStrength> found;
    for (const double bound : bounds) found.push_back(strength_of(law, bound));
    return found;
}
inline std::vector<UndrainedStrength> undrained_strengths(const Peat& law,
                                                          std::span<const Voigt> sigma,
                                                          std::span<const double>,
                                                          std::span<const double> u) {
    std::vector<UndrainedStrength> found;
    for (std::size_t i = 0; i < sigma.size(); ++i)
        found.push_back(strength_of(law, u[i] - sigma[i].head<3>().sum() / 3.0));
    return found;
}
inline UndrainedByPlace undrained_by_place(const Peat& law, OnPath part) {
    return [law, part](const Place& place, double u) {
        const UndrainedStrength found = strength_of(law, place.sigma_v0 + u);
        return part == OnPath::peak ? found.peak : found.residual;
    };
}
inline void set_s(Peat& law, double S) { law.S = S; }

/// Lack functions: all, those of memory.hpp, those of state_parameter.hpp.
struct Silent {
    mechanics::Elasticity elasticity;
};
struct SilentOfMemory : Rock {
    struct Memory {};
};
struct SilentOfPsi : Rock {
    static constexpr bool has_state_parameter = true;
};
static_assert(is_law<std::variant<NorSand, Rock>> && is_law<std::variant<Peat, PM4Sand>>);
static_assert(!is_law<std::variant<NorSand, Silent>>);
static_assert(!is_law<std::variant<NorSand, SilentOfMemory>>);
static_assert(!is_law<std::variant<NorSand, SilentOfPsi>>);

namespace {

using Laws = std::variant<LinearElastic, NorSand, Rock, Peat>;
const Place place{5.0, 0.0, 100e3};
const Voigt sigma(-90e3, -120e3, -90e3, 0.0);

TEST(AddedLaw, AnswersTheQuestionsOfEveryLaw) {
    Laws rock = Rock{{1e9, 0.25}};
    EXPECT_STREQ(traits(rock).type, "rock");
    EXPECT_EQ(elasticity(rock).E, 1e9);
    EXPECT_FALSE(limit_strength(rock));
    EXPECT_EQ(softening(std::as_const(rock)), nullptr);
    EXPECT_EQ(strength_entries(rock).c, nullptr);
    EXPECT_EQ(yield_excess(rock, State{sigma}), -1.0);
    EXPECT_EQ(return_to_surface(rock, State{sigma}), sigma);
    EXPECT_FALSE(for_particles(rock));
}

TEST(AddedLaw, WithoutAStateParameterSaysSo) {
    const Laws rock = Rock{{1e9, 0.25}};
    EXPECT_FALSE(remembers(rock));
    EXPECT_FALSE(has_state_parameter(rock));
    if_state_parameter(rock, [](const auto&) { ADD_FAILURE(); });
    EXPECT_EQ(std::get<Rock>(with_S(rock, 0.5)).elasticity.E, 1e9);
}

TEST(AddedLaw, WithAStateParameterGivesItsStrengthAtAStressAndAtAPlace) {
    const Laws peat = with_S(Laws(Peat{{{1e7, 0.3}}, 0.02}), 0.75);
    EXPECT_TRUE(remembers(peat));
    EXPECT_TRUE(has_state_parameter(peat));
    if_state_parameter(peat, [](const auto& law) {
        EXPECT_DOUBLE_EQ(psi_at(law, place), 0.1);
        const double psi = 0.0, u = 20e3;
        EXPECT_DOUBLE_EQ(undrained_strengths(law, {&sigma, 1}, {&psi, 1}, {&u, 1})[0].peak, 240e3);
        EXPECT_DOUBLE_EQ(undrained_by_place(law, OnPath::residual)(place, 20e3), 60e3);
    });
}

TEST(AddedLaw, HasMemoryThatIsBegunIntegratedAndRead) {
    const Laws peat = Peat{{{1e7, 0.3}}, 0.02};
    auto memory = memory_for(peat, 2);
    with_memory(peat, memory, [&]<class Law>(const Law& law, auto& points) {
        std::vector<typename Law::Update> updates(points.size());
        for (auto& each : points)
            each = first_memory(at_place(law, [] { return place; }), sigma, 0.0);
        const std::vector<Voigt> d_epsilon(2, Voigt(0.0, 0.0, 0.0, 1e-3));
        integrate(law, std::span<const typename Law::Memory>(points), d_epsilon,
                  std::span(updates));
        points[1] = updates[1].state;
        EXPECT_NEAR(stress(law, points[1])[3], 1e-3 * shear_modulus(law, points[1]), 1e-6);
    });
    int seen = 0;
    with_state(peat, memory, [&](const auto& law, const auto& points) {
        for (const auto& each : points) seen += instability(law, each).psi == 0.02 ? 1 : 0;
    });
    EXPECT_EQ(seen, 2);
}

}  // namespace
}  // namespace breach::materials::added_law_test
