// From the transfer to the deposit: points at t_T, runout against t_T, final geometries.
#include <algorithm>
#include <cmath>

#include "services/report/chapters.hpp"
#include "services/report/particle_figures.hpp"

namespace breach::report {

using nlohmann::json;

namespace {

double runout_of(const PhaseFolder* phase) { return phase->result.at("runout"); }
double time_of(const PhaseFolder* phase) { return phase->transfer_time.value_or(0.0); }

const PhaseFolder* nearest_in_time(const std::vector<const PhaseFolder*>& all, double t_T) {
    return *std::ranges::min_element(
        all, {}, [&](const PhaseFolder* each) { return std::abs(time_of(each) - t_T); });
}

/// The runouts to look at: those nearest to the wanted transfer times; without any, the one nearest
/// to half of the largest runout and the largest one.
std::vector<const PhaseFolder*> chosen(const std::vector<const PhaseFolder*>& all,
                                       const std::vector<double>& times) {
    std::vector<const PhaseFolder*> picked;
    const auto take = [&](const PhaseFolder* each) {
        if (std::ranges::find(picked, each) == picked.end()) picked.push_back(each);
    };
    for (const double t : times) take(nearest_in_time(all, t));
    if (times.empty()) {
        const PhaseFolder* farthest = *std::ranges::max_element(all, {}, runout_of);
        const double half = 0.5 * runout_of(farthest);
        take(*std::ranges::min_element(
            all, {}, [&](const PhaseFolder* each) { return std::abs(runout_of(each) - half); }));
        take(farthest);
    }
    return picked;
}

std::string of_transfer(const PhaseFolder* phase) {
    std::string text;
    if (phase->transfer_time) text += "t_T = " + short_number(*phase->transfer_time) + " s";
    if (!phase->variant.empty()) text += (text.empty() ? "" : ", ") + phase->variant;
    return text.empty() ? phase->label : text;
}

/// The ground before anything moved: outlines of the section.
std::vector<Series> outlines(const json& scene) {
    std::vector<Series> lines;
    for (const json& region : scene.at("section").at("regions")) {
        Series s{region.at("name").get<std::string>() + " at rest", {}, {}, Style::line};
        for (const json& p : region.at("polygon")) {
            s.x.push_back(p.at(0));
            s.y.push_back(p.at(1));
        }
        s.x.push_back(s.x.front());
        s.y.push_back(s.y.front());
        lines.push_back(std::move(s));
    }
    return lines;
}

Figure runout_against_time(const Material& from) {
    Figure figure{"runout_against_transfer_time",
                  {"Runout against transfer time", {"transfer time t_T [s]"}, {"runout [m]"}, {}},
                  "99th percentile of the mobile soil's distance beyond the toe, by mass; negative "
                  "while it lies before the toe."};
    for (const std::string& variant : variants_of(from.run)) {
        Series s{variant.empty() ? "runout" : variant, {}, {}, Style::line_and_points};
        for (const PhaseFolder* each : runouts_of(from.run, variant)) {
            if (!each->transfer_time) continue;
            s.x.push_back(*each->transfer_time);
            s.y.push_back(runout_of(each));
        }
        if (!s.x.empty()) figure.chart.series.push_back(std::move(s));
    }
    for (const auto& [key, label] :
         {std::pair{"window_lower", "window opens"}, std::pair{"window_upper", "window closes"}}) {
        if (const auto it = from.measures.find(key); it != from.measures.end()) {
            figure.chart.marks.push_back({Mark::At::x, it->second.value, label});
        }
    }
    return figure;
}

std::vector<const PhaseFolder*> first_runouts(const Run& run) {
    for (const std::string& variant : variants_of(run)) {
        if (auto found = runouts_of(run, variant); !found.empty()) return found;
    }
    return {};
}

}  // namespace

void add_transfer(const Material& from, Document& document) {
    std::vector<const PhaseFolder*> done;
    for (const PhaseFolder* each : phases_named(from.run, "transfer_tool")) {
        if (std::filesystem::is_regular_file(each->files / "particles.vtkhdf"))
            done.push_back(each);
    }
    if (done.empty()) {
        document.left_out.push_back({"material points at t_T", "the run has no transfer"});
        return;
    }
    double wanted = time_of(done.back());
    if (const auto runouts = first_runouts(from.run); !runouts.empty())
        wanted = time_of(chosen(runouts, from.choice.transfer_times).back());
    const PhaseFolder* shown = nearest_in_time(done, wanted);
    const auto file = exchange::read_particle_state(shown->files / "particles.vtkhdf");
    Chapter chapter{"Transfer",
                    "What the mesh handed to the material points (" + of_transfer(shown) + ")."};
    chapter.figures = {points_by_material(file.state, "points_at_transfer",
                                          "Material points at " + of_transfer(shown)),
                       points_by_strain(file.state, "points_at_transfer_epsilon_q",
                                        "epsilon_q of the points at " + of_transfer(shown))};
    document.chapters.push_back(std::move(chapter));
}

void add_runout(const Material& from, Document& document) {
    const auto runouts = first_runouts(from.run);
    if (runouts.empty()) {
        const PhaseFolder* mpm = phase_named(from.run, "mpm_solver");
        document.left_out.push_back(
            {"runout against transfer time, final geometries",
             mpm ? "no runout ended well: " + mpm->fault : "the run has no runout"});
        return;
    }
    Chapter chapter{"Runout"};
    Figure against = runout_against_time(from);
    if (against.chart.series.empty()) {
        document.left_out.push_back({"runout against transfer time",
                                     "the points fill the section: there is no transfer time"});
    } else {
        add_points(from.paper, against);
        chapter.figures.push_back(std::move(against));
    }
    for (const PhaseFolder* each : chosen(runouts, from.choice.transfer_times)) {
        const auto file = exchange::read_particle_state(each->files / "final.vtkhdf");
        const std::string of = each->transfer_time ? short_number(*each->transfer_time) + "s" : "";
        Figure geometry = points_by_material(file.state, "final_geometry_" + of,
                                             "Final geometry, " + of_transfer(each));
        for (Series& line : outlines(each->scene)) geometry.chart.series.push_back(std::move(line));
        geometry.caption += " Runout " + rounded(runout_of(each), 4) + " m; lines: the section.";
        chapter.figures.push_back(std::move(geometry));
        chapter.figures.push_back(points_by_strain(
            file.state, "final_epsilon_q_" + of, "epsilon_q of the deposit, " + of_transfer(each)));
    }
    document.chapters.push_back(std::move(chapter));
}

}  // namespace breach::report
