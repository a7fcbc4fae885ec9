// Reads strength profiles, /materials/*/strength.
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/mechanics/atmosphere.hpp"
#include "core/scene/reader.hpp"

namespace breach::scene {

using materials::Along;
using materials::StrengthCurve;
using materials::StrengthProfile;
using nlohmann::json;

namespace {

/// Points of a table, converted to SI by these factors.
std::vector<std::array<double, 2>> points_from(Reader& reader, const json& points, double place,
                                               double value, const std::string& pointer) {
    std::vector<std::array<double, 2>> result;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto [x, y] = range_from(points[i]);
        const std::string here = pointer + "/" + std::to_string(i);
        if (y < 0.0) reader.add(here + "/1", "is negative", "give 0 or more");
        if (!result.empty() && place * x <= result.back()[0])
            reader.add(here, "is out of order", "list the points by ascending place");
        result.push_back({place * x, value * y});
    }
    return result;
}

materials::Table table_from(Reader& reader, const json& kind, const std::string& pointer) {
    const auto along = word_at<Along>(kind, "by");
    return {along, points_from(reader, kind.at("points"), along == Along::sigma_v0 ? kPa : 1.0, kPa,
                               pointer + "/points")};
}

materials::BySounding relation_from(Reader& reader, const json& kind, const std::string& pointer) {
    materials::BySounding result{word_at<materials::Relation>(kind, "relation"), {}};
    if (kind.contains("value") == kind.contains("points")) {
        reader.add(
            pointer,
            kind.contains("value") ? "has a value and points" : "has no value of the sounding",
            "give value, or points over depth or elevation");
        result.sounding.points = {{0.0, 0.0}};
        return result;
    }
    if (kind.contains("value")) {
        result.sounding.points = {{0.0, kind.at("value").get<double>()}};
        return result;
    }
    result.sounding = {word_at<Along>(kind, "by"),
                       points_from(reader, kind.at("points"), 1.0, 1.0, pointer + "/points")};
    return result;
}

StrengthCurve curve_from(Reader& reader, const json& kind, const std::string& pointer) {
    const std::string type = kind.at("type");
    StrengthCurve curve{};
    if (kind.contains("minimum_kPa")) curve.least = kPa * kind.at("minimum_kPa").get<double>();
    const auto stress = [&](const char* key) { return kPa * kind.at(key).get<double>(); };
    if (type == "effective") {
        const double phi = kind.at("phi_deg").get<double>() * std::numbers::pi / 180.0;
        curve.kind = materials::Effective{stress("c_kPa"), phi};
    } else if (type == "undrained") {
        curve.kind = materials::Undrained{.constant = stress("s_u_kPa")};
    } else if (type == "undrained_by_depth") {
        curve.kind = materials::Undrained{.constant = stress("at_ground_kPa"),
                                          .per_metre = stress("per_metre_kPa")};
    } else if (type == "undrained_ratio") {
        curve.kind = materials::Undrained{.coefficient = kind.at("ratio").get<double>() *
                                                         mechanics::standard_atmosphere};
    } else if (type == "undrained_power") {
        curve.kind = materials::Undrained{.constant = stress("constant_kPa"),
                                          .coefficient = stress("coefficient_kPa"),
                                          .exponent = kind.at("exponent")};
    } else if (type == "undrained_table") {
        curve.kind = table_from(reader, kind, pointer);
    } else if (type == "relation") {
        curve.kind = relation_from(reader, kind, pointer);
    } else {
        throw std::logic_error("the schema knows a strength \"" + type + "\" that nothing reads");
    }
    return curve;
}

materials::SofteningStrains strains_from(Reader& reader, const json& softening,
                                         const std::string& pointer) {
    materials::SofteningStrains strains{softening.at("epsilon_q_start"),
                                        softening.at("epsilon_q_end"),
                                        word_at<materials::SofteningDriver>(softening, "driver")};
    if (strains.end <= strains.start)
        reader.add(pointer + "/epsilon_q_end", "is not above epsilon_q_start",
                   "softening needs a strain interval to happen in");
    return strains;
}

/// The material that defines the strength; empty after a fault.
std::string owner_of(Reader& reader, const std::string& name) {
    const json& all = reader.document().at("materials");
    const json& strength = all.at(name).at("strength");
    const std::string pointer = "/materials/" + name + "/strength";
    if (!strength.contains("like")) {
        if (!strength.contains("peak"))
            reader.add(pointer, "has no peak", "give \"peak\", or \"like\": another material");
        return strength.contains("peak") ? name : "";
    }
    if (strength.size() > 1)
        reader.add(pointer, "has more beside \"like\"", "leave the rest to that material");
    const std::string like = strength.at("like");
    const bool has_own = all.contains(like) && all.at(like).is_object() &&
                         all.at(like).contains("strength") &&
                         !all.at(like).at("strength").contains("like");
    if (!has_own)
        reader.add(pointer + "/like", "names \"" + like + "\", which has no strength of its own",
                   "name a material whose strength has a peak");
    return has_own && reader.sound("/materials/" + like + "/strength") ? like : "";
}

}  // namespace

std::optional<StrengthProfile> strength_from(Reader& reader, const std::string& name) {
    if (!reader.document().at("materials").at(name).contains("strength")) return std::nullopt;
    const std::string owner = owner_of(reader, name);
    if (owner.empty()) return std::nullopt;
    const std::string pointer = "/materials/" + owner + "/strength";
    const json& strength = reader.document().at(json::json_pointer(pointer));
    // Report a fault of the owner once, at the owner.
    Reader elsewhere(reader.document(), {});
    Reader& told = owner == name ? reader : elsewhere;
    StrengthProfile profile{curve_from(told, strength.at("peak"), pointer + "/peak")};
    if (strength.contains("residual"))
        profile.residual = curve_from(told, strength.at("residual"), pointer + "/residual");
    if (strength.contains("softening")) {
        profile.softening = strains_from(told, strength.at("softening"), pointer + "/softening");
        if (!profile.residual)
            told.add(pointer + "/softening", "has no residual strength to end at",
                     "give \"residual\", or leave softening out");
    }
    return profile;
}

}  // namespace breach::scene
