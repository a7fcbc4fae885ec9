// From the transfer to the deposit: points at t_T, runout against t_T, final geometries.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/phases/files.hpp"
#include "core/phases/phases.hpp"
#include "services/report/chapters/chapters.hpp"
#include "services/report/figures/particle_figures.hpp"
#include "services/report/figures/transfer_figures.hpp"
#include "services/report/read/verdict.hpp"

namespace breach::report {

using nlohmann::json;

namespace {

double time_of(const PhaseFolder* phase) { return phase->transfer_time.value_or(0.0); }

const PhaseFolder* nearest_in_time(const std::vector<const PhaseFolder*>& all, double t_T) {
    return *std::ranges::min_element(
        all, {}, [&](const PhaseFolder* each) { return std::abs(time_of(each) - t_T); });
}

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

double number_in(const json& row, const char* key) {
    const json value = row.value(key, json());
    return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

/// Mean and scatter of the repeats, one curve per variant.
std::vector<Series> curves_of_means(const Run& run) {
    std::vector<Series> curves;
    for (const json& mean : run.means) {
        if (!mean.at("runout").is_number()) continue;
        const std::string variant = mean.at("variant");
        const std::string name = variant.empty() ? "mean of the repeats" : variant;
        auto curve = std::ranges::find(curves, name, &Series::name);
        if (curve == curves.end())
            curve = curves.insert(curve, Series{name, {}, {}, Style::line_and_points});
        curve->x.push_back(mean.at("transfer_time"));
        curve->y.push_back(mean.at("runout"));
        curve->error.push_back(number_in(mean, "runout_deviation"));
        const bool whole = mean.at("missing_draws") == "" && mean.at("questionable_draws") == "";
        curve->certainty.push_back(any_moves(draws_of(run, mean)) ? Certainty::at_least
                                   : whole                        ? Certainty::certain
                                                                  : Certainty::doubtful);
    }
    return curves;
}

/// One curve per variant, with the certainty of each runout.
std::vector<Series> curves_of_runs(const Run& run) {
    std::vector<Series> curves;
    for (const std::string& variant : variants_of(run)) {
        Series s{variant.empty() ? "runout" : variant, {}, {}, Style::line_and_points};
        for (const PhaseFolder* each : runouts_of(run, variant)) {
            if (!each->transfer_time) continue;
            s.x.push_back(*each->transfer_time);
            s.y.push_back(runout_of(each));
            s.certainty.push_back(certainty_of(*each));
            s.error.push_back(
                each->runout_error.value_or(std::numeric_limits<double>::quiet_NaN()));
        }
        if (std::ranges::all_of(s.error, [](double e) { return std::isnan(e); })) s.error.clear();
        const auto certain = [](Certainty each) { return each == Certainty::certain; };
        if (std::ranges::all_of(s.certainty, certain)) s.certainty.clear();
        if (!s.x.empty()) curves.push_back(std::move(s));
    }
    return curves;
}

Figure runout_against_time(const Material& from) {
    const char* of_means =
        "99th percentile of the mobile soil's distance beyond the toe, by mass: mean over the "
        "repeats, each on a lattice of points of its own; the band is the standard deviation of "
        "one repeat. Hollow with an arrow: soil of a repeat still moved, the mean is a lower "
        "bound; "
        "hollow and dashed: a repeat has no result, or one that is questionable (table of means).";
    const char* of_runs =
        "99th percentile of the mobile soil's distance beyond the toe, by mass; negative "
        "while it lies before the toe. Hollow with an arrow: the soil still moved, the runout "
        "is a lower bound; hollow and dashed: questionable (table of flags); pale: its "
        "result carries no flags. Where an accuracy study, repeats or the neighbours in "
        "transfer time tell the error of one run, it is drawn as a band.";
    Figure figure{std::string(runout_figure),
                  {"Runout against transfer time",
                   {"transfer time t_T [s]"},
                   {"runout [m]"},
                   runout_curves(from.run)},
                  from.run.means.empty() ? of_runs : of_means};
    mark_window(window_in(from.measures), figure.chart.marks);
    return figure;
}

/// Before and after the transfer, from the snapshot of the run's FEM; without the snapshot notes
/// why it is left out.
void add_before_and_after(const Material& from, const PhaseFolder& transfer,
                          const exchange::ParticleState& points, Chapter& chapter,
                          Document& document) {
    const PhaseFolder* source = source_of(from.run, transfer);
    const PhaseFolder* fem =
        source ? source : phase_of_variant(from.run, phases::fem.program, transfer.variant);
    for (const TimedFile& each :
         fem ? timed_files(fem->files, phases::files::snapshot_prefix) : std::vector<TimedFile>{}) {
        if (std::abs(each.time - points.transfer_time) > 1e-6) continue;
        const auto mesh = exchange::read_mesh_snapshot(each.file).snapshot;
        for (BeforeAndAfter& pair : compare(mesh, points, layers_of(transfer.scene))) {
            chapter.figures.push_back(std::move(pair.before));
            chapter.figures.push_back(std::move(pair.after));
        }
        if (points.r_u.empty()) {
            document.left_out.push_back(
                {"liquefied zone before and after the transfer", "the points carry no r_u: dry"});
        }
        return;
    }
    document.left_out.push_back({"fields before and after the transfer",
                                 "the run has no snapshot at " + of_transfer(transfer)});
}

/// Runouts of the variant that runs farthest; for a static scene, with one runout per variant, all.
std::vector<const PhaseFolder*> runouts_shown(const Run& run) {
    if (is_static(run)) {
        std::vector<const PhaseFolder*> all;
        for (const std::string& variant : variants_of(run))
            std::ranges::copy(runouts_of(run, variant), std::back_inserter(all));
        return all;
    }
    const PhaseFolder* farthest = farthest_runout(run);
    return farthest ? runouts_of(run, farthest->variant) : std::vector<const PhaseFolder*>{};
}

std::string window_text(const Measures& measures) {
    const WindowEdges window = window_in(measures);
    if (!window.lower) return "";
    if (window.is_none())
        return "By its criteria there is no window of transfer times: the mesh is too distorted "
               "from " +
               short_number(*window.upper) + " s on, and the failure is developed at " +
               short_number(*window.lower) + " s.";
    return "The window of transfer times opens at " + short_number(*window.lower) + " s and " +
           (window.upper ? "closes at " + short_number(*window.upper) + " s."
                         : "stays open to the end of the FEM.");
}

}  // namespace

std::vector<Series> runout_curves(const Run& run) {
    return run.means.empty() ? curves_of_runs(run) : curves_of_means(run);
}

std::string file_word(const PhaseFolder& mpm) {
    if (mpm.transfer_time) return short_number(*mpm.transfer_time) + "s";
    return mpm.variant.empty() ? "filled" : "filled_" + mpm.variant;
}

Series section_at_rest(const json& scene) {
    Series s{"section at rest", {}, {}, Style::segments};
    const auto add = [&](const json& point) {
        s.x.push_back(point.at(0));
        s.y.push_back(point.at(1));
    };
    for (const json& region : scene.at("section").at("regions")) {
        const json& polygon = region.at("polygon");
        for (std::size_t k = 0; k < polygon.size(); ++k) {
            add(polygon[k]);
            add(polygon[(k + 1) % polygon.size()]);
        }
    }
    return s;
}

std::string of_transfer(const PhaseFolder& phase) {
    std::string text;
    if (phase.transfer_time) text += "t_T = " + short_number(*phase.transfer_time) + " s";
    if (!phase.variant.empty()) text += (text.empty() ? "" : ", ") + phase.variant;
    return text.empty() ? phase.label : text;
}

std::vector<const PhaseFolder*> chosen_runouts(const Material& from) {
    const auto all = runouts_shown(from.run);
    return all.empty() ? all : chosen(all, from.choice.transfer_times);
}

void add_transfer(const Material& from, Document& document) {
    std::vector<const PhaseFolder*> done;
    for (const PhaseFolder* each : phases_named(from.run, phases::transfer.program)) {
        if (std::filesystem::is_regular_file(each->files / phases::files::particles))
            done.push_back(each);
    }
    if (done.empty()) {
        document.left_out.push_back({"material points at t_T", "the run has no transfer"});
        return;
    }
    const PhaseFolder* shown = done.back();
    if (const auto runouts = chosen_runouts(from); !runouts.empty()) {
        const PhaseFolder* source = source_of(from.run, *runouts.back());
        const bool has_points = std::ranges::find(done, source) != done.end();
        shown = has_points ? source : nearest_in_time(done, time_of(runouts.back()));
    }
    const auto file = exchange::read_particle_state(shown->files / phases::files::particles);
    Chapter chapter{"Transfer",
                    "What the mesh handed to the material points (" + of_transfer(*shown) + ")."};
    chapter.figures = {points_by_material(file.state, "points_at_transfer",
                                          "Material points at " + of_transfer(*shown)),
                       points_by_strain(file.state, "points_at_transfer_epsilon_q",
                                        "epsilon_q of the points at " + of_transfer(*shown))};
    add_before_and_after(from, *shown, file.state, chapter, document);
    document.chapters.push_back(std::move(chapter));
}

void add_runout(const Material& from, Document& document) {
    const auto runouts = chosen_runouts(from);
    if (runouts.empty()) {
        const PhaseFolder* mpm = phase_named(from.run, phases::mpm.program);
        document.left_out.push_back(
            {"runout against transfer time, final geometries",
             mpm ? "no runout ended well: " + mpm->fault : "the run has no runout"});
        return;
    }
    Chapter chapter{"Runout", window_text(from.measures)};
    if (Figure against = is_static(from.run) ? Figure{} : runout_against_time(from);
        !against.chart.series.empty()) {
        add_points(from.paper, against);
        chapter.figures.push_back(std::move(against));
    }
    for (const PhaseFolder* each : runouts) {
        const auto file = exchange::read_particle_state(each->files / phases::files::final_state);
        const std::string of = file_word(*each);
        Figure geometry = points_by_material(file.state, "final_geometry_" + of,
                                             "Final geometry, " + of_transfer(*each));
        geometry.chart.series.push_back(section_at_rest(each->scene));
        geometry.caption += " Runout " + bounded(*each, rounded(runout_of(each), 4)) + " m" +
                            (still_moves(*each) ? ", a lower bound: the soil still moved" : "") +
                            "; lines: the section at rest.";
        chapter.figures.push_back(std::move(geometry));
        chapter.figures.push_back(
            points_by_strain(file.state, "final_epsilon_q_" + of,
                             "epsilon_q of the deposit, " + of_transfer(*each)));
    }
    document.chapters.push_back(std::move(chapter));
}

}  // namespace breach::report
