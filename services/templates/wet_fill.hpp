// Friction of fill below the phreatic line, in the runout.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace breach::templates {

/// Material points carry no pore pressure, so friction acts on the total stress. Each region of
/// drained fill that reaches below the phreatic line gets a material of its own, with
/// tan phi = (1 - r_u) tan phi' in its law, peak and residual. r_u is that on the region's base by
/// the phreatic line (Bishop & Morgenstern 1960): fill that dilates gets no credit for suction
/// (Duncan, Wright & Brandon 2014, Soil Strength and Slope Stability). limit_strength, and so the
/// stability analysis, keeps c' and phi'; without one, the law's peak becomes it. The material is
/// named like the region, then `suffix`. Does nothing to a faulty scene.
void reduce_friction_of_wet_fill(nlohmann::ordered_json& scene, const std::string& suffix = "");

}  // namespace breach::templates
