// Whole states in double precision, which a runout starts from or ends with, and frames in single
// precision, which are looked at. for_each_field is the one list of fields for writing, reading and
// checking, so that no field is in only some of them.
#include "core/exchange/particle_state.hpp"

#include <algorithm>
#include <functional>
#include <iterator>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "core/exchange/common_groups.hpp"

namespace breach::exchange {
namespace {

const Kind particle_kind{"particle_state", 1};
const Kind frame_kind{"particle_frame", 1};
const std::string at_points = "/VTKHDF/PointData/";
const std::string stress_of_regions = "/breachline/stress_of_regions";

/// The four arrays of strength are all there or none: the first one, cohesion, decides.
void check_sizes(const ParticleState& s) {
    const std::size_t n = s.size();
    bool agree = s.region.size() == n && s.regions.size() == s.materials_of_regions.size() &&
                 (s.stress_of_regions.empty() || s.stress_of_regions.size() == s.regions.size());
    for_each_field(s, [&](auto, auto, Given given, const auto& values) {
        // Both kinds of optional arrays are empty in a scene that has nothing for them.
        const std::size_t due = given == Given::with_cohesion ? s.strength.c.size() : n;
        agree &= values.size() == due || (given == Given::maybe && values.empty());
    });
    if (!agree) throw std::logic_error("particle state: arrays of different lengths");
}

template <class Real>
std::vector<Real> in_rows(const std::vector<double>& numbers) {
    return {numbers.begin(), numbers.end()};
}
/// xx, xy, yx, yy.
template <class Real>
std::vector<Real> in_rows(const std::vector<mechanics::Matrix2>& gradients) {
    std::vector<Real> values;
    values.reserve(4 * gradients.size());
    for (const mechanics::Matrix2& l : gradients)
        for (const double each : {l(0, 0), l(0, 1), l(1, 0), l(1, 1)})
            values.push_back(static_cast<Real>(each));
    return values;
}
template <class Real, int n>
std::vector<Real> in_rows(const std::vector<Eigen::Matrix<double, n, 1>>& rows) {
    return as_3d<Real>(rows);
}

void read_rows(Hdf5Reader& reader, const std::string& path, std::vector<double>& values) {
    reader.array(path, values, 0);
}
void read_rows(Hdf5Reader& reader, const std::string& path,
               std::vector<mechanics::Matrix2>& values) {
    std::vector<double> entries(4 * values.size());
    reader.array(path, entries, 4);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] << entries[4 * i], entries[4 * i + 1], entries[4 * i + 2], entries[4 * i + 3];
}
template <int n>
void read_rows(Hdf5Reader& reader, const std::string& path,
               std::vector<Eigen::Matrix<double, n, 1>>& values) {
    read_3d(reader, path, values);
}

/// Real: double, or float for display.
template <class Real>
void write_points(Hdf5Image& image, const ParticleState& s,
                  const std::function<bool(std::string_view)>& is_wanted) {
    std::vector<std::int64_t> corners(s.size());
    std::iota(corners.begin(), corners.end(), 0);
    write_grid<Real>(image, s.position, Cell::vertex, corners, s.time);
    image.array(at_points + "region", std::span<const std::int32_t>(s.region));
    for_each_field(s, [&](std::string_view name, const char* unit, Given, const auto& values) {
        if (values.empty() || !is_wanted(name)) return;
        const std::vector<Real> kept = in_rows<Real>(values);
        const std::size_t width = kept.size() / values.size();
        image.array(at_points + std::string(name), std::span<const Real>(kept),
                    width == 1 ? 0 : width, unit);
    });
}

/// Of states and frames alike: what a number at a point means without the fields.
void write_state(Hdf5Image& image, const ParticleState& state) {
    const std::string here = "/breachline";
    const auto points = static_cast<std::int64_t>(state.size());
    image.attribute(here, "time", state.time);
    image.attribute(here, "transfer_time", state.transfer_time);
    image.attribute(here, "thickness", state.thickness);
    image.attribute(here, "step", std::span(&state.step, 1));
    image.attribute(here, "points", std::span(&points, 1));
    write_regions(image, state.regions, state.materials_of_regions);
}

void write_stress_measures(Hdf5Image& image, const std::vector<StressMeasure>& measures) {
    if (measures.empty()) return;
    std::vector<std::string> names;
    for (const StressMeasure each : measures) names.emplace_back(words::name_of(each));
    image.strings(stress_of_regions, names);
}

/// Files without this list have effective stresses throughout.
std::vector<StressMeasure> read_stress_measures(Hdf5Reader& reader, std::size_t regions) {
    std::vector<StressMeasure> measures;
    if (!reader.exists(stress_of_regions)) return measures;
    for (const std::string& name : reader.strings(stress_of_regions)) {
        const auto measure = words::find<StressMeasure>(name);
        if (!measure)
            reader.fault(stress_of_regions, "\"" + name + "\" is not total, effective or buoyant");
        measures.push_back(measure.value_or(StressMeasure::effective));
    }
    if (measures.size() != regions)
        reader.fault(stress_of_regions, std::to_string(measures.size()) + " entries for " +
                                            std::to_string(regions) + " regions");
    return measures;
}

const std::string steady_pressure = "/breachline/steady_pressure";

void write_steady_pressure(Hdf5Image& image, const mechanics::NodalField& steady) {
    if (!steady.any()) return;
    const auto elements = static_cast<std::int64_t>(steady.quads.size());
    image.group(steady_pressure);
    image.attribute(steady_pressure, "elements", std::span(&elements, 1));
    image.array(steady_pressure + "/position", flat(steady.position), 2, "m");
    image.array(steady_pressure + "/quads",
                std::span<const std::int32_t>(steady.quads.front().data(), 4 * steady.quads.size()),
                4);
    image.array(steady_pressure + "/pressure", steady.value, 0, "Pa");
}

mechanics::NodalField read_steady_pressure(Hdf5Reader& reader) {
    mechanics::NodalField steady;
    if (!reader.exists(steady_pressure)) return steady;
    steady.value = reader.finite_reals(steady_pressure + "/pressure");
    steady.position.resize(reader.rows(steady_pressure + "/position"));
    reader.array(steady_pressure + "/position", flat(steady.position), 2);
    steady.quads.resize(reader.count_attribute(steady_pressure, "elements"));
    if (steady.quads.empty() || steady.position.size() != steady.value.size()) {
        reader.fault(steady_pressure, "positions, pressures or quads are missing");
        return {};
    }
    reader.array(steady_pressure + "/quads",
                 std::span<std::int32_t>(steady.quads.front().data(), 4 * steady.quads.size()), 4);
    for (const auto& quad : steady.quads)
        for (const std::int32_t node : quad)
            if (node < 0 || static_cast<std::size_t>(node) >= steady.value.size()) {
                reader.fault(steady_pressure + "/quads", "names node " + std::to_string(node) +
                                                             " of " +
                                                             std::to_string(steady.value.size()));
                return {};
            }
    return steady;
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

/// Fields that a file must have: all except those of water, or none.
enum class Wanted { state, what_is_there };

/// Reads the fields that exist; a missing required one is a fault.
void read_points(Hdf5Reader& reader, ParticleState& s, std::size_t n, Wanted wanted) {
    s.position.resize(n);
    read_3d(reader, "/VTKHDF/Points", s.position);
    s.region.resize(n);
    reader.array(at_points + "region", s.region);
    const bool has_cohesion = reader.exists(at_points + "cohesion");
    for_each_field(s, [&](const char* name, auto, Given given, auto& values) {
        const std::string path = at_points + name;
        // An optional field that exists is read in full: too short, it is a fault like any other.
        const bool must_be = (given == Given::always && wanted == Wanted::state) ||
                             (given == Given::with_cohesion && has_cohesion);
        if (!must_be && !reader.exists(path)) return;
        values.resize(n);
        read_rows(reader, path, values);
    });
}

ParticleState read_state(Hdf5Reader& reader, Wanted wanted) {
    const std::string here = "/breachline";
    ParticleState s;
    s.time = reader.real_attribute(here, "time");
    s.transfer_time = reader.real_attribute(here, "transfer_time");
    s.thickness = reader.real_attribute(here, "thickness");
    s.step = reader.integer_attribute(here, "step");
    const std::int64_t points = reader.integer_attribute(here, "points");
    reader.refuse_if_faulty();
    if (points <= 0) reader.fault(here + "@points", "no particles");
    const std::size_t n = reader.rows("/VTKHDF/Points");
    // Two sources of one number: a truncated array may still be a valid dataset.
    if (n != 0 && points > 0 && n != static_cast<std::size_t>(points))
        reader.fault("/VTKHDF/Points", std::to_string(n) + " rows, but /breachline@points is " +
                                           std::to_string(points));
    reader.refuse_if_faulty();
    read_points(reader, s, n, wanted);
    read_regions(reader, s.regions, s.materials_of_regions);
    return s;
}

void check_meaning(Hdf5Reader& reader, const ParticleState& s) {
    if (s.thickness <= 0.0) reader.fault("/breachline@thickness", "must be positive");
    check_region_indices(reader, at_points + "region", s.region, s.regions.size());
    check_positive(reader, at_points + "mass", s.mass);
    check_positive(reader, at_points + "volume_0", s.volume_0);
    check_positive(reader, at_points + "volume", s.volume);
}

}  // namespace

/// For a caller that fills a state point by point; arrays that only some scenes have stay empty.
void ParticleState::resize(std::size_t n) {
    position.resize(n, mechanics::Vec2::Zero());
    region.resize(n);
    for_each_field(*this, [&](auto, auto, Given given, auto& values) {
        using Value = typename std::decay_t<decltype(values)>::value_type;
        if (given != Given::always) return;
        if constexpr (std::is_same_v<Value, double>)
            values.resize(n);
        else
            values.resize(n, Value::Zero());
    });
}

/// Only effective stress has u beside it: a total stress contains it, and adding it would count it
/// twice.
double ParticleState::pressure_beside(std::size_t p) const {
    const bool is_effective =
        stress_of_regions.empty() || stress_of_regions[region[p]] == StressMeasure::effective;
    return is_effective && !pore_pressure.empty() ? pore_pressure[p] : 0.0;
}

void write_particle_state(const std::filesystem::path& path, const ParticleState& state,
                          const Provenance& provenance, const Ledger& ledger) {
    check_sizes(state);
    Hdf5Image image(particle_kind);
    write_points<double>(image, state, [](std::string_view) { return true; });
    write_state(image, state);
    write_stress_measures(image, state.stress_of_regions);
    write_base_motion(image, state.base_motion);
    write_steady_pressure(image, state.steady_pressure);
    if (!ledger.empty()) write_ledger(image, ledger);
    write_provenance(image, provenance);
    std::move(image).save(path);
}

ParticleStateFile read_particle_state(const std::filesystem::path& path) {
    Hdf5Reader reader(path, {particle_kind},
                      "give whole particles: particles.vtkhdf of transfer_tool or final.vtkhdf of "
                      "mpm_solver, whose frames are only to be looked at");
    ParticleStateFile file;
    ParticleState& s = file.state;
    s = read_state(reader, Wanted::state);
    s.stress_of_regions = read_stress_measures(reader, s.regions.size());
    s.base_motion = read_base_motion(reader);
    s.steady_pressure = read_steady_pressure(reader);
    file.ledger = read_ledger(reader);
    file.provenance = read_provenance(reader);
    reader.check_rest();
    reader.refuse_if_faulty();
    check_meaning(reader, s);
    reader.refuse_if_faulty();
    return file;
}

void write_particle_frame(const std::filesystem::path& path, const ParticleState& state,
                          std::span<const std::string_view> fields, const Provenance& provenance) {
    check_sizes(state);
    for (const std::string_view name : fields) {
        // A misspelt name would silently write a frame without the field.
        bool known = false;
        for_each_field(state,
                       [&](std::string_view each, auto, auto, auto&) { known |= each == name; });
        if (!known) throw std::logic_error("points have no field " + std::string(name));
    }
    Hdf5Image image(frame_kind, Storage::compressed);
    write_points<float>(image, state, [&](std::string_view name) {
        return std::ranges::find(fields, name) != fields.end();
    });
    write_state(image, state);
    write_provenance(image, provenance);
    std::move(image).save(path);
}

/// For the dashboard's pictures, which take a final state as their last frame.
ParticleState read_particle_frame(const std::filesystem::path& path) {
    Hdf5Reader reader(path, {frame_kind, particle_kind}, "give particles that mpm_solver wrote");
    ParticleState s = read_state(reader, Wanted::what_is_there);
    reader.check_rest();
    reader.refuse_if_faulty();
    check_meaning(reader, s);
    reader.refuse_if_faulty();
    return s;
}

}  // namespace breach::exchange
