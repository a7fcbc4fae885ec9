#include "mpm_solver/measure/gauges.hpp"

namespace breach::mpm {

void read_gauges(const std::vector<scene::Gauge>& gauges, const Points& points,
                 const FlowView& view, GaugeRecords& records) {
    records.resize(gauges.size());
    for (std::size_t k = 0; k < gauges.size(); ++k) {
        const Flow flow = without_grains(flow_at(points, view, gauges[k].x));
        records[k].depth.push_back(flow.depth);
        records[k].velocity.push_back(flow.velocity);
    }
}

std::optional<double> arrival_time(const std::vector<double>& times,
                                   const std::vector<double>& depth, double arrival_depth) {
    for (std::size_t k = 0; k < depth.size(); ++k) {
        if (depth[k] < arrival_depth) continue;
        if (k == 0) return times[0];
        const double share = (arrival_depth - depth[k - 1]) / (depth[k] - depth[k - 1]);
        return times[k - 1] + share * (times[k] - times[k - 1]);
    }
    return std::nullopt;
}

void store(const std::vector<scene::Gauge>& gauges, const GaugeRecords& records,
           const std::string& prefix, exchange::Archive& archive) {
    for (std::size_t k = 0; k < records.size(); ++k) {
        const auto put = [&](const char* what, const char* unit,
                             const std::vector<double>& values) {
            const std::string name = prefix + "gauge." + gauges[k].name + what;
            archive.reals[name] = values;
            archive.units[name] = unit;
        };
        put(".depth", "m", records[k].depth);
        put(".velocity", "m/s", records[k].velocity);
    }
}

GaugeRecords load_gauges(const std::vector<scene::Gauge>& gauges, const exchange::Archive& archive,
                         const std::string& prefix) {
    GaugeRecords records;
    for (const scene::Gauge& gauge : gauges) {
        const std::string name = prefix + "gauge." + gauge.name;
        records.push_back(
            {archive.reals.at(name + ".depth"), archive.reals.at(name + ".velocity")});
    }
    return records;
}

}  // namespace breach::mpm
