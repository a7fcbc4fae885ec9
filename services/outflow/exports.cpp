// Hydrographs for flood programs. The model is per metre of width, so the discharge needs a
// breach width with its range, which the user gives.
#include "services/outflow/exports.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "core/fault/fault.hpp"

namespace breach::outflow {

const std::string slurry_warning =
    "The material is a tailings slurry, not water: volumes are of soil with its pore water as it "
    "lay in the dam, "
    "and free water of a pond is not in them. Route it with a rheology of its own.";

namespace {

/// Intervals of HEC-RAS's list that are whole seconds [s].
constexpr std::array intervals_of_hec_ras{1,   2,   3,   4,   5,    6,    10,  12,
                                          15,  20,  30,  60,  120,  180,  240, 300,
                                          360, 600, 720, 900, 1200, 1800, 3600};

[[noreturn]] void refuse(const std::string& file, const std::string& pointer,
                         const std::string& cause, const std::string& remedy) {
    throw fault::BadInput(file, {{pointer, cause, remedy}});
}

std::string number(const char* format, double value) {
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

/// Volume that does not flow back: the least of all later values.
/// A flood program cannot take a discharge back; sloshing at the section would count twice.
std::vector<double> passed_for_good(const std::vector<double>& volume) {
    std::vector<double> passed(volume.size());
    double least = volume.back();
    for (std::size_t k = volume.size(); k-- > 0;) {
        least = std::min(least, volume[k]);
        passed[k] = std::max(0.0, least);
    }
    return passed;
}

double between(const std::vector<double>& time, const std::vector<double>& values, double at) {
    if (at <= time.front()) return values.front();
    if (at >= time.back()) return values.back();
    const auto right = std::upper_bound(time.begin(), time.end(), at) - time.begin();
    const double share = (at - time[right - 1]) / (time[right] - time[right - 1]);
    return values[right - 1] + share * (values[right] - values[right - 1]);
}

/// Time since the start, not a time of day: hours go on beyond 24.
std::string clock_of(double seconds) {
    const auto whole = static_cast<std::int64_t>(std::llround(seconds));
    char text[64];
    std::snprintf(text, sizeof text, "%02lld:%02lld:%02lld", static_cast<long long>(whole / 3600),
                  static_cast<long long>(whole / 60 % 60), static_cast<long long>(whole % 60));
    return text;
}

}  // namespace

std::string warning_of(const Hydrograph& hydrograph) {
    return slurry_warning + (hydrograph.warning.empty() ? "" : " " + hydrograph.warning);
}

std::string as_csv(const Hydrograph& hydrograph, const std::optional<BreachWidth>& width) {
    std::ostringstream table;
    table.precision(10);
    table << "# section " << hydrograph.section << ", per metre of width. "
          << warning_of(hydrograph)
          << "\ntime_s,discharge_m2_per_s,depth_m,velocity_m_per_s,volume_m2,mass_kg_per_m";
    if (width)
        table << ",discharge_low_m3_per_s,discharge_m3_per_s,discharge_high_m3_per_s,volume_low_m3,"
                 "volume_m3,volume_high_m3";
    table << "\n";
    for (std::size_t k = 0; k < hydrograph.time.size(); ++k) {
        table << hydrograph.time[k];
        for_each_column(hydrograph,
                        [&](auto, auto, const auto& values) { table << "," << values[k]; });
        if (width) {
            for (const double per_metre : {hydrograph.discharge[k], hydrograph.volume[k]})
                for (const double w : {width->low, width->best, width->high})
                    table << "," << per_metre * w;
        }
        table << "\n";
    }
    return table.str();
}

Ordinates ordinates_of(const Hydrograph& hydrograph, double width, double interval,
                       const std::string& file) {
    if (!(interval > 0.0))
        refuse(file, "/interval", "is not above 0", "give seconds between two flows");
    if (hydrograph.volume.empty() || !(hydrograph.volume.back() > 0.0))
        refuse(file, "/section", "nothing passed it towards +x: there is no inflow",
               "choose a section that the flow reached, downstream of where the soil lay");
    const double whole = (hydrograph.time.back() - hydrograph.time.front()) / interval;
    if (whole > 1e6)
        refuse(file, "/interval", "makes more than a million flows", "give a longer interval");
    const std::vector<double> passed = passed_for_good(hydrograph.volume);
    Ordinates result{.interval = interval,
                     .m3_per_s = {0.0},
                     .volume = 0.0,
                     .peak_before = width * std::ranges::max(hydrograph.discharge),
                     .peak_after = 0.0};
    double before = 0.0;
    // The last interval ends after the runout, so that the flows carry all of its volume.
    const auto count = static_cast<std::int64_t>(std::ceil(whole + 0.5)) + 1;
    for (std::int64_t k = 0; k < count; ++k) {
        const double at = hydrograph.time.front() + (static_cast<double>(k) + 0.5) * interval;
        const double now = between(hydrograph.time, passed, at);
        result.m3_per_s.push_back(width * (now - before) / interval);
        before = now;
    }
    result.m3_per_s.push_back(0.0);
    for (const double flow : result.m3_per_s) result.volume += flow * interval;
    result.peak_after = std::ranges::max(result.m3_per_s);
    return result;
}

std::string peaks_in_words(const Ordinates& flows) {
    constexpr double kept = 0.9;
    const std::string peak = number("%.3g", flows.peak_before) + " m3/s";
    const std::string every = "flows every " + number("%.4g", flows.interval) + " s";
    if (flows.peak_after >= kept * flows.peak_before)
        return "Peak " + peak + ", of the " + every + " " + number("%.3g", flows.peak_after) +
               " m3/s.";
    return "The peak is lost: " + peak + " become " + number("%.3g", flows.peak_after) +
           " m3/s in " + every +
           ", each a mean over that time. Where the peak matters, ask for a shorter interval.";
}

Ordinates hec_ras_ordinates(const Hydrograph& hydrograph, double width, double interval,
                            const std::string& file) {
    if (std::ranges::find(intervals_of_hec_ras, interval) == intervals_of_hec_ras.end())
        refuse(file, "/interval", "is not in HEC-RAS's list of data time intervals",
               "give 1, 2, 3, 4, 5, 6, 10, 15, 20 or 30 s, or whole minutes");
    return ordinates_of(hydrograph, width, interval, file);
}

std::string as_hec_ras(const Hydrograph& hydrograph, double width, double interval,
                       const std::string& file) {
    const Ordinates flows = hec_ras_ordinates(hydrograph, width, interval, file);
    std::ostringstream table;
    table << "# HEC-RAS flow hydrograph, SI units, data time interval " << interval << " s, "
          << flows.m3_per_s.size() << " ordinates; section " << hydrograph.section
          << ", breach width " << number("%.10g", width) << " m, volume "
          << number("%.6g", flows.volume) << " m3. The runout begins with ordinate 2.\n# "
          << peaks_in_words(flows) << " " << warning_of(hydrograph)
          << "\nOrdinate,Simulation Time (hh:mm:ss),Flow (m3/s)\n";
    for (std::size_t k = 0; k < flows.m3_per_s.size(); ++k)
        table << k + 1 << "," << clock_of(static_cast<double>(k) * interval) << ","
              << number("%.6g", flows.m3_per_s[k]) << "\n";
    return table.str();
}

std::string as_flo_2d(const Hydrograph& hydrograph, double width, double interval,
                      const Flo2dOptions& request, const std::string& file) {
    const Ordinates flows = ordinates_of(hydrograph, width, interval, file);
    const std::string solids =
        request.concentration ? " " + number("%-15.4g", *request.concentration) : "";
    const std::string cell = std::to_string(request.cell);
    std::string table =
        " 0               " + cell + "\nF               0               " + cell + "\n";
    for (std::size_t k = 0; k < flows.m3_per_s.size(); ++k) {
        const double hours = static_cast<double>(k) * interval / 3600.0;
        std::string line =
            "H   " + number("%-15.8f", hours) + " " + number("%-15.6g", flows.m3_per_s[k]) + solids;
        line.erase(line.find_last_not_of(' ') + 1);
        table += line + "\n";
    }
    return table;
}

}  // namespace breach::outflow
