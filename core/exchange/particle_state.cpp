#include "core/exchange/particle_state.hpp"

#include <numeric>
#include <stdexcept>
#include <utility>

#include "core/exchange/common_groups.hpp"

namespace breach::exchange {
namespace {

const Kind kind{"particle_state", 1};
const std::string at_points = "/VTKHDF/PointData/";
const std::string stress_of_regions = "/breachline/stress_of_regions";

void check_sizes(const ParticleState& s) {
    const std::size_t n = s.size();
    const bool agree =
        s.velocity.size() == n && s.velocity_gradient.size() == n && s.mass.size() == n &&
        s.volume_0.size() == n && s.volume.size() == n && s.stress.size() == n &&
        s.epsilon_q.size() == n && s.epsilon_q_plastic.size() == n && s.gap.size() == n &&
        s.region.size() == n && s.regions.size() == s.materials_of_regions.size() &&
        (s.stress_of_regions.empty() || s.stress_of_regions.size() == s.regions.size()) &&
        (s.pore_pressure.empty() || s.pore_pressure.size() == n) &&
        (s.r_u.empty() || s.r_u.size() == n);
    if (!agree) throw std::logic_error("particle state: arrays of different lengths");
}

void write_points(Hdf5Image& image, const ParticleState& s) {
    std::vector<std::int64_t> corners(s.size());
    std::iota(corners.begin(), corners.end(), 0);
    write_grid(image, s.position, Cell::vertex, corners, s.time);
    std::vector<double> gradient;  // row by row: xx, xy, yx, yy
    gradient.reserve(4 * s.size());
    for (const mechanics::Matrix2& l : s.velocity_gradient)
        gradient.insert(gradient.end(), {l(0, 0), l(0, 1), l(1, 0), l(1, 1)});
    image.array(at_points + "velocity", as_3d(s.velocity), 3, "m/s");
    image.array(at_points + "velocity_gradient", gradient, 4, "1/s");
    image.array(at_points + "mass", s.mass, 0, "kg");
    image.array(at_points + "volume_0", s.volume_0, 0, "m3");
    image.array(at_points + "volume", s.volume, 0, "m3");
    image.array(at_points + "stress", as_3d(s.stress), 6, "Pa");
    image.array(at_points + "epsilon_q", s.epsilon_q, 0, "1");
    image.array(at_points + "epsilon_q_plastic", s.epsilon_q_plastic, 0, "1");
    image.array(at_points + "gap", s.gap, 0, "1");
    image.array(at_points + "region", std::span<const std::int32_t>(s.region));
    if (!s.pore_pressure.empty())
        image.array(at_points + "pore_pressure", s.pore_pressure, 0, "Pa");
    if (!s.r_u.empty()) image.array(at_points + "r_u", s.r_u, 0, "1");
}

void write_stress_measures(Hdf5Image& image, const std::vector<StressMeasure>& measures) {
    if (measures.empty()) return;
    std::vector<std::string> names;
    for (const StressMeasure each : measures) names.emplace_back(words::name_of(each));
    image.strings(stress_of_regions, names);
}

std::vector<StressMeasure> read_stress_measures(Hdf5Reader& reader, std::size_t regions) {
    std::vector<StressMeasure> measures;
    if (!reader.exists(stress_of_regions)) return measures;
    for (const std::string& name : reader.strings(stress_of_regions)) {
        const auto measure = words::find<StressMeasure>(name);
        if (!measure)
            reader.fault(stress_of_regions, "\"" + name + "\" is neither total nor effective");
        measures.push_back(measure.value_or(StressMeasure::effective));
    }
    if (measures.size() != regions)
        reader.fault(stress_of_regions, std::to_string(measures.size()) + " entries for " +
                                            std::to_string(regions) + " regions");
    return measures;
}

void write_ledger(Hdf5Image& image, const Ledger& ledger) {
    std::vector<std::string> region, quantity, unit;
    std::vector<double> before, after, difference;
    for (const LedgerRow& row : ledger) {
        region.push_back(row.region);
        quantity.push_back(row.quantity);
        unit.push_back(row.unit);
        before.push_back(row.before);
        after.push_back(row.after);
        difference.push_back(row.difference);
    }
    const std::string here = "/breachline/ledger";
    image.group(here);
    image.strings(here + "/region", region);
    image.strings(here + "/quantity", quantity);
    image.strings(here + "/unit", unit);
    image.array(here + "/before", before, 0);
    image.array(here + "/after", after, 0);
    image.array(here + "/relative_difference", difference, 0, "1");
}

Ledger read_ledger(Hdf5Reader& reader) {
    const std::string here = "/breachline/ledger";
    if (!reader.exists(here)) return {};
    const auto region = reader.strings(here + "/region");
    const auto quantity = reader.strings(here + "/quantity");
    const auto unit = reader.strings(here + "/unit");
    std::vector<double> before(region.size()), after(region.size()), difference(region.size());
    reader.array(here + "/before", before, 0);
    reader.array(here + "/after", after, 0);
    reader.array(here + "/relative_difference", difference, 0);
    if (quantity.size() != region.size() || unit.size() != region.size()) {
        reader.fault(here, "columns of different lengths");
        return {};
    }
    Ledger ledger;
    for (std::size_t i = 0; i < region.size(); ++i)
        ledger.push_back({region[i], quantity[i], unit[i], before[i], after[i], difference[i]});
    return ledger;
}

void read_points(Hdf5Reader& reader, ParticleState& s, std::size_t n) {
    for (auto* field : {&s.position, &s.velocity}) field->resize(n);
    for (auto* field :
         {&s.mass, &s.volume_0, &s.volume, &s.epsilon_q, &s.epsilon_q_plastic, &s.gap})
        field->resize(n);
    s.stress.resize(n);
    s.region.resize(n);
    s.velocity_gradient.resize(n);
    std::vector<double> gradient(4 * n);
    read_3d(reader, "/VTKHDF/Points", s.position);
    read_3d(reader, at_points + "velocity", s.velocity);
    reader.array(at_points + "velocity_gradient", gradient, 4);
    for (std::size_t i = 0; i < n; ++i)
        s.velocity_gradient[i] << gradient[4 * i], gradient[4 * i + 1], gradient[4 * i + 2],
            gradient[4 * i + 3];
    reader.array(at_points + "mass", s.mass, 0);
    reader.array(at_points + "volume_0", s.volume_0, 0);
    reader.array(at_points + "volume", s.volume, 0);
    read_3d(reader, at_points + "stress", s.stress);
    reader.array(at_points + "epsilon_q", s.epsilon_q, 0);
    reader.array(at_points + "epsilon_q_plastic", s.epsilon_q_plastic, 0);
    reader.array(at_points + "gap", s.gap, 0);
    reader.array(at_points + "region", s.region);
    for (const auto& [name, field] :
         {std::pair{"pore_pressure", &s.pore_pressure}, std::pair{"r_u", &s.r_u}}) {
        if (!reader.exists(at_points + name)) continue;
        field->resize(n);
        reader.array(at_points + name, *field, 0);
    }
}

void check_meaning(Hdf5Reader& reader, const ParticleState& s) {
    if (s.thickness <= 0.0) reader.fault("/breachline@thickness", "must be positive");
    check_region_indices(reader, at_points + "region", s.region, s.regions.size());
    check_positive(reader, at_points + "mass", s.mass);
    check_positive(reader, at_points + "volume_0", s.volume_0);
    check_positive(reader, at_points + "volume", s.volume);
}

}  // namespace

void write_particle_state(const std::filesystem::path& path, const ParticleState& state,
                          const Provenance& provenance, const Ledger& ledger) {
    check_sizes(state);
    const std::string here = "/breachline";
    Hdf5Image image(kind);
    const auto points = static_cast<std::int64_t>(state.size());
    image.attribute(here, "time", state.time);
    image.attribute(here, "transfer_time", state.transfer_time);
    image.attribute(here, "thickness", state.thickness);
    image.attribute(here, "step", std::span(&state.step, 1));
    image.attribute(here, "points", std::span(&points, 1));
    write_points(image, state);
    write_regions(image, state.regions, state.materials_of_regions);
    write_stress_measures(image, state.stress_of_regions);
    write_base_motion(image, state.base_motion);
    if (!ledger.empty()) write_ledger(image, ledger);
    write_provenance(image, provenance);
    std::move(image).save(path);
}

ParticleStateFile read_particle_state(const std::filesystem::path& path) {
    Hdf5Reader reader(path, kind, "give whole particles as transfer_tool or mpm_solver wrote them");
    const std::string here = "/breachline";
    ParticleStateFile file;
    ParticleState& s = file.state;
    s.time = reader.real_attribute(here, "time");
    s.transfer_time = reader.real_attribute(here, "transfer_time");
    s.thickness = reader.real_attribute(here, "thickness");
    s.step = reader.integer_attribute(here, "step");
    const std::size_t n = reader.count_attribute(here, "points");
    if (n == 0) reader.fault(here + "@points", "no particles");
    reader.refuse_if_faulty();

    read_points(reader, s, n);
    read_regions(reader, s.regions, s.materials_of_regions);
    s.stress_of_regions = read_stress_measures(reader, s.regions.size());
    s.base_motion = read_base_motion(reader);
    file.ledger = read_ledger(reader);
    file.provenance = read_provenance(reader);
    reader.check_rest();
    reader.refuse_if_faulty();
    check_meaning(reader, s);
    reader.refuse_if_faulty();
    return file;
}

}  // namespace breach::exchange
