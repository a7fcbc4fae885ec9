// Writes a hydrograph together with the flow's resistance as an unsteady flow file of HEC-RAS (.u01).
// Called by http_outflow.cpp alone. Sources: docs/how-to/hydrographs.md.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "services/outflow/hydrograph.hpp"

namespace breach::outflow {

/// tau = yield_stress + viscosity * shear rate, the law of soil without friction in the runout.
struct Rheology {
    double yield_stress;  ///< [Pa]
    double viscosity;     ///< [Pa s]
    std::string from;     ///< in words
};

/// Means by area over the regions that count for the runout and have no friction once they flow.
/// scene: completed. Throws BadInput if there are none.
Rheology rheology_of(const nlohmann::json& scene);

/// HEC-RAS's numbers of its methods. With n = 1 Herschel-Bulkley is Bingham.
enum class Resistance { bingham = 1, obrien = 2, herschel_bulkley = 4 };
std::optional<Resistance> resistance_named(const std::string& name);

/// concentration: solids by volume, as a share; the flows hold the solids already and are not
/// bulked. Throws BadInput like as_hec_ras.
std::string as_hec_ras_unsteady(const Hydrograph& hydrograph, double width, double interval,
                                Resistance resistance, const Rheology& rheology,
                                double concentration, const std::string& file);

}  // namespace breach::outflow
