// Contours of epsilon_q and r_u and the deformed mesh at chosen snapshots of the FEM.
#include <algorithm>
#include <cmath>

#include "core/fault/fault.hpp"
#include "core/phases/files.hpp"
#include "core/phases/phases.hpp"
#include "services/report/chapters/chapters.hpp"
#include "services/report/figures/mesh_figures.hpp"

namespace breach::report {

using exchange::MeshSnapshot;

namespace {

/// The snapshots nearest to the requested times; without any, four over the run with its end.
std::vector<TimedFile> chosen(const std::vector<TimedFile>& all, const std::vector<double>& times) {
    std::vector<TimedFile> picked;
    const auto take = [&](const TimedFile& each) {
        if (picked.empty() || picked.back().file != each.file) picked.push_back(each);
    };
    for (const double t : times) {
        take(*std::ranges::min_element(
            all, {}, [&](const TimedFile& each) { return std::abs(each.time - t); }));
    }
    if (times.empty()) {
        const std::size_t wanted = std::min<std::size_t>(4, all.size());
        for (std::size_t k = 1; k <= wanted; ++k) take(all[k * all.size() / wanted - 1]);
    }
    return picked;
}

std::string time_text(double time) { return short_number(time) + " s"; }

Chart empty_chart(const std::string& title) {
    return {title, {"x [m]"}, {"y [m]"}, {}, {}, Aspect::equal};
}

Figure contour(const MeshSnapshot& mesh, const std::string& name, std::vector<double> value,
               const std::string& label, const Range& range) {
    Figure figure{name + "_" + short_number(mesh.time) + "s",
                  empty_chart(label + " at " + time_text(mesh.time))};
    figure.chart.field = on_deformed_mesh(mesh, std::move(value), label, range);
    figure.chart.series = {borders_of(mesh)};
    figure.caption =
        "Element averages on the mesh where it has moved to; displacements are not exaggerated.";
    return figure;
}

Figure deformed_mesh(const MeshSnapshot& mesh) {
    Figure figure{"mesh_" + short_number(mesh.time) + "s",
                  empty_chart("Deformed mesh at " + time_text(mesh.time))};
    figure.chart.series = {edges_of(mesh)};
    figure.caption =
        std::to_string(mesh.quads.size()) + " elements; displacements are not exaggerated.";
    return figure;
}

}  // namespace

void add_mesh(const Material& from, Document& document) {
    const PhaseFolder* fem = phase_shown(from.run, phases::fem.program);
    const auto files =
        fem ? timed_files(fem->files, phases::files::snapshot_prefix) : std::vector<TimedFile>{};
    if (files.empty()) {
        document.left_out.push_back({"contours of epsilon_q and r_u, deformed meshes",
                                     fem ? "the FEM left no snapshot" : "the run has no FEM"});
        return;
    }
    std::vector<MeshSnapshot> meshes;
    for (const TimedFile& each : chosen(files, from.choice.snapshot_times)) {
        meshes.push_back(exchange::read_mesh_snapshot(each.file).snapshot);
    }
    Chapter chapter{"Strain, pore pressure and mesh",
                    which_of_several(from.run, *fem, "finite element analyses") +
                        std::to_string(meshes.size()) + " of " + std::to_string(files.size()) +
                        " snapshots; colours have one scale for all times of a quantity."};
    const Range strains = colour_range(element_epsilon_q(meshes.back()));
    for (const MeshSnapshot& each : meshes) {
        chapter.figures.push_back(
            contour(each, "epsilon_q", element_epsilon_q(each), "epsilon_q [%]", strains));
    }
    for (const MeshSnapshot& each : meshes) {
        std::vector<double> r_u = element_r_u(each);
        if (r_u.empty()) continue;
        chapter.figures.push_back(contour(each, "r_u", std::move(r_u), "r_u [-]", {0.0, 1.0}));
    }
    if (element_r_u(meshes.back()).empty()) {
        document.left_out.push_back({"contours of r_u", "the mesh carries no pore pressure: dry"});
    }
    for (const MeshSnapshot& each : meshes) chapter.figures.push_back(deformed_mesh(each));
    document.chapters.push_back(std::move(chapter));
}

}  // namespace breach::report
