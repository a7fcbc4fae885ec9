// Reads materials and the cross-section.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>

#include "core/mechanics/atmosphere.hpp"
#include "core/scene/norsand.hpp"
#include "core/scene/reader.hpp"
#include "core/scene/sand.hpp"

namespace breach::scene {

using nlohmann::json;

namespace {

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

std::optional<materials::Softening> softening_from(Reader& reader, const json& law, double c,
                                                   double phi, const std::string& pointer) {
    if (!law.contains("softening")) return std::nullopt;
    const json& s = law.at("softening");
    const double phi_residual = radians(s.at("phi_residual_deg"));
    materials::Softening softening{
        .epsilon_q_start = s.at("epsilon_q_start"),
        .epsilon_q_end = s.at("epsilon_q_end"),
        .c_residual = 1e3 * s.at("c_residual_kPa").get<double>(),
        .tan_phi_residual = std::tan(phi_residual),
        .driver = word_at<materials::SofteningDriver>(s, "driver"),
    };
    if (softening.epsilon_q_end <= softening.epsilon_q_start) {
        reader.add(pointer + "/epsilon_q_end", "is not above epsilon_q_start",
                   "softening needs a strain interval to happen in");
    }
    if (softening.c_residual > c) {
        reader.add(pointer + "/c_residual_kPa", "is above the peak c_kPa",
                   "soil softens, it does not harden");
    }
    if (phi_residual > phi) {
        reader.add(pointer + "/phi_residual_deg", "is above the peak phi_deg",
                   "soil softens, it does not harden");
    }
    return softening;
}

materials::PM4Sand sand_from(Reader& reader, const json& law, const std::string& pointer) {
    const auto parameters = sand_parameters(law);
    if (parameters.e_max <= parameters.e_min) {
        reader.add(pointer + "/e_max", "is not above e_min", "give e_max > e_min");
    }
    const double K_0 = law.at("K_0");
    return {.elasticity = materials::pm4sand::elastic_stage(parameters, K_0 / (1.0 + K_0)),
            .ready = materials::pm4sand::ready(parameters),
            .options = sand_options(law)};
}

std::optional<materials::NorSand> norsand_from(Reader& reader, const json& law,
                                               const std::string& pointer) {
    const auto faults = check_norsand_in_scene(law, pointer);
    for (const auto& each : faults) reader.add(each.pointer, each.cause, each.remedy);
    if (!faults.empty()) return std::nullopt;
    return norsand_law(law);
}

mechanics::Elasticity elasticity_from(const json& law) {
    return {1e6 * law.at("E_MPa").get<double>(), law.at("nu")};
}

/// Strength entries of laws with cohesion and friction.
struct CohesionAndFriction {
    double c, phi, psi;
};

CohesionAndFriction cohesion_and_friction_from(Reader& reader, const json& law,
                                               const std::string& pointer) {
    const double phi = radians(law.at("phi_deg"));
    const double psi = radians(law.at("psi_deg"));
    if (psi > phi) {
        reader.add(pointer + "/psi_deg", "is above phi_deg",
                   "such a soil would create energy; give psi_deg <= phi_deg");
    }
    return {1e3 * law.at("c_kPa").get<double>(), phi, psi};
}

using Profile = std::optional<materials::StrengthProfile>;

/// Law with the strength of a profile. Its own c and phi are those at a depth of 10 m under 100
/// kPa: exact if the profile is constant.
materials::MohrCoulomb mohr_coulomb_of(const materials::StrengthProfile& profile, const json& law) {
    const materials::PointStrength strength =
        materials::strength_of_point(profile, {10.0, 0.0, 1e5}, materials::Liquefaction::before);
    materials::MohrCoulomb made{
        .elasticity = elasticity_from(law),
        .c = strength.c,
        .phi = std::atan(strength.tan_phi),
        .psi = radians(law.at("psi_deg")),
        .tension_cutoff = 1e3 * law.at("tension_cutoff_kPa").get<double>(),
        .softening = {},
        .strength_of = materials::StrengthOf::point,
    };
    if (const auto* effective = std::get_if<materials::Effective>(&profile.peak.kind))
        made.phi = effective->phi;
    if (profile.softening) {
        made.softening = materials::Softening{profile.softening->start, profile.softening->end,
                                              strength.c_residual, strength.tan_phi_residual,
                                              profile.softening->driver};
    }
    return made;
}

materials::MohrCoulomb mohr_coulomb_from(Reader& reader, const json& law, const Profile& profile,
                                         const std::string& pointer) {
    const bool has_c = law.contains("c_kPa");
    if (profile && !has_c && !law.contains("phi_deg")) {
        if (law.contains("softening"))
            reader.add(pointer + "/softening", "given together with a strength profile",
                       "give the strains in the material's strength/softening");
        const materials::MohrCoulomb made = mohr_coulomb_of(*profile, law);
        if (made.psi > made.phi)
            reader.add(pointer + "/psi_deg", "is above the profile's peak friction angle",
                       "such a soil would create energy; give less");
        return made;
    }
    if (!has_c || !law.contains("phi_deg")) {
        reader.add(pointer, std::string("lacks \"") + (has_c ? "phi_deg" : "c_kPa") + "\"",
                   "give c_kPa and phi_deg, or neither of them and the material's \"strength\"");
        return {};
    }
    const auto [c, phi, psi] = cohesion_and_friction_from(reader, law, pointer);
    return {
        .elasticity = elasticity_from(law),
        .c = c,
        .phi = phi,
        .psi = psi,
        .tension_cutoff = 1e3 * law.at("tension_cutoff_kPa").get<double>(),
        .softening = softening_from(reader, law, c, phi, pointer + "/softening"),
    };
}

materials::DruckerPrager drucker_prager_from(Reader& reader, const json& law,
                                             const std::string& pointer) {
    const auto [c, phi, psi] = cohesion_and_friction_from(reader, law, pointer);
    return {.elasticity = elasticity_from(law),
            .c = c,
            .phi = phi,
            .psi = psi,
            .tension_cutoff = 1e3 * law.at("tension_cutoff_kPa").get<double>()};
}

materials::Law law_from(Reader& reader, const json& law, const Profile& profile,
                        const std::string& pointer) {
    const std::string type = law.at("type");
    if (type == "pm4sand") return sand_from(reader, law, pointer);
    if (type == "norsand") {
        const auto norsand = norsand_from(reader, law, pointer);
        return norsand ? materials::Law(*norsand) : materials::LinearElastic{{1e6, 0.3}};
    }
    if (type == "linear_elastic") return materials::LinearElastic{elasticity_from(law)};
    if (type == "mohr_coulomb") return mohr_coulomb_from(reader, law, profile, pointer);
    if (type == "drucker_prager") return drucker_prager_from(reader, law, pointer);
    throw std::logic_error("the schema knows a law \"" + type + "\" that nothing reads");
}

std::optional<LimitStrength> limit_strength_from(const json& material) {
    if (!material.contains("limit_strength")) return std::nullopt;
    const json& strength = material.at("limit_strength");
    return LimitStrength{1e3 * strength.at("c_kPa").get<double>(), radians(strength.at("phi_deg"))};
}

Polygon polygon_from(Reader& reader, const json& ring, const std::string& pointer) {
    Polygon polygon;
    for (const json& vertex : ring) polygon.push_back(point_from(vertex));
    if (polygon.front() != polygon.back()) {
        reader.add(pointer, "is open: the last vertex is not the first",
                   "repeat the first vertex at the end of the ring");
        return {};
    }
    polygon.pop_back();
    if (const auto what = geometry::defect(polygon)) {
        reader.add(pointer, *what, "list the vertices of a simple polygon in order");
        return {};
    }
    if (geometry::signed_area(polygon) < 0) std::reverse(polygon.begin(), polygon.end());
    return polygon;
}

std::array<std::size_t, 4> corners_from(Reader& reader, const json& mesh, const Polygon& polygon,
                                        const std::string& pointer) {
    std::array<std::size_t, 4> corners{0, 1, 2, 3};
    if (!mesh.contains("corners")) {
        if (polygon.size() == 4) return corners;
        reader.add(pointer,
                   "is a block of " + std::to_string(polygon.size()) + " vertices without corners",
                   "name in \"corners\" the four vertices that become the block's corners");
        return corners;
    }
    for (std::size_t k = 0; k < 4; ++k) {
        const Vec2 wanted = point_from(mesh.at("corners").at(k));
        const auto found = std::find(polygon.begin(), polygon.end(), wanted);
        if (found == polygon.end()) {
            reader.add(pointer + "/corners/" + std::to_string(k), "is not a vertex of the polygon",
                       "copy one of the polygon's vertices");
            return {0, 1, 2, 3};
        }
        corners[k] = static_cast<std::size_t>(found - polygon.begin());
    }
    // Makes the corners counter-clockwise; both swaps keep the sides to which `divisions` refer.
    std::size_t ascents = 0;
    for (std::size_t k = 0; k < 4; ++k) ascents += corners[k] < corners[(k + 1) % 4] ? 1 : 0;
    if (ascents == 1) {
        std::swap(corners[0], corners[1]);
        std::swap(corners[2], corners[3]);
        ascents = 3;
    }
    if (ascents != 3 || std::set<std::size_t>(corners.begin(), corners.end()).size() != 4) {
        reader.add(pointer + "/corners", "are not four different vertices in the ring's order",
                   "list them in the order in which the polygon passes them");
    }
    return corners;
}

/// The corners of a quadrilateral in the scene's order, to which `divisions` refer.
std::array<std::size_t, 4> written_order(const json& ring, const Polygon& polygon) {
    std::array<std::size_t, 4> corners{};
    for (std::size_t k = 0; k < 4; ++k) {
        const auto found = std::find(polygon.begin(), polygon.end(), point_from(ring.at(k)));
        corners[k] = static_cast<std::size_t>(found - polygon.begin());
    }
    const bool reversed = corners[1] != (corners[0] + 1) % 4;
    if (reversed) {
        std::swap(corners[0], corners[1]);
        std::swap(corners[2], corners[3]);
    }
    return corners;
}

MeshGrading grading_from(const json& mesh) {
    if (!mesh.contains("graded")) return {};
    const json& graded = mesh.at("graded");
    MeshGrading grading;
    if (graded.contains("left_of")) grading.left_of = graded.at("left_of");
    if (graded.contains("right_of")) grading.right_of = graded.at("right_of");
    grading.largest = graded.at("largest_width");
    return grading;
}

/// The region's edge length, or the section's; 0 without either.
double element_size_from(const Reader& reader, const json& mesh) {
    if (mesh.contains("element_size")) return mesh.at("element_size");
    const json::json_pointer of_section("/section/element_size");
    if (!reader.document().contains(of_section) || !reader.sound(of_section.to_string()))
        return 0.0;
    return reader.document().at(of_section);
}

void read_region_mesh(Reader& reader, const json& mesh, const json& ring,
                      const std::string& pointer, Region& region) {
    region.mesh = word_at<RegionMesh>(mesh, "type");
    region.element_size = element_size_from(reader, mesh);
    region.grading = grading_from(mesh);
    const bool divided = mesh.contains("divisions");
    if (!divided && region.element_size == 0.0) {
        reader.add(pointer, "has no element size",
                   "give element_size here or in /section, or a block's divisions");
    }
    if (divided && region.grading.any()) {
        reader.add(pointer + "/divisions", "given together with graded",
                   "strips follow from element_size: leave out divisions");
    }
    if (region.mesh == RegionMesh::unstructured || region.polygon.empty()) return;
    if (divided) region.divisions = {mesh.at("divisions").at(0), mesh.at("divisions").at(1)};
    const bool implied = !mesh.contains("corners") && region.polygon.size() == 4;
    region.corners = implied ? written_order(ring, region.polygon)
                             : corners_from(reader, mesh, region.polygon, pointer);
}

void check_overlaps(Reader& reader, const Scene& scene) {
    const auto& regions = scene.section.regions;
    for (std::size_t i = 0; i < regions.size(); ++i) {
        if (reader.found().is_full()) return;  // a million pairs would not help
        for (std::size_t j = i + 1; j < regions.size(); ++j) {
            if (regions[i].polygon.empty() || regions[j].polygon.empty()) continue;
            const double shared = geometry::overlap_area(regions[i].polygon, regions[j].polygon);
            const double least =
                std::min(geometry::area(regions[i].polygon), geometry::area(regions[j].polygon));
            if (shared <= 1e-9 * least) continue;
            reader.add(
                "/section/regions/" + std::to_string(j) + "/polygon",
                "overlaps region \"" + regions[i].name + "\" by " + std::to_string(shared) + " m2",
                "regions may touch, never overlap: move a vertex");
        }
    }
}

std::optional<materials::StrengthCurve> dynamic_strength_from(const json& material) {
    if (!material.contains("dynamic_strength")) return std::nullopt;
    const json& entry = material.at("dynamic_strength");
    const double ratio = entry.at("factor").get<double>() * entry.at("ratio").get<double>();
    return materials::StrengthCurve{
        materials::Undrained{.coefficient = ratio * mechanics::standard_atmosphere},
        1e3 * entry.at("minimum_kPa").get<double>()};
}

}  // namespace

void read_materials(Reader& reader, Scene& scene) {
    const json& document = reader.document();
    if (!document.contains("materials") || !document.at("materials").is_object()) return;
    for (const auto& [name, material] : document.at("materials").items()) {
        const std::string pointer = "/materials/" + name;
        if (!reader.sound(pointer)) continue;
        std::optional<double> void_ratio;
        std::optional<std::array<double, 2>> permeability;
        if (material.contains("void_ratio")) void_ratio = material.at("void_ratio").get<double>();
        std::optional<double> nonlocal_length;
        if (material.contains("nonlocal_length"))
            nonlocal_length = material.at("nonlocal_length").get<double>();
        if (material.contains("permeability")) {
            permeability = range_from(material.at("permeability"));
        }
        const Profile profile = strength_from(reader, name);
        scene.materials.push_back(
            {.name = name,
             .density = material.at("density"),
             .law = law_from(reader, material.at("law"), profile, pointer + "/law"),
             .viscosity = material.at("viscosity"),
             .nonlocal_length = nonlocal_length,
             .void_ratio = void_ratio,
             .permeability = permeability,
             .limit_strength = limit_strength_from(material),
             .strength = profile,
             .dynamic_strength = dynamic_strength_from(material)});
    }
}

void read_section(Reader& reader, Scene& scene) {
    const json& document = reader.document();
    const json::json_pointer at("/section/regions");
    if (!document.contains(at) || !document.at(at).is_array()) return;
    std::set<std::string> names;
    for (std::size_t i = 0; i < document.at(at).size(); ++i) {
        const json& each = document.at(at).at(i);
        const std::string pointer = "/section/regions/" + std::to_string(i);
        Region region{};
        if (reader.sound(pointer + "/name")) region.name = each.at("name");
        if (!region.name.empty() && !names.insert(region.name).second) {
            reader.add(pointer + "/name", "is used twice", "give every region its own name");
        }
        if (reader.sound(pointer + "/material")) {
            const std::string wanted = each.at("material");
            const auto found = std::find_if(scene.materials.begin(), scene.materials.end(),
                                            [&](const Material& m) { return m.name == wanted; });
            region.material = static_cast<std::size_t>(found - scene.materials.begin());
            if (!document.contains("materials") || !document.at("materials").contains(wanted)) {
                reader.add(pointer + "/material",
                           "names \"" + wanted + "\", which /materials does not have",
                           "add the material, or name one that exists");
            }
        }
        const bool drawn = reader.sound(pointer + "/polygon");
        if (drawn) {
            region.polygon = polygon_from(reader, each.at("polygon"), pointer + "/polygon");
        }
        if (drawn && reader.sound(pointer + "/mesh")) {
            read_region_mesh(reader, each.at("mesh"), each.at("polygon"), pointer + "/mesh",
                             region);
        }
        scene.section.regions.push_back(std::move(region));
    }
    check_overlaps(reader, scene);
}

}  // namespace breach::scene
