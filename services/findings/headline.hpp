// What happens to the section, in one line: the first thing that every view of a run says. From the
// governing result; whether it can be relied on is the verdict's part.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace breach::findings {

/// fails: limit equilibrium alone finds a factor of safety below 1, and no runout was computed.
enum class Outcome { not_known, stands, fails, flows };

/// The governing runout.
struct Soil {
    double farthest;  ///< 99 % of the soil beyond the toe lies within it [m]; negative: no soil
                      ///< passes the toe, the farthest point is so far upstream
    bool stood;       ///< moved by less than a cell and fell by centimetres (mpm_solver)
    bool lower_bound = false;
    std::optional<double> error = {};  ///< of the runout [m]
    std::int64_t worst_of = 1;         ///< samples of an uncertainty study
};

/// Of the MPM's result; nothing: it has no runout.
std::optional<Soil> soil_of(const nlohmann::json& result);

struct HeadlineFacts {
    std::optional<Soil> soil = {};
    std::optional<double> factor_of_safety = {};               ///< least, as built
    std::optional<double> factor_of_safety_liquefied = {};     ///< of the same analysis
    std::optional<double> factor_of_safety_post_seismic = {};  ///< after the shaking
    bool stood_in_fem = false;  ///< every FEM ended without a failure and without a transfer
    bool lem_alone = false;     ///< the run has stability analyses only
};

struct Headline {
    Outcome outcome = Outcome::not_known;
    std::string text = {};  ///< "flows 10.4 ± 1.2 m beyond the toe; FS 1.41 as built, 0.62
                            ///< liquefied"; empty: no result yet
};

Headline headline_of(const HeadlineFacts& facts);

/// {"outcome": "not_known" | "stands" | "fails" | "flows", "text"}
nlohmann::json as_json(const Headline& headline);

}  // namespace breach::findings
