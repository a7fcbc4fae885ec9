// What the files of meshes and of points have in common. ParaView reads the group /VTKHDF,
// Breachline reads both it and /breachline, so a quantity is stored once where ParaView's type
// loses nothing.
#include "core/exchange/common_groups.hpp"

namespace breach::exchange {
namespace {

constexpr std::size_t corners_of(Cell cell) { return cell == Cell::quad ? 4 : 1; }

/// ParaView knows vectors of three and symmetric tensors of six components; the zeros that plane
/// strain adds are dropped again here.
template <int n>
void read_padded(Hdf5Reader& reader, const std::string& path,
                 std::vector<Eigen::Matrix<double, n, 1>>& rows, std::size_t width) {
    std::vector<double> values(rows.size() * width);
    reader.array(path, values, width);
    for (std::size_t i = 0; i < rows.size(); ++i)
        for (int j = 0; j < n; ++j) rows[i][j] = values[i * width + j];
}

}  // namespace

void read_3d(Hdf5Reader& reader, const std::string& path, std::vector<mechanics::Vec2>& values) {
    read_padded<2>(reader, path, values, 3);
}

void read_3d(Hdf5Reader& reader, const std::string& path, std::vector<mechanics::Voigt>& values) {
    read_padded<4>(reader, path, values, 6);
}

template <class Real>
void write_grid(Hdf5Image& image, const std::vector<mechanics::Vec2>& points, Cell cell,
                std::span<const std::int64_t> corners, double time) {
    const std::size_t cells = corners.size() / corners_of(cell);
    const auto n_points = static_cast<std::int64_t>(points.size());
    const auto n_cells = static_cast<std::int64_t>(cells);
    const auto n_corners = static_cast<std::int64_t>(corners.size());
    std::vector<std::int64_t> offsets(cells + 1);
    for (std::size_t i = 0; i < offsets.size(); ++i)
        offsets[i] = static_cast<std::int64_t>(i * corners_of(cell));
    const std::vector<std::uint8_t> types(cells, static_cast<std::uint8_t>(cell));

    image.group("/VTKHDF");
    // VTKHDF 1.0 has no time steps inside a file; a run's times come from the series beside
    // (core/process/series.hpp).
    const std::int64_t version[2] = {1, 0};
    image.attribute("/VTKHDF", "Version", std::span(version));
    image.attribute("/VTKHDF", "Type", std::string("UnstructuredGrid"));
    image.array("/VTKHDF/NumberOfPoints", std::span(&n_points, 1));
    image.array("/VTKHDF/NumberOfCells", std::span(&n_cells, 1));
    image.array("/VTKHDF/NumberOfConnectivityIds", std::span(&n_corners, 1));
    image.array("/VTKHDF/Points", std::span<const Real>(as_3d<Real>(points)), 3, "m");
    image.array("/VTKHDF/Connectivity", corners);
    image.array("/VTKHDF/Offsets", std::span<const std::int64_t>(offsets));
    image.array("/VTKHDF/Types", std::span<const std::uint8_t>(types));
    for (const char* data : {"/VTKHDF/PointData", "/VTKHDF/CellData", "/VTKHDF/FieldData"})
        image.group(data);
    image.array("/VTKHDF/FieldData/time", std::span<const double>(&time, 1), 0, "s");
}

template void write_grid<double>(Hdf5Image&, const std::vector<mechanics::Vec2>&, Cell,
                                 std::span<const std::int64_t>, double);
template void write_grid<float>(Hdf5Image&, const std::vector<mechanics::Vec2>&, Cell,
                                std::span<const std::int64_t>, double);

void write_regions(Hdf5Image& image, const std::vector<std::string>& regions,
                   const std::vector<std::string>& materials) {
    image.strings("/breachline/regions", regions);
    image.strings("/breachline/materials_of_regions", materials);
}

void read_regions(Hdf5Reader& reader, std::vector<std::string>& regions,
                  std::vector<std::string>& materials) {
    regions = reader.strings("/breachline/regions");
    materials = reader.strings("/breachline/materials_of_regions");
    if (regions.size() != materials.size())
        reader.fault("/breachline/materials_of_regions",
                     std::to_string(materials.size()) + " materials for " +
                         std::to_string(regions.size()) + " regions");
}

/// Stops at the first bad row: a damaged file would otherwise give one fault for each point.
void check_region_indices(Hdf5Reader& reader, const std::string& path,
                          const std::vector<std::int32_t>& indices, std::size_t regions) {
    for (std::size_t i = 0; i < indices.size(); ++i)
        if (indices[i] < 0 || static_cast<std::size_t>(indices[i]) >= regions)
            return reader.fault(path, "row " + std::to_string(i) + " names region " +
                                          std::to_string(indices[i]) + " of " +
                                          std::to_string(regions));
}

void check_positive(Hdf5Reader& reader, const std::string& path,
                    const std::vector<double>& values) {
    for (std::size_t i = 0; i < values.size(); ++i)
        if (values[i] <= 0.0)
            return reader.fault(path, "row " + std::to_string(i) + " is " +
                                          std::to_string(values[i]) + ", must be positive");
}

namespace {
const std::string base_motion = "/breachline/base_motion";
}  // namespace

void write_base_motion(Hdf5Image& image, const BaseMotion& motion) {
    if (!motion.any()) return;
    // Absent, not empty, where the ground's motion is unknown: an empty velocity is a fault on
    // reading.
    image.group(base_motion);
    image.attribute(base_motion, "time_step", motion.time_step);
    image.array(base_motion + "/velocity", motion.velocity, 0, "m/s");
}

BaseMotion read_base_motion(Hdf5Reader& reader) {
    if (!reader.exists(base_motion)) return {};
    BaseMotion motion;
    motion.time_step = reader.real_attribute(base_motion, "time_step");
    motion.velocity = reader.finite_reals(base_motion + "/velocity");
    if (!(motion.time_step > 0.0)) reader.fault(base_motion + "@time_step", "must be positive");
    if (!motion.any()) reader.fault(base_motion + "/velocity", "is empty");
    return motion;
}

void write_provenance(Hdf5Image& image, const Provenance& provenance) {
    const std::string here = "/breachline/provenance";
    image.group(here);
    image.attribute(here, "phase", provenance.phase);
    image.attribute(here, "version", provenance.version);
    const std::int64_t threads = provenance.threads;
    image.attribute(here, "threads", std::span(&threads, 1));
    image.attribute(here, "wall_seconds", provenance.spent.wall);
    image.attribute(here, "cpu_seconds", provenance.spent.cpu);
    // A dataset, not an attribute: HDF5 limits attributes to 64 KiB and a scene may be longer.
    image.strings(here + "/scene", {provenance.scene});
    image.strings(here + "/overrides", provenance.overrides);
    std::vector<std::string> paths;
    std::vector<std::string> digests;
    for (const InputDigest& input : provenance.inputs) {
        paths.push_back(input.path);
        digests.push_back(input.sha256);
    }
    image.strings(here + "/input_paths", paths);
    image.strings(here + "/input_sha256", digests);
}

Provenance read_provenance(Hdf5Reader& reader) {
    const std::string here = "/breachline/provenance";
    Provenance provenance;
    provenance.phase = reader.text_attribute(here, "phase");
    provenance.version = reader.text_attribute(here, "version");
    provenance.threads = static_cast<int>(reader.integer_attribute(here, "threads"));
    provenance.spent.wall = reader.real_attribute(here, "wall_seconds");
    provenance.spent.cpu = reader.real_attribute(here, "cpu_seconds");
    for (const std::string& text : reader.strings(here + "/scene")) provenance.scene += text;
    provenance.overrides = reader.strings(here + "/overrides");
    const std::vector<std::string> paths = reader.strings(here + "/input_paths");
    const std::vector<std::string> digests = reader.strings(here + "/input_sha256");
    if (paths.size() != digests.size())
        reader.fault(here + "/input_sha256", std::to_string(digests.size()) + " digests for " +
                                                 std::to_string(paths.size()) + " inputs");
    else
        for (std::size_t i = 0; i < paths.size(); ++i)
            provenance.inputs.push_back({paths[i], digests[i]});
    return provenance;
}

}  // namespace breach::exchange
