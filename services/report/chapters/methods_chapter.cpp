// The methods of the phases that ran, with their sources.
#include <algorithm>

#include "core/phases/phases.hpp"
#include "services/report/chapters/chapters.hpp"

namespace breach::report {

using nlohmann::json;

namespace {

bool has_law(const json& scene, const std::string& type) {
    const json materials = scene.value("materials", json::object());
    return std::ranges::any_of(
        materials, [&](const json& each) { return each.at("law").value("type", "") == type; });
}

}  // namespace

void add_methods(const Material& from, Document& document) {
    Table table{"methods", "What was computed how", {"part", "method", "source"}, {}};
    const auto add = [&](const char* part, const char* method, const char* source) {
        table.rows.push_back({part, method, source});
    };
    if (phase_named(from.run, phases::lem.program))
        add("limit equilibrium",
            "Method of slices in plane strain. Bishop's simplified method on circles, also cut off "
            "at a weak layer or at firm ground; Spencer's on surfaces of straight pieces. The "
            "surface with the least factor of safety is searched for; liquefied layers then take "
            "their residual strength from the top down.",
            "Bishop (1955), Geotechnique 5(1), 7-17. Spencer (1967), Geotechnique 17(1), 11-26.");
    if (const PhaseFolder* fem = phase_named(from.run, phases::fem.program)) {
        add("finite elements",
            "Quadrilaterals in plane strain that couple the displacement of the soil with the "
            "pressure of its water (u-p), integrated in time by Newmark's method; a compliant base "
            "absorbs outgoing waves, columns of free soil hold the sides.",
            "Zienkiewicz & Shiomi (1984), Int. J. Numer. Anal. Meth. Geomech. 8(1), 71-96. McGann, "
            "Arduino & Mackenzie-Helnwein (2012), Acta Geotechnica 7, 297-311. Lysmer & Kuhlemeyer "
            "(1969), J. Eng. Mech. Div. 95(4), 859-877.");
        if (has_law(fem->scene, "pm4sand"))
            add("sand under shaking", "PM4Sand, a plasticity model for sand that liquefies",
                "Boulanger & Ziotopoulou (2017), PM4Sand version 3.1, UCD/CGM-17/01.");
        if (has_law(fem->scene, "norsand"))
            add("sand, critical state", "NorSand, by the distance from the critical state line",
                "Jefferies (1993), Geotechnique 43(1), 91-103.");
        add("transfer",
            "At the transfer time the whole state of the mesh becomes material points: mass, "
            "velocity and strain by the elements' shape functions, stress by interpolation between "
            "integration points of the same region.",
            "Sordo, Rathje & Kumar (2024), arXiv 2412.08040.");
    }
    if (phase_named(from.run, phases::mpm.program))
        add("runout",
            "Generalised interpolation material point method in plane strain, explicit in time; "
            "Mohr-Coulomb in total stress, softening with shear strain; friction on the ground.",
            "Bardenhagen & Kober (2004), CMES 5(6), 477-495. Sordo, Rathje & Kumar (2024).");
    if (table.rows.empty()) return;
    Chapter chapter{"Method and references"};
    chapter.tables.push_back(std::move(table));
    document.chapters.push_back(std::move(chapter));
}

}  // namespace breach::report
