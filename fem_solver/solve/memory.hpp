// Zones with laws whose points have a memory besides State (core/materials/memory.hpp): the switch
// from the elastic stages to these laws, and their integration over a zone. Motion::memory has the
// memories; State mirrors their stress.
// begin_stage.cpp calls begin_memory once; InternalForce calls MemoryPass for each zone and
// iteration.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "fem_solver/model/model.hpp"
#include "fem_solver/solve/ranges.hpp"

namespace breach::fem {

bool has_memory(const Model& model);

/// "PM4Sand": names of the laws with memory, each once.
std::string names_of_laws_with_memory(const Model& model);

/// Constant stress that the switch kept because it lay outside the law's surfaces.
struct StressBias {
    std::size_t points = 0;
    double largest = 0.0;      ///< largest component [Pa]
    std::size_t cut_down = 0;  ///< points whose stress the law reduced
    double largest_cut = 0.0;  ///< largest reduction of a component [Pa]
};

/// Creates the memory of every point of these zones from the stress and volumetric strain of the
/// elastic stages. Does nothing if it exists: exactly one call per point and run.
StressBias begin_memory(const Model& model, Motion& motion);

StressBias stress_bias(const Model& model, const Motion& motion);

/// Number of points that a law moved to their critical state because it could not integrate their
/// strain.
std::size_t fallen_points(const Model& model, const Motion& motion);

std::size_t points_with_memory(const Model& model, const Motion& motion);

/// Runs laws over zones, with reusable buffers.
class MemoryPass {
  public:
    /// team: its size does not change the results.
    explicit MemoryPass(const Model& model,
                        std::shared_ptr<numerics::Team> team = std::make_shared<numerics::Team>(1));

    enum class Answer {
        done,
        /// a strain increment is too large or not finite, or needs too many evaluations: cut the
        /// step
        refused,
    };
    /// New memories and stresses of zone `z` after strain increments of its points.
    template <materials::Remembers Law>
    Answer integrate(const Law& law, std::size_t z, std::span<const Voigt> d_epsilon,
                     const Motion& old, Motion& trial);

    /// Larger strain increments belong to a diverged trial [-]; integrating them would be expensive
    /// and useless.
    static constexpr double largest_strain = 0.05;

    /// Why and where a law refused the last step.
    struct Refusal {
        enum class Why {
            strain,       ///< an increment beyond largest_strain, or not finite
            evaluations,  ///< too many evaluations
        };
        Why why = Why::strain;
        const char* law = "";  ///< for display
        std::size_t element = 0;
        double largest = 0.0;  ///< component of its strain increment [-]
    };
    const Refusal& refusal() const { return refusal_; }

    std::int64_t evaluations() const { return evaluations_; }

  private:
    template <class Law>
    struct Buffer {};
    template <materials::Remembers Law>
    struct Buffer<Law> {
        std::vector<typename Law::Update> updates;
    };
    template <class... Each>
    static std::tuple<Buffer<Each>...> buffers_of(const std::variant<Each...>*);

    Answer refuse(Refusal::Why why, const char* law, const Zone& zone, std::size_t point,
                  const Voigt& d_epsilon);
    /// The first increment that is too large for the laws; the number of increments if none is.
    static std::size_t first_too_large(std::span<const Voigt> d_epsilon);

    const Model& model_;
    std::size_t points_;  ///< per element
    std::shared_ptr<numerics::Team> team_;
    Refusal refusal_;
    decltype(buffers_of(static_cast<const materials::Law*>(nullptr))) buffers_;
    std::int64_t evaluations_ = 0;
};

template <materials::Remembers Law>
MemoryPass::Answer MemoryPass::integrate(const Law& law, std::size_t z,
                                         std::span<const Voigt> d_epsilon, const Motion& old,
                                         Motion& trial) {
    const Zone& zone = model_.zones[z];
    const char* name = traits(law).name;
    if (const std::size_t i = first_too_large(d_epsilon); i < d_epsilon.size())
        return refuse(Refusal::Why::strain, name, zone, i, d_epsilon[i]);
    // The first step after the switch: `trial` is older than the memories.
    if (trial.memory.size() != old.memory.size()) trial.memory = old.memory;
    const std::span from(std::get<materials::ZoneMemory<Law>>(old.memory[z]).points);
    const std::span to(std::get<materials::ZoneMemory<Law>>(trial.memory[z]).points);
    const std::span updates =
        std::span(std::get<Buffer<Law>>(buffers_).updates).first(d_epsilon.size());
    const std::size_t first = zone.first * points_;
    for_ranges(updates.size(), *team_, [&](std::size_t begin, std::size_t end) {
        const std::size_t count = end - begin;
        materials::integrate(law, from.subspan(begin, count), d_epsilon.subspan(begin, count),
                             updates.subspan(begin, count));
    });
    for (std::size_t i = 0; i < updates.size(); ++i) {
        const auto& each = updates[i];
        if (each.outcome != decltype(each.outcome)::done)
            return refuse(Refusal::Why::evaluations, name, zone, i, d_epsilon[i]);
        evaluations_ += each.counts.evaluations;
        to[i] = each.state;
        trial.points[first + i].sigma = materials::stress(law, each.state);
    }
    return Answer::done;
}

/// Message: strain limit or evaluations, and where.
std::string in_words(const MemoryPass::Refusal& refusal);

}  // namespace breach::fem
