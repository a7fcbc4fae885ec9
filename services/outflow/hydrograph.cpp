// A runout's history has one column per section and quantity, "section.toe.discharge".
// http_outflow.cpp reads it when a user exports; the file is the MPM's, and only ended runouts have
// it.
#include "services/outflow/hydrograph.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/fault/fault.hpp"
#include "core/phases/files.hpp"
#include "core/statistics/percentiles.hpp"
#include "core/words/number.hpp"

namespace breach::outflow {

namespace {

constexpr std::string_view prefix = "section.";
// A name may contain points, so it is cut off from both ends.
constexpr std::string_view last_column = ".discharge";

std::string list_of(const std::vector<std::string>& names) {
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
    return list.empty() ? "none: the scene has no /mpm/sections" : list;
}

}  // namespace

std::vector<std::string> sections_in(const exchange::Archive& history) {
    std::vector<std::string> names;
    for (const auto& [name, values] : history.reals) {
        if (name.starts_with(prefix) && name.ends_with(last_column))
            names.push_back(
                name.substr(prefix.size(), name.size() - prefix.size() - last_column.size()));
    }
    return names;
}

Hydrograph hydrograph_in(const exchange::Archive& history, const std::string& section,
                         const std::string& file) {
    const auto refuse = [&](const std::string& cause) {
        throw fault::BadInput(
            file, {{"/section", cause, "its sections are: " + list_of(sections_in(history))}});
    };
    Hydrograph found{.section = section};
    const auto time = history.reals.find("time");
    if (time == history.reals.end()) refuse("has no times");
    found.time = time->second;
    for_each_column(found, [&](const char* what, const char*, std::vector<double>& values) {
        const auto column = history.reals.find("section." + section + "." + what);
        if (column == history.reals.end() || column->second.size() != found.time.size())
            refuse("has no section \"" + section + "\"");
        values = column->second;
    });
    return found;
}

Chosen at_percentile(const std::vector<Hydrograph>& samples, double p, const std::string& file) {
    if (samples.size() < statistics::samples_needed(p))
        throw fault::BadInput(file, {{"/percentile", statistics::not_enough(samples.size(), p),
                                      "extend the run, or name a runout with variant"}});
    std::vector<double> volumes;
    for (const Hydrograph& each : samples) volumes.push_back(each.volume.back());
    const double wanted = statistics::percentile(volumes, p).value;
    const auto nearest = std::ranges::min_element(
        volumes, {}, [&](double volume) { return std::abs(volume - wanted); });
    const auto sample = static_cast<std::size_t>(nearest - volumes.begin());
    Hydrograph found = samples[sample];
    const double scale = *nearest > 0.0 ? wanted / *nearest : 1.0;
    for (std::vector<double>* each : {&found.discharge, &found.volume, &found.mass})
        for (double& value : *each) value *= scale;
    found.warning = "The runout with a volume nearest to p" + words::text_of(p) + " of " +
                    std::to_string(samples.size()) + " runouts, times " + words::text_of(scale, 3) +
                    " to have it.";
    return {sample, std::move(found)};
}

/// The version that mpm_solver/results.cpp writes.
exchange::Archive history_of(const std::filesystem::path& output) {
    return exchange::read_archive(output / phases::files::history, "mpm_history", 1);
}

BreachWidth breach_width_from(const nlohmann::json& entry, const std::string& file,
                              const std::string& pointer) {
    const auto sound = [](const nlohmann::json& each) {
        // Above 5 km: more likely a slip than a breach.
        return each.is_number() && each.get<double>() > 0.0 && each.get<double>() <= 5e3;
    };
    if (sound(entry)) return {entry, entry, entry};
    const bool three = entry.is_array() && entry.size() == 3 && sound(entry[0]) &&
                       sound(entry[1]) && sound(entry[2]) && entry[0] <= entry[1] &&
                       entry[1] <= entry[2];
    if (!three)
        throw fault::BadInput(file,
                              {{pointer, "is no width of a breach in metres",
                                "give a number above 0, or three that ascend: low, best, high"}});
    return {entry[0], entry[1], entry[2]};
}

StatedWidth stated_width(const nlohmann::json& scene) {
    const nlohmann::json& mpm = scene.at("mpm");
    if (mpm.contains("breach_width"))
        return {breach_width_from(mpm.at("breach_width"), "scene", "/mpm/breach_width"),
                "/mpm/breach_width of the scene"};
    const nlohmann::json regions = mpm.at("runout").value("regions", nlohmann::json::array());
    const double toe = mpm.at("runout").at("toe").at(1);
    double height = 0.0;
    for (const auto& each : scene.at("section").at("regions")) {
        const bool counts = regions.empty() || std::ranges::count(regions, each.at("name")) > 0;
        for (const auto& corner : each.at("polygon"))
            if (counts) height = std::max(height, corner.at(1).get<double>() - toe);
    }
    return {{2.0 * height, 3.0 * height, 4.0 * height},
            "assumed: 3 (2 to 4) heights of " + words::text_of(height, 3) +
                " m (Wahl 1998); set /mpm/breach_width"};
}

}  // namespace breach::outflow
