// Archives may have been changed by another program (tests/fuzz), and their arrays index one
// another. Everything is compared with the model of the position's stage before it is used.
#include "fem_solver/checkpoint.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace breach::fem {
namespace {

using Reals = std::vector<double>;

Reals flat(const Eigen::VectorXd& v) { return {v.data(), v.data() + v.size()}; }

Eigen::VectorXd vector_from(const Reals& v) {
    return Eigen::Map<const Eigen::VectorXd>(v.data(), static_cast<Eigen::Index>(v.size()));
}

constexpr const char* flags_name = "flags";
constexpr const char* history_prefix = "history.";

void put(exchange::Archive& archive, const Position& p) {
    // The order of these numbers is the format; position_from reads them by place.
    archive.reals["position"] = {
        p.load,           p.load_step,     p.time,          p.dt,
        p.next_telemetry, p.external_work, p.internal_work, p.viscous_dissipation};
    archive.integers["position"] = {p.stage,       p.easy_steps,    p.step,
                                    p.cut_steps,   p.next_snapshot, p.telemetry_lines,
                                    p.stage_begun, p.moving,        p.at_limit};
}

Position position_from(const exchange::Archive& archive) {
    const Reals& r = archive.reals.at("position");
    const auto& i = archive.integers.at("position");
    return {.stage = i.at(0),
            .load = r.at(0),
            .load_step = r.at(1),
            .time = r.at(2),
            .dt = r.at(3),
            .easy_steps = i.at(1),
            .step = i.at(2),
            .cut_steps = i.at(3),
            .next_snapshot = i.at(4),
            .next_telemetry = r.at(4),
            .external_work = r.at(5),
            .internal_work = r.at(6),
            .viscous_dissipation = r.at(7),
            .telemetry_lines = i.at(5),
            .stage_begun = i.at(6) != 0,
            .moving = i.at(7) != 0,
            .at_limit = i.at(8) != 0};
}

constexpr const char* memory_name = "memory";

/// Memories of points, by zone. None before the first stage with the scene's laws.
void put_memory(exchange::Archive& archive, const Motion& motion) {
    if (motion.memory.empty()) return;
    Reals& numbers = archive.reals[memory_name];
    for (const materials::LawMemory& zone : motion.memory) {
        materials::for_each_point(zone, [&](const auto& point) {
            for_each_number(point, [&](double x) { numbers.push_back(x); });
        });
    }
}

void take_memory(const exchange::Archive& archive, const Model& model, Motion& motion) {
    if (!archive.reals.contains(memory_name)) return;
    const Reals& numbers = archive.reals.at(memory_name);
    std::size_t next = 0;
    for (const Zone& zone : model.zones) {
        motion.memory.push_back(
            materials::memory_for(zone.law, zone.count * model.points_per_element));
        materials::for_each_point(motion.memory.back(), [&](auto& point) {
            for_each_number(point, [&](double& x) { x = numbers.at(next++); });
        });
    }
    // Numbers left over belong to other laws or another mesh.
    if (next != numbers.size()) throw std::out_of_range(memory_name);
}

void put(exchange::Archive& archive, const Motion& motion) {
    archive.reals["u"] = flat(motion.u);
    archive.reals["v"] = flat(motion.v);
    archive.reals["a"] = flat(motion.a);
    archive.reals["force"] = flat(motion.force);
    archive.reals["p"] = flat(motion.p);
    archive.reals["p_rate"] = flat(motion.p_rate);
    Reals stress, epsilon_q, strain;
    for (const State& point : motion.points) {
        stress.insert(stress.end(), point.sigma.begin(), point.sigma.end());
        epsilon_q.push_back(point.epsilon_q);
    }
    for (const Voigt& epsilon : motion.strain) {
        strain.insert(strain.end(), epsilon.begin(), epsilon.end());
    }
    archive.reals["stress"] = std::move(stress);
    archive.reals["epsilon_q"] = std::move(epsilon_q);
    archive.reals["strain"] = std::move(strain);
    put_memory(archive, motion);
    if (motion.hourglass.empty()) return;
    Reals& hourglass = archive.reals["hourglass"];
    for (const Hourglass& h : motion.hourglass) {
        hourglass.insert(hourglass.end(), {h.force.x(), h.force.y(), h.c_s, h.energy});
    }
}

Motion motion_from(const exchange::Archive& archive, const Model& model) {
    Motion motion;
    motion.u = vector_from(archive.reals.at("u"));
    motion.v = vector_from(archive.reals.at("v"));
    motion.a = vector_from(archive.reals.at("a"));
    motion.force = vector_from(archive.reals.at("force"));
    motion.p = vector_from(archive.reals.at("p"));
    motion.p_rate = vector_from(archive.reals.at("p_rate"));
    const Reals& stress = archive.reals.at("stress");
    const Reals& strain = archive.reals.at("strain");
    const Reals& epsilon_q = archive.reals.at("epsilon_q");
    const auto tensor_at = [](const Reals& numbers, std::size_t p) {
        return Voigt(numbers.at(4 * p), numbers.at(4 * p + 1), numbers.at(4 * p + 2),
                     numbers.at(4 * p + 3));
    };
    for (std::size_t p = 0; p < epsilon_q.size(); ++p) {
        motion.points.push_back({tensor_at(stress, p), epsilon_q[p]});
        motion.strain.push_back(tensor_at(strain, p));
    }
    take_memory(archive, model, motion);
    if (!archive.reals.contains("hourglass")) return motion;
    const Reals& h = archive.reals.at("hourglass");
    for (std::size_t i = 0; i + 3 < h.size(); i += 4) {
        motion.hourglass.push_back({Vec2(h[i], h[i + 1]), h[i + 2], h[i + 3]});
    }
    return motion;
}

void put(exchange::Archive& archive, const Beginning& beginning) {
    archive.reals["beginning.base_reaction"] = flat(beginning.base_reaction);
    archive.reals["beginning.p"] = flat(beginning.p);
    archive.reals["beginning.sigma_v0"] = beginning.sigma_v0;
    archive.reals["beginning.sigma_v0_points"] = beginning.sigma_v0_points;
    archive.reals["beginning.s_u"] = beginning.s_u;
    archive.reals["beginning.skeleton_modulus"] = beginning.skeleton_modulus;
    archive.reals["beginning.base_motion"] = beginning.base_motion.velocity;
    archive.reals["beginning.base_motion.time_step"] = {beginning.base_motion.time_step};
}

Beginning beginning_from(const exchange::Archive& archive) {
    return {.base_reaction = vector_from(archive.reals.at("beginning.base_reaction")),
            .p = vector_from(archive.reals.at("beginning.p")),
            .sigma_v0 = archive.reals.at("beginning.sigma_v0"),
            .sigma_v0_points = archive.reals.at("beginning.sigma_v0_points"),
            .s_u = archive.reals.at("beginning.s_u"),
            .skeleton_modulus = archive.reals.at("beginning.skeleton_modulus"),
            .base_motion = {archive.reals.at("beginning.base_motion.time_step").at(0),
                            archive.reals.at("beginning.base_motion")}};
}

/// Arrays that do not exist before some stage may be empty.
template <class Values>
bool empty_or(const Values& values, std::size_t size) {
    return values.size() == 0 || static_cast<std::size_t>(values.size()) == size;
}

bool fits(const Position& position, const scene::Fem& fem) {
    constexpr std::int64_t most = std::int64_t{1} << 53;  // far from overflow by adding one
    const auto stages = static_cast<std::int64_t>(fem.stages.size());
    return position.stage >= 0 && position.stage < stages &&
           std::ranges::all_of(std::array{position.easy_steps, position.step, position.cut_steps,
                                          position.next_snapshot, position.telemetry_lines},
                               [](std::int64_t count) { return count >= 0 && count <= most; });
}

/// The sizes of at_rest are those of every motion of this model.
bool fits(const Motion& motion, const Model& model) {
    const Motion rest = at_rest(model);
    return motion.u.size() == rest.u.size() && motion.v.size() == rest.v.size() &&
           motion.a.size() == rest.a.size() && motion.force.size() == rest.force.size() &&
           motion.p.size() == rest.p.size() && motion.p_rate.size() == rest.p_rate.size() &&
           motion.points.size() == rest.points.size() &&
           motion.hourglass.size() == rest.hourglass.size();
}

bool fits(const Beginning& beginning, const Model& model) {
    return empty_or(beginning.base_reaction, model.mesh.nodes.size() * 2) &&
           empty_or(beginning.p, model.mesh.nodes.size()) &&
           empty_or(beginning.sigma_v0, model.body.nodes) &&
           empty_or(beginning.sigma_v0_points, model.body.elements * model.points_per_element) &&
           empty_or(beginning.s_u, model.points()) &&
           empty_or(beginning.skeleton_modulus, model.water.elements.size());
}

bool fits(const Largest& largest, const Model& model) {
    const std::size_t points = model.body.elements * model.points_per_element;
    return empty_or(largest.excess_pressure, model.body.nodes) && empty_or(largest.r_u, points) &&
           largest.shear_strain.size() == largest.r_u.size();
}

/// Everything except scene and file. Throws std::out_of_range if numbers are missing or left over.
Checkpoint read(const exchange::Archive& archive, const Model& model) {
    Checkpoint c;
    Kept& kept = c.kept;
    kept.motion = motion_from(archive, model);
    kept.beginning = beginning_from(archive);
    kept.largest = {archive.reals.at("largest.excess_pressure"), archive.reals.at("largest.r_u"),
                    archive.reals.at("largest.shear_strain")};
    kept.stage_force = vector_from(archive.reals.at("stage_force"));
    c.newton.values = archive.reals.at("newton.values");
    const Reals& rule = archive.reals.at("newton.rule");
    c.newton.rule = {rule.at(0), rule.at(1)};
    const auto& state = archive.integers.at("newton.state");
    c.newton.has_matrix = state.at(0) != 0;
    c.newton.last_iterations = static_cast<int>(state.at(1));
    const auto& counts = archive.integers.at("newton.counts");
    kept.counts = {counts.at(0), counts.at(1), counts.at(2), counts.at(3)};
    exchange::Archive history;
    for (const auto& [name, values] : archive.reals) {
        if (name.starts_with(history_prefix)) {
            history.reals[name.substr(std::string(history_prefix).size())] = values;
        }
    }
    kept.history = history_from(history);
    kept.crest_time = archive.reals.at("crest_time");
    kept.crest_acceleration = archive.reals.at("crest_acceleration");
    return c;
}

[[noreturn]] void refuse(const std::string& file, const std::string& where,
                         const std::string& cause) {
    throw fault::BadInput(file, {{where, cause, "resume with the same scene, or start afresh"}});
}

[[noreturn]] void refuse_arrays(const std::string& file) {
    refuse(file, "/breachline/reals", "the checkpoint's arrays are not those of this mesh");
}

}  // namespace

