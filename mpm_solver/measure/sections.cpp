#include "mpm_solver/measure/sections.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace breach::mpm {

namespace {

/// Half the edge of a point's square, clipped if the section is nearer to the grid's end [m].
double half_edge(const Points& points, std::size_t p, const FlowView& view, double x) {
    const double room = std::max(0.0, std::min(x - view.low, view.high - x));
    return std::min(0.5 * std::sqrt(points.V_0[p] / view.thickness), room);
}

}  // namespace

Beyond beyond(const Points& points, const FlowView& view, double x) {
    Beyond sum;
    for (std::size_t p = 0; p < points.size(); ++p) {
        const double distance = points.x[p] - x;
        if (distance <= -view.width || !view.mobile[points.region[p]]) continue;
        const double a = half_edge(points, p, view, x);
        const double share = distance > a ? 1.0 : distance > -a ? 0.5 * (1.0 + distance / a) : 0.0;
        sum.volume += share * points.V_0[p];
        sum.mass += share * points.m[p];
    }
    return {sum.volume / view.thickness, sum.mass / view.thickness};
}

double flux_at(const Body& body, const FlowView& view, double x) {
    const Points& points = body.points;
    // Points within a cell have homes at most two columns away.
    const auto column = static_cast<std::int32_t>(body.grid.xi(x));
    const std::int32_t first = std::max(column - 2, 0) / Strips::width;
    const std::int32_t last =
        std::min((column + 2) / Strips::width, static_cast<std::int32_t>(body.strips.count()) - 1);
    double sum = 0.0;
    for (std::int32_t strip = first; strip <= last; ++strip) {
        for (std::size_t z = 0; z < body.zones.size(); ++z) {
            // The strips spare a pass over all points at every sample.
            const Span span = body.strips.span(static_cast<std::size_t>(strip), z);
            for (std::size_t p = span.begin; p < span.end; ++p) {
                const double distance = std::abs(points.x[p] - x);
                if (distance >= view.width || !view.mobile[points.region[p]]) continue;
                const double a = half_edge(points, p, view, x);
                if (distance < a) sum += points.V_0[p] * points.vx[p] / (2.0 * a);
            }
        }
    }
    return sum / view.thickness;
}

void sample_sections(const std::vector<scene::FlowSection>& sections, const Body& body,
                     const FlowView& view, double now, SectionRecords& records) {
    records.resize(sections.size());
    for (std::size_t k = 0; k < sections.size(); ++k) {
        SectionRecord& record = records[k];
        // A measurement may coincide with a sample of advance().
        if (now == record.time) continue;
        const double flux = flux_at(body, view, sections[k].x);
        if (record.time >= 0.0)
            record.by_momentum += 0.5 * (record.flux + flux) * (now - record.time);
        record.flux = flux;
        record.time = now;
    }
}

void read_sections(const std::vector<scene::FlowSection>& sections, const Points& points,
                   const FlowView& view, double now, double since, SectionRecords& records) {
    records.resize(sections.size());
    for (std::size_t k = 0; k < sections.size(); ++k) {
        SectionRecord& record = records[k];
        const Beyond there = beyond(points, view, sections[k].x);
        const bool first = record.volume.empty();
        if (first) record.start = there;
        const double passed = there.volume - record.start.volume;
        const double before = first ? 0.0 : record.volume.back();
        record.discharge.push_back(now > since ? (passed - before) / (now - since) : 0.0);
        const Flow flow = without_grains(flow_at(points, view, sections[k].x));
        record.depth.push_back(flow.depth);
        record.velocity.push_back(flow.velocity);
        record.volume.push_back(passed);
        record.mass.push_back(there.mass - record.start.mass);
    }
}

std::optional<Peak> peak_of(const SectionRecord& record, const std::vector<double>& times,
                            const FlowView& view, double arrival_depth) {
    double fastest = fastest_of(record.depth, record.velocity, arrival_depth);
    // No reading is so deep: any depth is better than no peak.
    if (fastest == 0.0) fastest = fastest_of(record.depth, record.velocity, 0.0);
    if (fastest == 0.0 || times.size() < 2) return std::nullopt;
    const double window = 2.0 * view.width / fastest;
    const auto passed = [&](double at) {
        if (at <= times.front()) return record.volume.front();
        if (at >= times.back()) return record.volume.back();
        const auto k = std::upper_bound(times.begin(), times.end(), at) - times.begin();
        const double share = (at - times[k - 1]) / (times[k] - times[k - 1]);
        return record.volume[k - 1] + share * (record.volume[k] - record.volume[k - 1]);
    };
    Peak peak{.window = window};
    for (const double time : times) {
        const double mean = (passed(time + 0.5 * window) - passed(time - 0.5 * window)) / window;
        if (mean > peak.discharge) {
            peak.discharge = mean;
            peak.time = time;
        }
    }
    return peak.discharge > 0.0 ? std::optional(peak) : std::nullopt;
}

std::optional<double> closure_of(const SectionRecord& record) {
    double moved = 0.0;
    double before = 0.0;
    for (const double volume : record.volume) {
        moved += std::abs(volume - before);
        before = volume;
    }
    // Without flow: round-off of the sum beyond the section.
    if (moved <= 1e-9 * std::max(1.0, record.start.volume)) return std::nullopt;
    return (record.by_momentum - before) / moved;
}

void store(const std::vector<scene::FlowSection>& sections, const SectionRecords& records,
           const std::string& prefix, SectionState state, exchange::Archive& archive) {
    for (std::size_t k = 0; k < records.size(); ++k) {
        const SectionRecord& record = records[k];
        const std::string name = prefix + "section." + sections[k].name + ".";
        for_each_column_of_section(
            record, [&](const char* what, const char* unit, const std::vector<double>& values) {
                archive.reals[name + what] = values;
                archive.units[name + what] = unit;
            });
        if (state == SectionState::rows) continue;
        archive.reals[name + "state"] = {record.start.volume, record.start.mass, record.by_momentum,
                                         record.flux, record.time};
    }
}

SectionRecords load_sections(const std::vector<scene::FlowSection>& sections,
                             const exchange::Archive& archive, const std::string& prefix,
                             std::size_t rows) {
    SectionRecords records;
    for (const scene::FlowSection& section : sections) {
        const std::string name = prefix + "section." + section.name + ".";
        if (rows == 0 && !archive.reals.contains(name + "state")) return {};  // no measurement yet
        const std::vector<double>& state = archive.reals.at(name + "state");
        SectionRecord record;
        record.start = {state.at(0), state.at(1)};
        record.by_momentum = state.at(2);
        record.flux = state.at(3);
        record.time = state.at(4);
        for_each_column_of_section(record,
                                   [&](const char* what, const char*, std::vector<double>& values) {
                                       values = archive.reals.at(name + what);
                                       if (values.size() != rows)
                                           throw std::out_of_range(name + what);
                                   });
        records.push_back(std::move(record));
    }
    return records;
}

}  // namespace breach::mpm
