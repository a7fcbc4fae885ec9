#include "services/report/run_report.hpp"

#include <algorithm>

#include "core/exchange/publish.hpp"
#include "core/fault/fault.hpp"
#include "core/phases/phases.hpp"
#include "services/report/chart/page.hpp"
#include "services/report/chart/png.hpp"
#include "services/report/read/verdict.hpp"

namespace breach::report {

namespace {

/// Adds another run's runouts to this run's figure; without such a figure nothing.
void lay_over(const Run& other, Document& document) {
    for (Chapter& chapter : document.chapters) {
        const auto figure = std::ranges::find(chapter.figures, runout_figure, &Figure::name);
        if (figure == chapter.figures.end()) continue;
        for (Series& each : runout_curves(other)) {
            each.name = other.name + ", " + each.name;
            figure->chart.series.push_back(std::move(each));
        }
    }
}

/// Adds another run's runouts, grounds and variants under its name.
void add_companion(const std::filesystem::path& folder, const std::optional<Paper>& paper,
                   Document& document) {
    const Run run = read_run(folder);
    const Measures measures = measures_of(run, paper);
    const Choice choice;
    const Material material{run, paper, measures, choice};
    lay_over(run, document);
    Document other{run.title, {}, {}, {}};
    add_ground(material, other);
    add_variants(material, other);
    if (other.chapters.empty()) {
        document.left_out.push_back({"variants of " + folder.string(), "its study has none"});
    }
    for (Chapter& chapter : other.chapters) {
        chapter.text = run.title + ". " + chapter.text;
        chapter.title += ": " + run.name;
        for (Figure& each : chapter.figures) each.name += "_" + run.name;
        for (Table& each : chapter.tables) each.name += "_" + run.name;
        document.chapters.push_back(std::move(chapter));
    }
}

Document filled(const Run& run, const Choice& choice) {
    const std::optional<Paper> paper = paper_for(run.scene.at("name"));
    const Measures measures = measures_of(run, paper);
    Document document{run.title, {}, {}, {}, verdict_of(run), front_of(run)};
    if (paper) {
        document.remarks.insert(document.remarks.end(), paper->remarks.begin(),
                                paper->remarks.end());
    }
    const Material material{run, paper, measures, choice};
    for (const auto add : {add_assessment, add_inputs, add_stability, add_element_tests})
        add(material, document);
    if (is_static(run)) {
        document.left_out.push_back({"motion, course of the finite elements, meshes and transfers",
                                     "the scene is static: it has no FEM"});
    } else {
        for (const auto add : {add_motion, add_motions, add_shaking, add_mesh, add_transfer})
            add(material, document);
    }
    if (phase_named(run, phases::mpm.program)) {
        for (const auto add : {add_runout, add_ground, add_flow, add_outflow})
            add(material, document);
    } else {
        document.left_out.push_back({"runout, flow and deposit", "the run has no runout"});
    }
    for (const auto add : {add_variants, add_checklist, add_methods, add_numbers})
        add(material, document);
    for (const auto& each : choice.companions) add_companion(each, paper, document);
    add_annex(material, document);
    return document;
}

}  // namespace

Document document_of(const Run& run, const Choice& choice) {
    try {
        return filled(run, choice);
    } catch (const nlohmann::json::exception& error) {
        throw fault::BadInput(run.folder.string(),
                              {{"", error.what(), "run its phases again with this version"}});
    }
}

void write_report(Document document, const std::filesystem::path& page, Files files) {
    if (std::filesystem::is_directory(page)) {
        throw fault::IoError(page.string() + ": is a folder; give the page's file name");
    }
    if (files == Files::none) return exchange::publish_text(page, as_html(document, ""));
    const std::string folder_name = page.stem().string() + "_files";
    const std::filesystem::path folder = page.parent_path() / folder_name;
    const bool draws = png_converter() == Converter::there;
    if (!draws) {
        document.left_out.push_back(
            {"figures as PNG", "rsvg-convert is not installed (Debian: librsvg2-bin)"});
    }
    const auto write = [&](const std::vector<Figure>& figures) {
        write_figures(folder, figures);
        for (const Figure& each : figures)
            if (draws) write_png(folder / (each.name + ".svg"), folder / (each.name + ".png"));
    };
    write(document.front.pictures);
    for (const Chapter& chapter : document.chapters) {
        write(chapter.figures);
        for (const Table& each : chapter.tables) {
            exchange::publish_text(folder / (each.name + ".csv"), as_csv(each));
        }
    }
    for (const Table* each : {&document.front.found, &document.front.gauges})
        if (!each->rows.empty())
            exchange::publish_text(folder / (each->name + ".csv"), as_csv(*each));
    exchange::publish_text(page, as_html(document, folder_name));
}

}  // namespace breach::report
