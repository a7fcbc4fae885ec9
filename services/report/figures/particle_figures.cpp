#include "services/report/figures/particle_figures.hpp"

#include <map>

#include "services/report/figures/mesh_figures.hpp"

namespace breach::report {

using exchange::ParticleState;

namespace {

constexpr std::size_t most_points = 15'000;  // more are slow and look the same

std::size_t stride_of(const ParticleState& state) {
    return (state.size() + most_points - 1) / most_points;
}

std::string drawn(const ParticleState& state) {
    const std::size_t stride = stride_of(state);
    std::string text = std::to_string(state.size()) + " material points";
    if (stride > 1) text += ", one in " + std::to_string(stride) + " drawn";
    return text + ".";
}

Chart empty_chart(const std::string& title) {
    return {title, {"x [m]"}, {"y [m]"}, {}, {}, Aspect::equal};
}

}  // namespace

Figure points_by_material(const ParticleState& state, const std::string& name,
                          const std::string& title) {
    std::map<std::string, Series> by_material;
    for (std::size_t p = 0; p < state.size(); p += stride_of(state)) {
        const std::string& material =
            state.materials_of_regions[static_cast<std::size_t>(state.region[p])];
        Series& s = by_material[material];
        s.x.push_back(state.position[p].x());
        s.y.push_back(state.position[p].y());
    }
    Figure figure{name, empty_chart(title), drawn(state)};
    for (auto& [material, s] : by_material) {
        s.name = material;
        s.style = Style::dots;
        figure.chart.series.push_back(std::move(s));
    }
    return figure;
}

Figure points_by_strain(const ParticleState& state, const std::string& name,
                        const std::string& title) {
    Field field{"epsilon_q [%]", 1, {}, {}, {}, {0.0, 1.0}};
    for (std::size_t p = 0; p < state.size(); p += stride_of(state)) {
        field.x.push_back(state.position[p].x());
        field.y.push_back(state.position[p].y());
        field.value.push_back(100.0 * state.epsilon_q[p]);
    }
    field.range = colour_range(field.value);
    Figure figure{name, empty_chart(title), drawn(state)};
    figure.chart.field = std::move(field);
    return figure;
}

}  // namespace breach::report
