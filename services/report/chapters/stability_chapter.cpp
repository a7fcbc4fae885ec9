// Limit equilibrium: section, critical surfaces, factor of safety against liquefied depth.
#include "core/phases/phases.hpp"
#include "services/report/chapters/chapters.hpp"
#include "services/report/figures/stability_figures.hpp"

namespace breach::report {

void add_stability(const Material& from, Document& document) {
    const PhaseFolder* lem = phase_shown(from.run, phases::lem.program);
    if (!lem || !lem->result.is_object()) {
        document.left_out.push_back(
            {"section and critical surfaces, factor of safety against liquefied depth",
             lem ? "lem_tool: " + lem->fault
                 : "the run has no limit equilibrium (the study's \"stability\", the scene's "
                   "/lem)"});
        return;
    }
    Chapter chapter{"Stability", which_of_several(from.run, *lem, "stability analyses")};
    chapter.figures = stability_figures(lem->files);
    for (Figure& each : chapter.figures) {
        add_points(from.paper, each);
        if (each.name == "safety_against_depth") {
            each.caption =
                "Factor of safety of the critical surface while layers liquefy from the "
                "top down.";
        } else {
            each.caption =
                "The critical surface of each stage, and of the other kinds before any layer "
                "liquefies.";
        }
    }
    if (!lem->result.contains("stages")) {
        document.left_out.push_back({"factor of safety against liquefied depth",
                                     "the scene liquefies no layers (/lem/liquefaction)"});
    }
    document.chapters.push_back(std::move(chapter));
}

}  // namespace breach::report
