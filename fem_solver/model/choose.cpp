#include "fem_solver/model/choose.hpp"

namespace breach::fem {

namespace {

using process::Decided;
using process::line_of;
using process::Use;
using process::use_if;

/// An optional part of the scene; on if it exists.
template <class Part>
Decided<std::optional<Part>> part(const std::optional<Part>& value, const std::string& feature,
                                  const process::Reasons& reasons, const std::string& pointer) {
    return {value, line_of(feature, use_if(value.has_value()), reasons, pointer)};
}

Decided<ElementChoice> element_of(const scene::Fem& fem) {
    const std::string feature = "single-point quads, stabilised", pointer = "/fem/element";
    switch (fem.element) {
        case scene::ElementKind::bbar:
            return {std::nullopt,
                    {feature, Use::left_out, "2 x 2 Gauss points, mean dilatation", pointer}};
        case scene::ElementKind::ssp:
            break;
    }
    switch (fem.hourglass) {
        case scene::HourglassKind::elastic:
            return {HourglassModulus::elastic,
                    {feature, Use::on, "asked for; the stabilisation stays elastic", pointer}};
        case scene::HourglassKind::current:
            break;
    }
    return {HourglassModulus::current,
            {feature, Use::on, "asked for; the stabilisation follows the soil's shear modulus",
             pointer}};
}

}  // namespace

ModelDecisions decide_model(const scene::Scene& scene) {
    const scene::Fem& fem = scene::fem_of(scene);
    // /fem/damping has become the stiffness coefficient when the scene was read.
    const bool damped = fem.rayleigh_mass > 0.0 || fem.rayleigh_stiffness > 0.0;
    const std::string no_motion =
        fem.base ? "none is given: the base is at rest" : "there is no base to carry it";
    return {
        .gravity = {scene.gravity,
                    line_of("gravity", use_if(scene.gravity > 0.0),
                            {"the load of every stage", "gravity is zero"}, "/gravity")},
        .element = element_of(fem),
        .damping = {{fem.rayleigh_mass, fem.rayleigh_stiffness},
                    line_of("Rayleigh damping", use_if(damped),
                            {"asked for", "both coefficients are zero"}, "/fem/rayleigh_mass")},
        .water =
            part(fem.water, "pore pressure",
                 {"an unknown of every node below the phreatic line", "the scene has no water"},
                 "/fem/water"),
        .base =
            part(fem.base, "absorbing base (dashpots)",
                 {"the base is released when motion begins", "the base stays fixed"}, "/fem/base"),
        .motion = part(fem.motion, "base motion", {"comes through the absorbing base", no_motion},
                       "/fem/motion"),
        .free_field =
            part(fem.free_field, "free-field columns",
                 {"thick columns move the sides as the free field does", "the scene asks for none"},
                 "/fem/free_field"),
        .surcharge = {fem.surcharge,
                      line_of("surcharge", use_if(!fem.surcharge.empty()),
                              {"on the ground", "nothing lies on the ground"}, "/fem/surcharge")},
    };
}

}  // namespace breach::fem
