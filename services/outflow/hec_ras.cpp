// The keys, their order and the misspelt "User Yeild" are those of files that HEC-RAS 6 writes.
// Numbers of methods and units as in its manual: Pa, Pa s, concentrations in percent.
#include "services/outflow/hec_ras.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/fault/fault.hpp"
#include "core/geometry/polygon.hpp"
#include "core/words/number.hpp"
#include "services/outflow/exports.hpp"

namespace breach::outflow {

using nlohmann::json;

namespace {

/// Cohesion once the soil flows [Pa]; nothing: it has friction, or a strength by stress.
std::optional<double> flowing_strength(const json& soil) {
    const json law = soil.value("law", json::object());
    const json softened = law.value("softening", json::object());
    const auto entry = [&](const char* of_softened, const char* of_law) {
        return softened.contains(of_softened) ? softened.at(of_softened).get<double>()
                                              : law.value(of_law, 0.0);
    };
    if (law.value("type", "") != "mohr_coulomb" || soil.contains("strength") ||
        entry("phi_residual_deg", "phi_deg") != 0.0)
        return std::nullopt;
    return 1e3 * entry("c_residual_kPa", "c_kPa");
}

double area_of(const json& ring) {
    geometry::Polygon polygon;
    for (const json& each : ring)
        polygon.emplace_back(each[0].get<double>(), each[1].get<double>());
    return geometry::area(polygon);
}

/// A field of eight characters, of which HEC-RAS reads ten per line.
std::string field(double flow) {
    char text[32];
    std::snprintf(text, sizeof text, flow < 1e3 ? "%8.3f" : "%8.1f", flow);
    return text;
}

/// "10SEC", "2MIN", "1HOUR"
std::string interval_word(double seconds) {
    const auto whole = static_cast<std::int64_t>(seconds);
    if (whole % 3600 == 0) return std::to_string(whole / 3600) + "HOUR";
    return whole % 60 == 0 ? std::to_string(whole / 60) + "MIN" : std::to_string(whole) + "SEC";
}

}  // namespace

Rheology rheology_of(const json& scene) {
    const json regions = scene.at("mpm").at("runout").value("regions", json::array());
    double area = 0.0, yield = 0.0, viscosity = 0.0;
    std::string names;
    for (const json& each : scene.at("section").at("regions")) {
        if (!regions.empty() && std::ranges::count(regions, each.at("name")) == 0) continue;
        const json& soil = scene.at("materials").at(each.at("material").get<std::string>());
        const auto strength = flowing_strength(soil);
        if (!strength) continue;
        const double of_region = area_of(each.at("polygon"));
        area += of_region;
        yield += of_region * *strength;
        viscosity += of_region * soil.value("viscosity", 0.0);
        names += (names.empty() ? "" : ", ") + each.at("name").get<std::string>();
    }
    if (!(area > 0.0))
        throw fault::BadInput(
            "scene",
            {{"/materials",
              "no soil of the runout has a strength without friction: it has no yield stress",
              "give yield_stress and viscosity"}});
    return {yield / area, viscosity / area, "mean by area of " + names};
}

std::optional<Resistance> resistance_named(const std::string& name) {
    if (name == "bingham") return Resistance::bingham;
    if (name == "obrien") return Resistance::obrien;
    if (name == "herschel-bulkley") return Resistance::herschel_bulkley;
    return std::nullopt;
}

std::string as_hec_ras_unsteady(const Hydrograph& hydrograph, double width, double interval,
                                Resistance resistance, const Rheology& rheology,
                                double concentration, const std::string& file) {
    const Ordinates flows = hec_ras_ordinates(hydrograph, width, interval, file);
    const bool by_coefficients = resistance == Resistance::herschel_bulkley;
    std::ostringstream text;
    text << "Flow Title=" << hydrograph.section << ", " << words::text_of(width) << " m wide"
         << "\nProgram Version=6.40\nBEGIN FILE DESCRIPTION:\n"
         << peaks_in_words(flows) << " Volume " << words::text_of(flows.volume) << " m3. "
         << warning_of(hydrograph) << "\nYield stress and viscosity: " << rheology.from
         << ".\nEND FILE DESCRIPTION:\nUse Restart= 0 \nBoundary Location=" << std::string(16, ' ')
         << "," << std::string(16, ' ') << ",        ,        ," << std::string(16, ' ') << ",";
    // The names of the 2D area and of its boundary line, which only the user's geometry has.
    const auto padded = [](std::string name, std::size_t size) {
        name.resize(size, ' ');
        return name;
    };
    text << padded("AREA", 16) << "," << std::string(16, ' ') << "," << padded("BREACH", 32) << ","
         << std::string(32, ' ') << "\nInterval=" << interval_word(interval)
         << "\nFlow Hydrograph= " << flows.m3_per_s.size() << " \n";
    for (std::size_t k = 0; k < flows.m3_per_s.size(); ++k)
        text << field(flows.m3_per_s[k])
             << (k % 10 == 9 || k + 1 == flows.m3_per_s.size() ? "\n" : "");
    text << "Stage Hydrograph TW Check=0\nFlow Hydrograph Slope= 0 \nDSS Path=\nUse DSS=False\n"
         << "Use Fixed Start Time=False\nFixed Start Date/Time=,\nIs Critical Boundary=False\n"
         << "Critical Boundary Flow=\n"
         << "Non-Newtonian Method= " << static_cast<int>(resistance) << " , \n"
         << "Non-Newtonian Constant Vol Conc=" << words::text_of(100.0 * concentration) << "\n"
         << "Non-Newtonian Yield Method= 1 , \nNon-Newtonian Yield Coef=0, 0\nUser Yeild=   "
         << words::text_of(rheology.yield_stress) << "\n"
         << "Non-Newtonian Sed Visc= 2 , \nNon-Newtonian Obrian B=0\nUser Viscosity="
         << words::text_of(rheology.viscosity) << "\nUser Viscosity Ratio=0\n"
         << "Herschel-Bulkley Coef="
         << (by_coefficients ? words::text_of(rheology.viscosity) + ", 1" : "0, 0")
         << "\nClastic Method= 0 , \nCoulomb Phi=0\nVoellmy X=0\nNon-Newtonian Hindered FV= 0 \n"
         << "Non-Newtonian FV K=0\nNon-Newtonian ds=0\nNon-Newtonian Max Cv=0\n"
         << "Non-Newtonian Bulking Method= 0 , \nNon-Newtonian High C Transport= 0 , \n";
    return text.str();
}

}  // namespace breach::outflow
