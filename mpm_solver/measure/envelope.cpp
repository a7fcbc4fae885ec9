#include "mpm_solver/measure/envelope.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace breach::mpm {

namespace {

/// Drops every second row and doubles the interval.
void thin(Envelope& envelope, std::size_t columns) {
    std::size_t kept = 0;
    for (std::size_t row = 0; row < envelope.row_times.size(); row += 2, ++kept) {
        envelope.row_times[kept] = envelope.row_times[row];
        std::copy_n(envelope.row_depths.begin() + static_cast<std::ptrdiff_t>(row * columns),
                    columns,
                    envelope.row_depths.begin() + static_cast<std::ptrdiff_t>(kept * columns));
    }
    envelope.row_times.resize(kept);
    envelope.row_depths.resize(kept * columns);
    envelope.interval =
        (envelope.row_times.back() - envelope.row_times.front()) / static_cast<double>(kept - 1);
}

void add_row(Envelope& envelope, double now, const std::vector<Flow>& profile) {
    std::vector<double>& times = envelope.row_times;
    // Summed time steps differ from round times by round-off.
    const auto early = [&] {
        return !times.empty() && now < times.back() + (1.0 - 1e-9) * envelope.interval;
    };
    if (early()) return;
    // Thinning doubles the interval, so a run of unknown length keeps 128 to 256 rows evenly in
    // time.
    if (times.size() == most_rows) {
        thin(envelope, profile.size());
        if (early()) return;
    }
    times.push_back(now);
    for (const Flow& flow : profile) envelope.row_depths.push_back(flow.depth);
}

/// Arrays per column in a checkpoint. Calls visit(name, array).
template <class AnyEnvelope, class Visit>
void for_each_column_array(AnyEnvelope& envelope, Visit&& visit) {
    visit("depth", envelope.depth), visit("velocity", envelope.velocity);
    visit("flux", envelope.flux), visit("arrival", envelope.arrival);
    visit("time_of_peak", envelope.time_of_peak), visit("last_depth", envelope.last_depth);
}

std::vector<double> without_never(std::vector<double> times) {
    std::replace(times.begin(), times.end(), Envelope::never,
                 std::numeric_limits<double>::quiet_NaN());
    return times;
}

}  // namespace

void Envelope::see(double now, const std::vector<Flow>& profile, double arrival_depth) {
    if (now == time) return;
    if (depth.empty()) {
        for_each_column_array(*this,
                              [&](const char*, auto& values) { values.resize(profile.size()); });
        arrival.assign(profile.size(), never);
        time_of_peak.assign(profile.size(), never);
    }
    for (std::size_t k = 0; k < profile.size(); ++k) {
        const double h = profile[k].depth;
        const double v = std::abs(profile[k].velocity);
        // Thin soil ahead of the flow is faster than the flow.
        if (h >= arrival_depth) velocity[k] = std::max(velocity[k], v);
        flux[k] = std::max(flux[k], h * v * v);
        if (h > depth[k]) {
            depth[k] = h;
            time_of_peak[k] = now;
        }
        if (arrival[k] == never && h >= arrival_depth) {
            const double share = (arrival_depth - last_depth[k]) / (h - last_depth[k]);
            // Linear since the last sample; soil that is there at the first one arrives with it.
            arrival[k] = time == never ? now : time + share * (now - time);
        }
        last_depth[k] = h;
    }
    add_row(*this, now, profile);
    time = now;
}

void store(const Envelope& envelope, const std::string& prefix, exchange::Archive& archive) {
    const std::string name = prefix + "envelope.";
    for_each_column_array(envelope, [&](const char* what, const std::vector<double>& values) {
        archive.reals[name + what] = values;
    });
    archive.reals[name + "row_times"] = envelope.row_times;
    archive.reals[name + "row_depths"] = envelope.row_depths;
    archive.reals[name + "clock"] = {envelope.time, envelope.interval};
}

Envelope load_envelope(const exchange::Archive& archive, const std::string& prefix,
                       std::size_t columns) {
    const std::string name = prefix + "envelope.";
    Envelope envelope;
    const std::vector<double>& clock = archive.reals.at(name + "clock");
    envelope.time = clock.at(0);
    envelope.interval = clock.at(1);
    const std::size_t length = envelope.time == Envelope::never ? 0 : columns;
    const auto checked = [&](const char* what, std::size_t count) {
        const std::vector<double>& values = archive.reals.at(name + what);
        if (values.size() != count) throw std::out_of_range(name + what);
        return values;
    };
    for_each_column_array(envelope, [&](const char* what, std::vector<double>& values) {
        values = checked(what, length);
    });
    envelope.row_times = archive.reals.at(name + "row_times");
    if (envelope.row_times.size() > most_rows) throw std::out_of_range(name + "row_times");
    envelope.row_depths = checked("row_depths", envelope.row_times.size() * columns);
    return envelope;
}

void publish(const Envelope& envelope, const FlowView& view, const std::vector<Flow>& last,
             exchange::Archive& archive) {
    const auto put = [&](const char* what, const char* unit, std::vector<double> values) {
        const std::string name = std::string("envelope.") + what;
        archive.reals[name] = std::move(values);
        archive.units[name] = unit;
    };
    std::vector<double> deposit;
    for (const Flow& flow : last) deposit.push_back(flow.depth);
    put("x", "m", profile_places(view));
    put("largest_depth", "m", envelope.depth);
    put("largest_velocity", "m/s", envelope.velocity);
    put("largest_momentum_flux", "m3/s2", envelope.flux);
    put("arrival", "s", without_never(envelope.arrival));
    put("time_of_peak", "s", without_never(envelope.time_of_peak));
    put("final_depth", "m", std::move(deposit));
    put("times", "s", envelope.row_times);
    put("depths", "m", envelope.row_depths);
}

}  // namespace breach::mpm
