// Adds static liquefaction to an imported section: named regions keep only their residual strength
// below the phreatic line, from the start. Also the study that compares it with the peak strength.
#pragma once

#include "services/import/depth_layers.hpp"
#include "services/import/document.hpp"

namespace breach::importing {

/// Undrained strength: a share of sigma'_v0 [-], or constant [kPa].
struct Undrained {
    double value;
    bool in_kPa;
};

/// A region or layer of the drawing that liquefies.
struct LiquefiedRequest {
    std::string region;
    Undrained residual;
    std::optional<Undrained> peak;  ///< before it liquefies; none: as "breach new" assumes
    std::string source;             ///< of the strengths
};

/// "REGION=RESIDUAL,SOURCE" or "REGION=RESIDUAL,PEAK,SOURCE". Nothing, and a fault, for any other
/// text.
std::optional<LiquefiedRequest> liquefied_request_from(const std::string& entry,
                                                       std::vector<Fault>& faults);

/// Cuts the named regions along the phreatic line, as far as no depth layers were cut from them.
Healed with_liquefied_parts(std::vector<Soil> soils, const std::vector<LiquefiedRequest>& asked,
                            const std::vector<Vec2>& phreatic, double tolerance);

/// Why the cut section cannot liquefy at rest; empty: it can.
std::vector<Fault> faults_of_liquefying(const std::vector<LiquefiedRequest>& asked,
                                        const std::vector<Soil>& soils, const Lines& lines,
                                        const nlohmann::json& materials);

/// Adds materials, layers of the stability analysis, gauges and the study. Needs a scene with /lem
/// and /mpm, and no fault from faults_of_liquefying.
void add_liquefaction(const std::vector<LiquefiedRequest>& asked, const std::vector<Soil>& soils,
                      const Lines& lines, Document& document);

}  // namespace breach::importing
