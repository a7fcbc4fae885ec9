// What lies downstream must know: how deep, how fast, when, and what stays.
#include "services/report/chapters.hpp"
#include "services/report/particle_figures.hpp"

namespace breach::report {

using nlohmann::json;

void add_flow(const Material& from, Document& document) {
    Figure deposit{"deposit_profile",
                   {"Surface of the deposit", {"x [m]"}, {"y [m]"}, {}, {}, Aspect::equal},
                   "Highest point of the mobile soil in each column of one cell's width."};
    for (const std::string& variant : variants_of(from.run)) {
        const auto runouts = runouts_of(from.run, variant);
        if (runouts.empty()) continue;
        const PhaseFolder* last = runouts.back();
        const json& mpm = last->scene.at("mpm");
        const auto file = exchange::read_particle_state(last->files / "final.vtkhdf");
        deposit.chart.series.push_back(
            surface_of(file.state, mpm.at("cell_size"),
                       mpm.at("runout").value("regions", std::vector<std::string>{}), last->label));
    }
    if (deposit.chart.series.empty()) {
        document.left_out.push_back({"deposit profile", "no runout ended well"});
        return;
    }
    Chapter chapter{"Flow and deposit"};
    chapter.figures.push_back(std::move(deposit));
    document.chapters.push_back(std::move(chapter));
}

}  // namespace breach::report