exchange::Archive checkpoint_archive(const Kept& kept, const NewtonMemory& newton,
                                     const scene::Scene& scene) {
    exchange::Archive archive;
    archive.kind = checkpoint_kind;
    archive.version = checkpoint_version;
    // The completed scene, so that a default that changed counts as another scene.
    archive.texts["scene"] = exchange::sha256_of_text(scene.completed);
    put(archive, kept.position);
    put(archive, kept.motion);
    put(archive, kept.beginning);
    archive.reals["largest.excess_pressure"] = kept.largest.excess_pressure;
    archive.reals["largest.r_u"] = kept.largest.r_u;
    archive.reals["largest.shear_strain"] = kept.largest.shear_strain;
    archive.reals["stage_force"] = flat(kept.stage_force);
    archive.reals["crest_time"] = kept.crest_time;
    archive.reals["crest_acceleration"] = kept.crest_acceleration;
    archive.reals["newton.values"] = newton.values;
    archive.reals["newton.rule"] = {newton.rule.c_a, newton.rule.c_v};
    archive.integers["newton.state"] = {newton.has_matrix, newton.last_iterations};
    const NewtonCounts& counts = kept.counts;
    archive.integers["newton.counts"] = {counts.iterations, counts.factorisations,
                                         counts.elastic_fallbacks, counts.stalled};
    for (auto& [name, values] : history_archive(kept.history, columns()).reals) {
        archive.reals[history_prefix + name] = values;
    }
    return archive;
}

