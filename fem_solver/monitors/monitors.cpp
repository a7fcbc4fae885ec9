#include "fem_solver/monitors/monitors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "core/check/measured.hpp"
#include "core/phases/phases.hpp"

namespace breach::fem {

const std::vector<Column>& columns() {
    using R = Reading;
    struct Named {
        const char* name;
        double R::*member;
    };
    static constexpr std::array members{
        Named{"step", &R::step},
        Named{"time", &R::time},
        Named{"dt", &R::dt},
        Named{"iterations", &R::iterations},
        Named{"residual", &R::residual},
        Named{"crest_displacement", &R::crest_displacement},
        Named{"crest_dx", &R::crest_dx},
        Named{"crest_dy", &R::crest_dy},
        Named{"base_velocity", &R::base_velocity},
        Named{"kinetic_energy", &R::kinetic_energy},
        Named{"kinetic_energy_over_peak", &R::kinetic_energy_over_peak},
        Named{"external_work", &R::external_work},
        Named{"internal_work", &R::internal_work},
        Named{"viscous_dissipation", &R::viscous_dissipation},
        Named{"jacobian_ratio_avg", &R::jacobian_ratio_avg},
        Named{"jacobian_ratio_min", &R::jacobian_ratio_min},
        Named{"jacobian_centre_avg", &R::jacobian_centre_avg},
        Named{"jacobian_least_avg", &R::jacobian_least_avg},
        Named{"jacobian_least_min", &R::jacobian_least_min},
        Named{"epsilon_q_avg", &R::epsilon_q_avg},
        Named{"epsilon_q_max", &R::epsilon_q_max},
        Named{"strained_share", &R::strained_share},
        Named{"softened_share", &R::softened_share},
        Named{"psi_avg", &R::psi_avg},
        Named{"instability_ratio_max", &R::instability_ratio_max},
        Named{"past_peak_share", &R::past_peak_share},
        Named{"strength_ratio_avg", &R::strength_ratio_avg},
        Named{"strength_ratio_min", &R::strength_ratio_min},
        Named{"viscous_share", &R::viscous_share},
        Named{"excess_pressure_avg", &R::excess_pressure_avg},
        Named{"r_u_max", &R::r_u_max},
        Named{"liquefaction_depth", &R::liquefaction_depth},
        Named{"failure_surfaces", &R::failure_surfaces},
        Named{"slip_across_band", &R::slip_across_band},
        Named{"inverted_elements", &R::inverted_elements},
    };
    static const std::vector<Column> all = [] {
        std::vector<Column> made;
        for (const auto& [name, member] : members) {
            // Units and meaning are in core/telemetry/columns.hpp, which the service reads, too.
            made.push_back({*telemetry::column_named(name), member});
        }
        return made;
    }();
    return all;
}

std::vector<Column> columns_of(const scene::Scene& scene) {
    std::vector<Column> found = columns();
    std::erase_if(found, [&](const Column& each) {
        return check::why_not_measured(scene, each.needs).has_value();
    });
    return found;
}

double element_epsilon_q(const Model& model, const Motion& motion, std::size_t element) {
    const std::size_t points = model.points_per_element;
    double sum = 0.0;
    for (std::size_t g = 0; g < points; ++g) {
        sum += mechanics::epsilon_q(motion.strain[element * points + g]);
    }
    return sum / static_cast<double>(points);
}

std::vector<double> epsilon_q_of_elements(const Model& model, const Motion& motion) {
    std::vector<double> epsilon_q(model.body.elements);
    for (std::size_t e = 0; e < epsilon_q.size(); ++e) {
        epsilon_q[e] = element_epsilon_q(model, motion, e);
    }
    return epsilon_q;
}

Distortion distortion_of(const Model& model, const Motion& motion, double strain_threshold) {
    Distortion result;
    double volume = 0.0, centre = 0.0, least = 0.0;
    for (std::size_t e = 0; e < model.body.elements; ++e) {
        if (model.is_absent(e)) continue;
        const auto ratio = mechanics::jacobian_ratio(displaced_corners(model, e, motion.u),
                                                     corners_of(model.mesh, e));
        // Over all elements, strained or not: one folded corner ends the analysis.
        if (ratio.least < result.least) {
            result.least = ratio.least;
            result.worst_element = e;
        }
        if (ratio.least <= 0.0) ++result.inverted;
        if (element_epsilon_q(model, motion, e) <= strain_threshold) continue;
        volume += model.volume[e];
        centre += model.volume[e] * ratio.centre;
        least += model.volume[e] * ratio.least;
    }
    if (volume > 0.0) {
        result.centre_average = centre / volume;
        result.least_average = least / volume;
    }
    return result;
}

namespace {

/// Volumes [m3] of present elements that can soften, and of Gauss points that have.
struct Softened {
    double possible = 0.0;
    double done = 0.0;
};

Softened softened_volume(const Model& model, const Motion& motion) {
    Softened volume;
    for (const Zone& zone : model.zones) {
        const materials::Softening* softening = materials::softening(zone.law);
        if (softening == nullptr) continue;
        const std::size_t end = std::min(zone.first + zone.count, model.body.elements);
        for (std::size_t e = zone.first; e < end; ++e) {
            if (model.is_absent(e)) continue;
            volume.possible += model.volume[e];
            for (std::size_t g = 0; g < model.points_per_element; ++g) {
                const double reached = motion.points[e * model.points_per_element + g].epsilon_q;
                if (reached <= softening->epsilon_q_start) continue;
                volume.done += model.reference[e].weight[g];
            }
        }
    }
    return volume;
}

/// Over present points of the body with a state parameter.
void read_instability(const Model& model, const Motion& motion, Reading& r) {
    double volume = 0.0, psi = 0.0, past = 0.0;
    for (std::size_t z = 0; z < motion.memory.size(); ++z) {
        const Zone& zone = model.zones[z];
        const auto read = [&](const auto& law, const auto& points) {
            for (std::size_t i = 0; i < points.size(); ++i) {
                const std::size_t e = zone.first + i / model.points_per_element;
                if (e >= model.body.elements || model.is_absent(e)) continue;
                const materials::Instability at = instability(law, points[i]);
                const double w = model.reference[e].weight[i % model.points_per_element];
                volume += w;
                psi += w * at.psi;
                past += at.past_peak ? w : 0.0;
                r.instability_ratio_max = std::max(r.instability_ratio_max, at.ratio);
            }
        };
        materials::with_state(zone.law, motion.memory[z], read);
    }
    if (volume == 0.0) return;
    r.psi_avg = psi / volume;
    r.past_peak_share = past / volume;
}

/// 0 with a fixed base.
double base_velocity(const Model& model, const Motion& motion) {
    double sum = 0.0, nodes = 0.0;
    for (std::size_t i = 0; i < model.body.nodes && !model.constraints.is_base.empty(); ++i) {
        if (!model.constraints.is_base[i]) continue;
        sum += motion.v[2 * static_cast<Eigen::Index>(i)];
        nodes += 1.0;
    }
    return nodes > 0.0 ? sum / nodes : 0.0;
}

}  // namespace

Reading read_monitors(const Model& model, const Motion& motion, const Distortion& distortion,
                      std::size_t crest_node, double strain_threshold) {
    Reading r;
    const auto crest = 2 * static_cast<Eigen::Index>(crest_node);
    r.crest_dx = motion.u[crest];
    r.crest_dy = motion.u[crest + 1];
    r.crest_displacement = std::hypot(r.crest_dx, r.crest_dy);
    r.base_velocity = base_velocity(model, motion);
    // The body alone: columns of 10,000 times its thickness would dominate every energy.
    const auto dofs = static_cast<Eigen::Index>(2 * model.body.nodes);
    r.kinetic_energy =
        0.5 * (model.mass.head(dofs).array() * motion.v.head(dofs).array().square()).sum();
    r.jacobian_ratio_avg = r.jacobian_centre_avg = distortion.centre_average;
    r.jacobian_least_avg = distortion.least_average;
    r.jacobian_ratio_min = r.jacobian_least_min = distortion.least;
    r.inverted_elements = static_cast<double>(distortion.inverted);
    double strained = 0.0, weighted = 0.0, all = 0.0;
    for (std::size_t e = 0; e < model.body.elements; ++e) {
        if (model.is_absent(e)) continue;
        const double epsilon_q = element_epsilon_q(model, motion, e);
        all += model.volume[e];
        r.epsilon_q_max = std::max(r.epsilon_q_max, epsilon_q);
        if (epsilon_q <= strain_threshold) continue;
        strained += model.volume[e];
        weighted += model.volume[e] * epsilon_q;
    }
    if (strained > 0.0) r.epsilon_q_avg = weighted / strained;
    r.strained_share = strained / all;
    const Softened softened = softened_volume(model, motion);
    read_instability(model, motion, r);
    if (softened.possible > 0.0) r.softened_share = softened.done / softened.possible;
    return r;
}

nlohmann::json telemetry_line(const Reading& reading, const std::vector<Column>& columns) {
    nlohmann::json line{{"phase", phases::fem.program}};
    for (const Column& column : columns) line[column.name] = reading.*column.member;
    line["step"] = static_cast<std::int64_t>(reading.step);
    line["failure_surfaces"] = static_cast<std::int64_t>(reading.failure_surfaces);
    line["inverted_elements"] = static_cast<std::int64_t>(reading.inverted_elements);
    line["iterations"] = static_cast<std::int64_t>(reading.iterations);
    return line;
}

exchange::Archive history_archive(const std::vector<Reading>& history,
                                  const std::vector<Column>& columns) {
    exchange::Archive archive;
    archive.kind = "fem_history";
    for (const Column& column : columns) {
        std::vector<double>& values = archive.reals[column.name];
        for (const Reading& reading : history) values.push_back(reading.*column.member);
        archive.units[column.name] = column.unit;
    }
    return archive;
}

std::vector<Reading> history_from(const exchange::Archive& archive) {
    std::vector<Reading> history(archive.reals.at("step").size());
    for (const Column& column : columns()) {
        const std::vector<double>& values = archive.reals.at(column.name);
        if (values.size() != history.size()) throw std::out_of_range(column.name);
        for (std::size_t i = 0; i < history.size(); ++i) {
            history[i].*column.member = values[i];
        }
    }
    return history;
}

std::size_t nearest_node(const Mesh& mesh, const Vec2& point) {
    const auto nearer = [&](const Vec2& a, const Vec2& b) {
        return (a - point).squaredNorm() < (b - point).squaredNorm();
    };
    const auto best = std::min_element(mesh.nodes.begin(), mesh.nodes.end(), nearer);
    return static_cast<std::size_t>(best - mesh.nodes.begin());
}

double element_size_at(const Mesh& mesh, std::size_t node) {
    double sum = 0.0, edges = 0.0;
    for (const Quad& quad : mesh.quads) {
        for (std::size_t k = 0; k < 4; ++k) {
            const auto a = static_cast<std::size_t>(quad[k]);
            const auto b = static_cast<std::size_t>(quad[(k + 1) % 4]);
            if (a != node && b != node) continue;
            sum += (mesh.nodes[a] - mesh.nodes[b]).norm();
            edges += 1.0;
        }
    }
    return edges > 0.0 ? sum / edges : 0.0;
}

}  // namespace breach::fem
