// Parts that mesh and particle files share: the VTKHDF grid, regions and provenance. Only for
// core/exchange.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/exchange/base_motion.hpp"
#include "core/exchange/hdf5_file.hpp"
#include "core/exchange/provenance.hpp"
#include "core/mechanics/tensor.hpp"

namespace breach::exchange {

/// VTK cell types.
enum class Cell : std::uint8_t { vertex = 1, quad = 9 };

/// Group /VTKHDF: an UnstructuredGrid 1.0 with cells of one type, empty PointData and CellData, and
/// the time in FieldData. corners: point numbers, cell by cell. Real: the type in which positions
/// are stored.
template <class Real>
void write_grid(Hdf5Image& image, const std::vector<mechanics::Vec2>& points, Cell cell,
                std::span<const std::int64_t> corners, double time);

void write_regions(Hdf5Image& image, const std::vector<std::string>& regions,
                   const std::vector<std::string>& materials);
/// Adds a fault if the lists are empty or differ in length.
void read_regions(Hdf5Reader& reader, std::vector<std::string>& regions,
                  std::vector<std::string>& materials);
/// Adds a fault if an index is not that of a region.
void check_region_indices(Hdf5Reader& reader, const std::string& path,
                          const std::vector<std::int32_t>& indices, std::size_t regions);
/// Adds a fault at the first value that is not positive.
void check_positive(Hdf5Reader& reader, const std::string& path, const std::vector<double>& values);

/// Writes nothing if the motion is unknown.
void write_base_motion(Hdf5Image& image, const BaseMotion& motion);
BaseMotion read_base_motion(Hdf5Reader& reader);

void write_provenance(Hdf5Image& image, const Provenance& provenance);
Provenance read_provenance(Hdf5Reader& reader);

/// View of all components, row after row.
template <int n>
std::span<const double> flat(const std::vector<Eigen::Matrix<double, n, 1>>& rows) {
    return {rows.empty() ? nullptr : rows.front().data(), rows.size() * n};
}
template <int n>
std::span<double> flat(std::vector<Eigen::Matrix<double, n, 1>>& rows) {
    return {rows.empty() ? nullptr : rows.front().data(), rows.size() * n};
}

/// Each row of n values followed by zeros up to `width`.
/// In the file's type: frames are written in single precision.
template <class Real, int n>
std::vector<Real> padded(const std::vector<Eigen::Matrix<double, n, 1>>& rows, std::size_t width) {
    std::vector<Real> values(rows.size() * width, Real{});
    for (std::size_t i = 0; i < rows.size(); ++i)
        for (int j = 0; j < n; ++j) values[i * width + j] = static_cast<Real>(rows[i][j]);
    return values;
}

/// (x, y) -> (x, y, 0): a vector for ParaView.
template <class Real = double>
std::vector<Real> as_3d(const std::vector<mechanics::Vec2>& vectors) {
    return padded<Real, 2>(vectors, 3);
}
/// (xx, yy, zz, xy) -> (xx, yy, zz, xy, 0, 0): a symmetric tensor for ParaView.
template <class Real = double>
std::vector<Real> as_3d(const std::vector<mechanics::Voigt>& tensors) {
    return padded<Real, 4>(tensors, 6);
}
/// Reads what as_3d wrote; `values` has its final size.
void read_3d(Hdf5Reader& reader, const std::string& path, std::vector<mechanics::Vec2>& values);
void read_3d(Hdf5Reader& reader, const std::string& path, std::vector<mechanics::Voigt>& values);

}  // namespace breach::exchange
