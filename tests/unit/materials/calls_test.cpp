// Integration in sub-steps: a call ends for any behaviour of the law.
#include <gtest/gtest.h>

#include <vector>

#include "core/materials/side_by_side.hpp"

namespace breach::testing::calls_test {
namespace {

using mechanics::Voigt;

/// A law without physics. A strain of 1 takes ten steps; one of 2 begins again after every `begin`
/// and makes no progress.
namespace turning {

struct Ready {};
struct State {
    double walked = 0.0;
};
struct Options {
    int most_evaluations = 100;
};
enum class Outcome { done, refused, unresolved };
struct Update {
    State state;
    Outcome outcome = Outcome::done;
    int evaluations = 0;
};
struct Task {
    Update* update = nullptr;
    double strain = 0.0;
};

template <class R>
struct Walk {
    Walk(const Ready&, const Options&) {}
    R time, strain, evaluations;

    materials::MaskOf<R> begin(const materials::MaskOf<R>& busy) {
        evaluations = evaluations + materials::lanes::select(busy, R(1.0), R(0.0));
        return (strain > R(1.5)) & busy;
    }
    materials::MaskOf<R> advance(const materials::MaskOf<R>& moving) {
        time = time + materials::lanes::select(moving, R(0.1), R(0.0));
        return strain < R(-1.0);
    }
};

bool open_call(const Ready&, const State& old, double strain, Task& task) {
    task.update->state = old;
    task.strain = strain;
    return strain > 0.0;
}
template <class R>
void load(const Task& task, int i, Walk<R>& walk) {
    materials::lanes::set_lane(walk.time, i, 0.0);
    materials::lanes::set_lane(walk.strain, i, task.strain);
    materials::lanes::set_lane(walk.evaluations, i, 0.0);
}
template <class R>
materials::Next after_unloading(const Ready&, int, Walk<R>&, Task&) {
    return materials::Next::again;
}
template <class R>
bool ends(int i, const Walk<R>& walk, bool lost, const Options& options, Task& task) {
    const bool stuck =
        lost || materials::lanes::lane(walk.evaluations, i) > options.most_evaluations;
    if (stuck) task.update->outcome = Outcome::unresolved;
    return stuck || materials::lanes::lane(walk.time, i) > 0.95;
}
template <class R>
void store(const Ready&, int i, const Walk<R>& walk, Task& task) {
    task.update->state.walked = materials::lanes::lane(walk.time, i);
    task.update->evaluations = static_cast<int>(materials::lanes::lane(walk.evaluations, i));
}
void finish_call(const Ready&, const State& old, double, Task& task) {
    if (task.update->outcome != Outcome::done) task.update->state = old;
}
bool may_be_tried(double, const Options&) { return true; }

struct Calls {
    using Ready = turning::Ready;
    using State = turning::State;
    using Strain = double;
    using Options = turning::Options;
    using Update = turning::Update;
    using Task = turning::Task;
    template <class R>
    using Walk = turning::Walk<R>;
    static Strain strain(const Voigt& d_epsilon) { return d_epsilon[0]; }
};

}  // namespace turning

void expect_spent(const turning::Update& update) {
    EXPECT_EQ(update.outcome, turning::Outcome::unresolved);
    EXPECT_EQ(update.state.walked, 0.0) << "the state is the old one";
    EXPECT_EQ(update.evaluations, turning::Options{}.most_evaluations + 1);
}

TEST(LawCalls, APointThatTurnsWithoutEndEndsByItsEvaluations) {
    expect_spent(materials::call_alone<turning::Calls>({}, {}, 2.0, {}));
    const turning::Update walked = materials::call_alone<turning::Calls>({}, {}, 1.0, {});
    EXPECT_EQ(walked.outcome, turning::Outcome::done);
    EXPECT_NEAR(walked.state.walked, 1.0, 1e-12);
}

TEST(LawCalls, ItDoesNotDelayThoseBesideIt) {
    std::vector<turning::State> old(50);
    std::vector<Voigt> strain;
    for (int i = 0; i < 50; ++i) strain.push_back(Voigt(i % 3, 0.0, 0.0, 0.0));
    for (const materials::Width width :
         {materials::Width::portable, materials::Width::avx2, materials::Width::avx512}) {
        std::vector<turning::Update> updates(50);
        materials::call_side_by_side<turning::Calls>({}, old, strain, {}, updates, width);
        for (int i = 0; i < 50; ++i) {
            if (i % 3 == 2) {
                expect_spent(updates[i]);
                continue;
            }
            EXPECT_EQ(updates[i].outcome, turning::Outcome::done);
            EXPECT_NEAR(updates[i].state.walked, i % 3, 1e-12);
        }
    }
}

}  // namespace
}  // namespace breach::testing::calls_test
