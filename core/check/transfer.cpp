#include <algorithm>
#include <iterator>

#include "core/check/findings.hpp"
#include "core/check/measured.hpp"
#include "core/check/section.hpp"
#include "core/criteria/expression.hpp"
#include "core/telemetry/columns.hpp"

namespace breach::check {

namespace {

std::vector<std::string> recorded_fields() {
    std::vector<std::string> names;
    for (const telemetry::Column& column : telemetry::fem_columns())
        names.emplace_back(column.name);
    return names;
}

void check_window(const scene::Scene& scene, Findings& findings) {
    const scene::AdviceWindow& window = *scene.transfer->window;
    const std::vector<std::string> known = recorded_fields();
    const auto look = [&](const std::string& condition, const std::string& pointer) {
        try {
            const criteria::Expression parsed =
                criteria::parse(condition, criteria::Kind::condition, pointer, known);
            if (!scene.fem) return;
            std::ranges::move(unmeasured(parsed.fields, scene, pointer),
                              std::back_inserter(findings.faults));
        } catch (const fault::BadInput& error) {
            for (const fault::Fault& each : error.faults()) findings.faults.push_back(each);
        }
    };
    look(window.lower, "/transfer/window/lower");
    look(window.upper, "/transfer/window/upper");
}

/// Points know one stress: beside an effective one the pore pressure would be lost.
void check_stress(const scene::Scene& scene, Findings& findings) {
    if (scene.transfer->stress != scene::TransferredStress::effective) return;
    if (!scene.mpm || !scene.fem || !scene.fem->water) return;
    for (const scene::Soil& soil : scene::soils_of(scene)) {
        if (soil.material >= scene.materials.size()) continue;
        const scene::Material& material = scene.materials[soil.material];
        const bool frictional =
            materials::is_for_particles(material.law) && materials::traits(material.law).frictional;
        if (!frictional) continue;
        refuse(findings, "/transfer/stress",
               "is effective, and \"" + material.name +
                   "\" has friction: its points would come with pore pressure, which the MPM does "
                   "not carry",
               "transfer total stress (\"total\"), or leave out /fem/water");
        return;
    }
}

}  // namespace

void check_soils(const scene::Scene& scene, Findings& findings) {
    // Every scene has a /transfer by default; whether points are meant, the MPM or a mapping says.
    if (!scene.mpm && (!scene.transfer || scene.transfer->mapping.empty())) return;
    const std::vector<scene::Soil> soils = scene::soils_of(scene);
    for (std::size_t r = 0; r < scene.section.regions.size(); ++r) {
        if (soils[r].material >= scene.materials.size()) continue;
        const scene::Material& material = scene.materials[soils[r].material];
        if (materials::is_for_particles(material.law)) continue;
        const std::string& name = scene.section.regions[r].name;
        refuse(findings, region_pointer(r, "/material"),
               "\"" + name + "\" is of \"" + material.name + "\", whose law is " +
                   materials::traits(material.law).type + ", which material points cannot have",
               "map it in /transfer/mapping to a material of " +
                   materials::types_of_laws_that(materials::is_for_particles) +
                   ": {\"region\": \"" + name + "\", \"to\": ...}");
    }
}

void check_transfer(const scene::Scene& scene, Findings& findings) {
    const scene::Transfer& transfer = *scene.transfer;
    check_stress(scene, findings);
    if (transfer.liquefied && scene.fem && !scene.fem->water)
        refuse(findings, "/transfer/liquefied",
               "asks what has liquefied, and the FEM has no pore water",
               "add /fem/water, or leave this out");
    if (!transfer.phreatic_line.empty()) {
        const Depth deepest = deepest_below(scene, transfer.phreatic_line, level_at);
        if (deepest.below <= 0.0)
            refuse(findings, "/transfer/phreatic_line",
                   "runs below all soil, by at least " + metres(-deepest.below) +
                       ": nothing would be saturated",
                   "raise the line above the section's lowest level, " +
                       metres(extent(scene).low.y()) + ", or leave it out");
    }
    if (transfer.window) check_window(scene, findings);
}

}  // namespace breach::check
