#include <algorithm>

#include "transfer_tool/run.hpp"

namespace breach::transfer {
namespace {

using process::PlanLine;
using process::Use;

bool yields(const scene::Material& material) {
    return std::holds_alternative<materials::MohrCoulomb>(material.law);
}

bool softens(const scene::Material& material) {
    const auto* law = std::get_if<materials::MohrCoulomb>(&material.law);
    return law != nullptr && law->softening.has_value();
}

PlanLine interpolation_line(const scene::Transfer& settings) {
    if (settings.interpolation == scene::Interpolation::paper)
        return {"interpolation across region borders", Use::on,
                "\"paper\": one multiquadric through all Gauss points", "/transfer/interpolation"};
    return {"interpolation across region borders", Use::left_out,
            "\"local\": the " + std::to_string(settings.neighbours) +
                " nearest Gauss points of the same region",
            "/transfer/interpolation"};
}

PlanLine gauss_line(const scene::Transfer& settings) {
    const bool same =
        settings.interpolation == scene::Interpolation::local && settings.points_per_direction == 2;
    if (same)
        return {"radial basis functions", Use::left_out,
                "2 points per direction lie at the FEM's own Gauss points and take their values",
                "/transfer/points_per_direction"};
    return {"radial basis functions", Use::on,
            std::to_string(settings.points_per_direction) + " points per direction",
            "/transfer/points_per_direction"};
}

PlanLine softening_line(const scene::Scene& scene, const scene::Transfer& settings) {
    if (std::ranges::none_of(scene.materials, softens))
        return {"softening carried over", Use::left_out, "no material softens", "/materials"};
    if (settings.softening_start == scene::SofteningStart::zero)
        return {"softening carried over", Use::left_out, "\"zero\": it starts anew in the MPM",
                "/transfer/softening_start"};
    return {"softening carried over", Use::on, "\"carried\": the FEM's epsilon_q goes on",
            "/transfer/softening_start"};
}

}  // namespace

process::Plan plan(const scene::Scene& scene) {
    const scene::Transfer& settings = scene::transfer_of(scene);
    const bool any_yields = std::ranges::any_of(scene.materials, yields);
    return {{"return to the yield surface", any_yields ? Use::on : Use::left_out,
             any_yields ? "a Mohr-Coulomb material" : "all materials are elastic", "/materials"},
            softening_line(scene, settings),
            gauss_line(settings),
            interpolation_line(settings),
            {"pore pressure", Use::left_out, "every material is dry or drained", "/materials"},
            {"liquefied layers", Use::left_out, "no material liquefies", "/materials"}};
}

}  // namespace breach::transfer