void put_flags(const std::vector<fault::Flag>& flags, exchange::Archive& archive) {
    archive.texts[flags_name] = fault::as_json(flags).dump();
}

std::vector<fault::Flag> flags_in(const exchange::Archive& archive, const std::string& file) {
    const auto kept = archive.texts.find(flags_name);
    if (kept == archive.texts.end()) return {};
    try {
        return fault::flags_in(nlohmann::json::parse(kept->second));
    } catch (const nlohmann::json::exception&) {
        refuse(file, "/breachline/texts/flags", "the checkpoint's flags cannot be read");
    }
}

Position position_in(const exchange::Archive& archive, const scene::Scene& scene,
                     const std::string& file) {
    const auto scene_there = archive.texts.find("scene");
    if (scene_there == archive.texts.end() ||
        scene_there->second != exchange::sha256_of_text(scene.completed)) {
        refuse(file, "/breachline/texts/scene", "the checkpoint belongs to another scene");
    }
    try {
        const Position position = position_from(archive);
        if (fits(position, scene::fem_of(scene))) return position;
    } catch (const std::out_of_range&) {
        // A missing number; reported below.
    }
    refuse_arrays(file);
}

Checkpoint checkpoint_from(const exchange::Archive& archive, const scene::Scene& scene,
                           const Model& model, const std::string& file) {
    const Position position = position_in(archive, scene, file);
    try {
        Checkpoint checkpoint = read(archive, model);
        checkpoint.kept.position = position;
        const Kept& kept = checkpoint.kept;
        const bool whole = fits(kept.motion, model) && fits(kept.beginning, model) &&
                           fits(kept.largest, model) &&
                           empty_or(kept.stage_force, model.mesh.nodes.size() * 2) &&
                           kept.crest_time.size() == kept.crest_acceleration.size();
        if (whole) return checkpoint;
    } catch (const std::out_of_range&) {
        // A missing or short array; reported below.
    }
    refuse_arrays(file);
}

}  // namespace breach::fem
