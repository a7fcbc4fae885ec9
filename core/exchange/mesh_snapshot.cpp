// A snapshot's file has two parts. What ParaView shows is in /VTKHDF: nodal fields in full, Gauss
// fields as averages. What the transfer needs beyond that is in /breachline: undeformed nodes and
// every Gauss point. Reading takes each quantity from the part that has it exactly.
#include "core/exchange/mesh_snapshot.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "core/exchange/common_groups.hpp"

namespace breach::exchange {
namespace {

using mechanics::Vec2;
using mechanics::Voigt;

const Kind mesh_kind{"mesh_snapshot", 1};

/// A programming error of the FEM, not of a user: reading has checks of its own.
void check_sizes(const MeshSnapshot& s) {
    const std::size_t nodes = s.position_0.size();
    const std::size_t elements = s.quads.size();
    const std::size_t points = elements * static_cast<std::size_t>(s.gauss_per_element);
    const bool agree =
        s.displacement.size() == nodes && s.velocity.size() == nodes &&
        s.acceleration.size() == nodes && s.nodal_mass.size() == nodes &&
        (s.pore_pressure.empty() || s.pore_pressure.size() == nodes) &&
        (s.sigma_v0.empty() || s.sigma_v0.size() == nodes) &&
        s.pore_pressure_0.size() == s.sigma_v0.size() &&
        (s.excess_pressure_max.empty() ||
         s.excess_pressure_max.size() == s.pore_pressure_0.size()) &&
        (s.sigma_v0.empty() || !s.pore_pressure.empty()) &&
        s.region_of_element.size() == elements && s.density.size() == elements &&
        s.gauss_positions.size() == static_cast<std::size_t>(s.gauss_per_element) &&
        s.stress.size() == points && s.strain.size() == points && s.epsilon_q.size() == points &&
        s.epsilon_q_plastic.size() == points && (s.r_u_max.empty() || s.r_u_max.size() == points) &&
        s.shear_strain_max.size() == s.r_u_max.size() &&
        (s.psi.empty() || s.psi.size() == points) && s.instability_ratio.size() == s.psi.size() &&
        s.regions.size() == s.materials_of_regions.size();
    if (!agree) throw std::logic_error("mesh snapshot: arrays of different lengths");
}

/// Mean over each element's Gauss points, [n_elements, width] from [n_elements * gauss, n].
std::vector<double> averages(std::span<const double> values, std::size_t n, std::size_t gauss,
                             std::size_t width) {
    const std::size_t elements = values.size() / (n * gauss);
    std::vector<double> mean(elements * width, 0.0);
    for (std::size_t e = 0; e < elements; ++e)
        for (std::size_t g = 0; g < gauss; ++g)
            for (std::size_t j = 0; j < n; ++j)
                mean[e * width + j] += values[(e * gauss + g) * n + j] / static_cast<double>(gauss);
    return mean;
}

/// 1 if a corner of the deformed element is inside out, else 0.
/// For people who look at a failing mesh in ParaView. The FEM ends a run by a measure of its own.
std::vector<std::int32_t> inverted_elements(const MeshSnapshot& s) {
    std::vector<std::int32_t> inverted;
    const auto is_there = [&](std::int32_t node) {
        return node >= 0 && static_cast<std::size_t>(node) < s.position_0.size();
    };
    for (const auto& quad : s.quads) {
        if (!std::ranges::all_of(quad, is_there)) {  // readers refuse such a snapshot
            inverted.push_back(1);
            continue;
        }
        Eigen::Matrix<double, 2, 4> before, now;
        for (int k = 0; k < 4; ++k) {
            before.col(k) = s.position_0[quad[k]];
            now.col(k) = before.col(k) + s.displacement[quad[k]];
        }
        inverted.push_back(mechanics::jacobian_ratio(now, before).least <= 0.0 ? 1 : 0);
    }
    return inverted;
}

void write_visible(Hdf5Image& image, const MeshSnapshot& s) {
    std::vector<Vec2> position(s.position_0.size());
    for (std::size_t i = 0; i < position.size(); ++i)
        position[i] = s.position_0[i] + s.displacement[i];
    std::vector<std::int64_t> corners;
    corners.reserve(4 * s.quads.size());
    for (const auto& quad : s.quads) corners.insert(corners.end(), quad.begin(), quad.end());
    write_grid<double>(image, position, Cell::quad, corners, s.time);

    const std::string nodal = "/VTKHDF/PointData/";
    image.array(nodal + "displacement", as_3d(s.displacement), 3, "m");
    image.array(nodal + "velocity", as_3d(s.velocity), 3, "m/s");
    image.array(nodal + "acceleration", as_3d(s.acceleration), 3, "m/s2");
    image.array(nodal + "mass", s.nodal_mass, 0, "kg");
    if (!s.pore_pressure.empty()) image.array(nodal + "pore_pressure", s.pore_pressure, 0, "Pa");
    if (!s.sigma_v0.empty()) {
        image.array(nodal + "sigma_v0", s.sigma_v0, 0, "Pa");
        image.array(nodal + "pore_pressure_0", s.pore_pressure_0, 0, "Pa");
    }
    if (!s.excess_pressure_max.empty())
        image.array(nodal + "excess_pressure_max", s.excess_pressure_max, 0, "Pa");

    // Averages are for the eye: mean_stress is averaged from the points, not taken from the
    // average.
    const std::string cell = "/VTKHDF/CellData/";
    const auto gauss = static_cast<std::size_t>(s.gauss_per_element);
    std::vector<double> mean_stress(s.stress.size());
    for (std::size_t i = 0; i < mean_stress.size(); ++i)
        mean_stress[i] = mechanics::mean_stress(s.stress[i]);
    image.array(cell + "stress", averages(flat<4>(s.stress), 4, gauss, 6), 6, "Pa");
    image.array(cell + "mean_stress", averages(mean_stress, 1, gauss, 1), 0, "Pa");
    image.array(cell + "epsilon_q", averages(s.epsilon_q, 1, gauss, 1), 0, "1");
    image.array(cell + "epsilon_q_plastic", averages(s.epsilon_q_plastic, 1, gauss, 1), 0, "1");
    if (!s.psi.empty()) {
        image.array(cell + "psi", averages(s.psi, 1, gauss, 1), 0, "1");
        image.array(cell + "instability_ratio", averages(s.instability_ratio, 1, gauss, 1), 0, "1");
    }
    image.array(cell + "density", s.density, 0, "kg/m3");
    image.array(cell + "region", std::span<const std::int32_t>(s.region_of_element));
    const std::vector<std::int32_t> inverted = inverted_elements(s);
    image.array(cell + "inverted", std::span<const std::int32_t>(inverted));
}

/// What only Breachline reads. Counts are attributes so that a reader can size its arrays first.
void write_exact(Hdf5Image& image, const MeshSnapshot& s) {
    const std::string here = "/breachline";
    image.attribute(here, "time", s.time);
    image.attribute(here, "thickness", s.thickness);
    for (const auto& [name, number] : std::initializer_list<std::pair<const char*, std::size_t>>{
             {"step", static_cast<std::size_t>(s.step)},
             {"nodes", s.position_0.size()},
             {"elements", s.quads.size()},
             {"gauss_per_element", s.gauss_positions.size()},
             // Said apart from the datasets: a wet snapshot that lost its pressures is a fault, not
             // a dry one.
             {"has_pore_pressure", s.pore_pressure.empty() ? 0 : 1}}) {
        const auto value = static_cast<std::int64_t>(number);
        image.attribute(here, name, std::span(&value, 1));
    }
    write_regions(image, s.regions, s.materials_of_regions);
    image.array(here + "/position_0", flat<2>(s.position_0), 2, "m");
    image.array(here + "/quads",
                std::span<const std::int32_t>(s.quads.empty() ? nullptr : s.quads.front().data(),
                                              4 * s.quads.size()),
                4);
    image.group(here + "/gauss");
    image.array(here + "/gauss/natural_coordinates", flat<2>(s.gauss_positions), 2, "1");
    image.array(here + "/gauss/stress", flat<4>(s.stress), 4, "Pa");
    image.array(here + "/gauss/strain", flat<4>(s.strain), 4, "1");
    image.array(here + "/gauss/epsilon_q", s.epsilon_q, 0, "1");
    image.array(here + "/gauss/epsilon_q_plastic", s.epsilon_q_plastic, 0, "1");
    if (!s.r_u_max.empty()) {
        image.array(here + "/gauss/r_u_max", s.r_u_max, 0, "1");
        image.array(here + "/gauss/shear_strain_max", s.shear_strain_max, 0, "1");
    }
    if (s.psi.empty()) return;
    image.array(here + "/gauss/psi", s.psi, 0, "1");
    image.array(here + "/gauss/instability_ratio", s.instability_ratio, 0, "1");
}

/// Fields that not every scene has are read where they exist. sigma_v0 and pore_pressure_0 come
/// together, and the maximum only with them.
void read_nodes(Hdf5Reader& reader, MeshSnapshot& s, std::size_t nodes, bool has_pore_pressure) {
    for (auto* field : {&s.position_0, &s.displacement, &s.velocity, &s.acceleration})
        field->resize(nodes);
    s.nodal_mass.resize(nodes);
    s.pore_pressure.resize(has_pore_pressure ? nodes : 0);
    reader.array("/breachline/position_0", flat<2>(s.position_0), 2);
    const std::string nodal = "/VTKHDF/PointData/";
    read_3d(reader, nodal + "displacement", s.displacement);
    read_3d(reader, nodal + "velocity", s.velocity);
    read_3d(reader, nodal + "acceleration", s.acceleration);
    reader.array(nodal + "mass", s.nodal_mass, 0);
    if (has_pore_pressure) reader.array(nodal + "pore_pressure", s.pore_pressure, 0);
    if (!has_pore_pressure || !reader.exists(nodal + "sigma_v0")) return;
    s.sigma_v0.resize(nodes);
    s.pore_pressure_0.resize(nodes);
    reader.array(nodal + "sigma_v0", s.sigma_v0, 0);
    reader.array(nodal + "pore_pressure_0", s.pore_pressure_0, 0);
    if (!reader.exists(nodal + "excess_pressure_max")) return;
    s.excess_pressure_max.resize(nodes);
    reader.array(nodal + "excess_pressure_max", s.excess_pressure_max, 0);
}

void read_elements(Hdf5Reader& reader, MeshSnapshot& s, std::size_t elements, std::size_t gauss) {
    s.quads.resize(elements);
    s.region_of_element.resize(elements);
    s.density.resize(elements);
    s.gauss_positions.resize(gauss);
    for (auto* field : {&s.stress, &s.strain}) field->resize(elements * gauss);
    for (auto* field : {&s.epsilon_q, &s.epsilon_q_plastic}) field->resize(elements * gauss);
    reader.array(
        "/breachline/quads",
        std::span<std::int32_t>(s.quads.empty() ? nullptr : s.quads.front().data(), 4 * elements),
        4);
    reader.array("/VTKHDF/CellData/region", s.region_of_element);
    reader.array("/VTKHDF/CellData/density", s.density, 0);
    const std::string at_gauss = "/breachline/gauss/";
    reader.array(at_gauss + "natural_coordinates", flat<2>(s.gauss_positions), 2);
    reader.array(at_gauss + "stress", flat<4>(s.stress), 4);
    reader.array(at_gauss + "strain", flat<4>(s.strain), 4);
    reader.array(at_gauss + "epsilon_q", s.epsilon_q, 0);
    reader.array(at_gauss + "epsilon_q_plastic", s.epsilon_q_plastic, 0);
    if (reader.exists(at_gauss + "r_u_max")) {
        for (auto* field : {&s.r_u_max, &s.shear_strain_max}) field->resize(elements * gauss);
        reader.array(at_gauss + "r_u_max", s.r_u_max, 0);
        reader.array(at_gauss + "shear_strain_max", s.shear_strain_max, 0);
    }
    if (!reader.exists(at_gauss + "psi")) return;
    for (auto* field : {&s.psi, &s.instability_ratio}) field->resize(elements * gauss);
    reader.array(at_gauss + "psi", s.psi, 0);
    reader.array(at_gauss + "instability_ratio", s.instability_ratio, 0);
}

/// Called after refuse_if_faulty(), when every array has its expected length: an index may then be
/// compared with a length without another fault behind it.
void check_meaning(Hdf5Reader& reader, const MeshSnapshot& s) {
    if (s.thickness <= 0.0) reader.fault("/breachline@thickness", "must be positive");
    check_region_indices(reader, "/VTKHDF/CellData/region", s.region_of_element, s.regions.size());
    check_positive(reader, "/VTKHDF/CellData/density", s.density);
    for (std::size_t e = 0; e < s.quads.size(); ++e)
        for (const std::int32_t node : s.quads[e])
            if (node < 0 || static_cast<std::size_t>(node) >= s.position_0.size())
                return reader.fault("/breachline/quads", "element " + std::to_string(e) +
                                                             " has a corner at node " +
                                                             std::to_string(node) + " of " +
                                                             std::to_string(s.position_0.size()));
    for (const Vec2& xi : s.gauss_positions)
        if (xi.cwiseAbs().maxCoeff() > 1.0)
            return reader.fault("/breachline/gauss/natural_coordinates", "outside [-1, 1]");
}

}  // namespace

void write_mesh_snapshot(const std::filesystem::path& path, const MeshSnapshot& snapshot,
                         const Provenance& provenance) {
    check_sizes(snapshot);
    Hdf5Image image(mesh_kind);
    write_visible(image, snapshot);
    write_exact(image, snapshot);
    write_base_motion(image, snapshot.base_motion);
    write_provenance(image, provenance);
    std::move(image).save(path);
}

/// Faults are collected in three rounds, each thrown before the next one relies on it: the counts,
/// the arrays, then what the arrays mean.
MeshSnapshotFile read_mesh_snapshot(const std::filesystem::path& path) {
    Hdf5Reader reader(path, {mesh_kind}, "give a whole FEM snapshot as fem_solver wrote it");
    const std::string here = "/breachline";
    MeshSnapshotFile file;
    MeshSnapshot& s = file.snapshot;
    s.time = reader.real_attribute(here, "time");
    s.step = reader.integer_attribute(here, "step");
    s.thickness = reader.real_attribute(here, "thickness");
    const std::size_t nodes = reader.count_attribute(here, "nodes");
    const std::size_t elements = reader.count_attribute(here, "elements");
    const std::size_t gauss = reader.count_attribute(here, "gauss_per_element");
    const bool has_pore_pressure = reader.integer_attribute(here, "has_pore_pressure") != 0;
    // 64: any bound will do that keeps elements x gauss from being absurd in a damaged file.
    if (nodes == 0 || elements == 0 || gauss == 0 || gauss > 64)
        reader.fault(here, "has no nodes, no elements or no Gauss points");
    reader.refuse_if_faulty();
    s.gauss_per_element = static_cast<int>(gauss);

    read_regions(reader, s.regions, s.materials_of_regions);
    read_nodes(reader, s, nodes, has_pore_pressure);
    read_elements(reader, s, elements, gauss);
    s.base_motion = read_base_motion(reader);
    file.provenance = read_provenance(reader);
    // After the last read: what is read above need not be read twice.
    reader.check_rest();
    reader.refuse_if_faulty();
    check_meaning(reader, s);
    reader.refuse_if_faulty();
    return file;
}

}  // namespace breach::exchange
