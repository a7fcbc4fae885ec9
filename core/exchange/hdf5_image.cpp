// Files are built in memory by HDF5's core driver and written by publish(). So a full disk or a
// kill leaves no half file, and HDF5's own error texts never reach a user.
#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <string_view>

#include "core/exchange/hdf5_file.hpp"
#include "core/exchange/publish.hpp"

namespace breach::exchange {
namespace {

constexpr std::size_t growth = std::size_t{1} << 20;  // bytes by which the image grows
// A higher level makes frames 2 % smaller and takes 20 % more time.
constexpr unsigned deflate_level = 1;
constexpr hsize_t chunk_values = hsize_t{1} << 17;  // 1 MiB of doubles: the default chunk cache

/// Building in memory fails only without memory or by a programming error.
hid_t made(hid_t id, const std::string& what) {
    if (id < 0) throw std::logic_error("HDF5 cannot build " + what);
    return id;
}

/// HDF5 would store when each object was made, and two files of the same state would differ.
Handle without_times(hid_t property_class) {
    Handle list(made(H5Pcreate(property_class), "a property list"), H5Pclose);
    H5Pset_obj_track_times(list.get(), false);
    return list;
}

/// HDF5 grows the image by `growth` bytes at a time, so its buffer is longer than the file:
/// end_of_file() says how much of it to write.
void* grow_image(void*, size_t size, H5FD_file_image_op_t, void* memory) {
    auto& file = *static_cast<MemoryFile*>(memory);
    void* const larger = std::realloc(file.begin, size);
    if (larger != nullptr) file.begin = larger;
    return larger;
}

/// HDF5 wants to free the image when the file closes. It must outlive that, because only a closed
/// file has its final bytes; ~MemoryFile frees it.
herr_t keep_image(void*, H5FD_file_image_op_t, void*) { return 0; }

/// Not H5Fget_file_image: it writes a version 3 superblock with a wrong checksum (1.10.8).
hid_t create_file(MemoryFile& memory) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    const Handle access(made(H5Pcreate(H5P_FILE_ACCESS), "a property list"), H5Pclose);
    H5FD_file_image_callbacks_t callbacks{};
    callbacks.image_realloc = grow_image;
    callbacks.image_free = keep_image;
    // HDF5 copies the property list; every copy must write to the same MemoryFile.
    callbacks.udata_copy = [](void* data) { return data; };
    callbacks.udata_free = [](void*) -> herr_t { return 0; };
    callbacks.udata = &memory;
    H5Pset_fapl_core(access.get(), growth, false);
    H5Pset_file_image_callbacks(access.get(), &callbacks);
    // From version 1.10 on, metadata have checksums.
    H5Pset_libver_bounds(access.get(), H5F_LIBVER_V110, H5F_LIBVER_V110);
    const Handle creation = without_times(H5P_FILE_CREATE);
    return made(H5Fcreate("image", H5F_ACC_TRUNC, creation.get(), access.get()), "a file");
}

/// HDF5 file format specification, superblock version 3: byte 28, eight bytes, little endian.
std::size_t end_of_file(const char* superblock) {
    std::uint64_t end = 0;
    for (int i = 7; i >= 0; --i) end = end << 8 | static_cast<unsigned char>(superblock[28 + i]);
    return end;
}

/// Fixed length: the text is in checksummed storage, and any reader supports it.
Handle text_type(std::size_t length) {
    Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type.get(), std::max<std::size_t>(length, 1));
    H5Tset_strpad(type.get(), H5T_STR_NULLPAD);
    return type;
}

Handle utf8_type(std::size_t length) {
    Handle type = text_type(length);
    H5Tset_cset(type.get(), H5T_CSET_UTF8);
    return type;
}

}  // namespace

MemoryFile::~MemoryFile() { std::free(begin); }

Hdf5Image::Hdf5Image(const Kind& kind, Storage storage)
    : storage_(storage), file_(create_file(memory_), H5Fclose) {
    group("/breachline");
    attribute("/breachline", "kind", kind.name);
    const std::int64_t version = kind.version;
    attribute("/breachline", "version", std::span(&version, 1));
}

void Hdf5Image::group(const std::string& path) {
    const Handle creation = without_times(H5P_GROUP_CREATE);
    const Handle made_group(
        made(H5Gcreate2(file_.get(), path.c_str(), H5P_DEFAULT, creation.get(), H5P_DEFAULT), path),
        H5Gclose);
}

/// Checksums need chunks, so even a short array is chunked. A chunk is never longer than the array:
/// a small dataset would else take 1 MiB.
void Hdf5Image::dataset(const std::string& path, const void* values, std::size_t count,
                        std::size_t width, hid_t type, const std::string& unit) {
    const std::size_t columns = std::max<std::size_t>(width, 1);
    if (count % columns != 0) throw std::logic_error(path + ": not a whole number of rows");
    const int rank = width == 0 ? 1 : 2;
    const hsize_t shape[2] = {count / columns, columns};
    const hsize_t chunk[2] = {
        std::clamp<hsize_t>(chunk_values / columns, 1, std::max<hsize_t>(shape[0], 1)), columns};

    const Handle space(made(H5Screate_simple(rank, shape, nullptr), path), H5Sclose);
    const Handle creation = without_times(H5P_DATASET_CREATE);
    H5Pset_chunk(creation.get(), rank, chunk);
    if (storage_ == Storage::compressed) {
        H5Pset_shuffle(creation.get());
        H5Pset_deflate(creation.get(), deflate_level);
    }
    H5Pset_fletcher32(creation.get());
    {
        const Handle data(made(H5Dcreate2(file_.get(), path.c_str(), type, space.get(), H5P_DEFAULT,
                                          creation.get(), H5P_DEFAULT),
                               path),
                          H5Dclose);
        if (count > 0)
            made(H5Dwrite(data.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), path);
    }
    if (!unit.empty()) attribute(path, "unit", unit);
}

void Hdf5Image::array(const std::string& path, std::span<const double> values, std::size_t width,
                      const std::string& unit) {
    dataset(path, values.data(), values.size(), width, H5T_IEEE_F64LE, unit);
}

void Hdf5Image::array(const std::string& path, std::span<const float> values, std::size_t width,
                      const std::string& unit) {
    dataset(path, values.data(), values.size(), width, H5T_IEEE_F32LE, unit);
}

void Hdf5Image::array(const std::string& path, std::span<const std::int64_t> values,
                      std::size_t width) {
    dataset(path, values.data(), values.size(), width, H5T_STD_I64LE, "");
}

void Hdf5Image::array(const std::string& path, std::span<const std::int32_t> values,
                      std::size_t width) {
    dataset(path, values.data(), values.size(), width, H5T_STD_I32LE, "");
}

void Hdf5Image::array(const std::string& path, std::span<const std::uint8_t> values,
                      std::size_t width) {
    dataset(path, values.data(), values.size(), width, H5T_STD_U8LE, "");
}

void Hdf5Image::strings(const std::string& path, const std::vector<std::string>& values) {
    std::size_t length = 1;
    for (const std::string& value : values) length = std::max(length, value.size());
    std::vector<char> cells(length * values.size(), '\0');
    for (std::size_t i = 0; i < values.size(); ++i)
        std::ranges::copy(values[i], cells.begin() + static_cast<std::ptrdiff_t>(i * length));
    const Handle type = utf8_type(length);
    dataset(path, cells.data(), values.size(), 0, type.get(), "");
}

void Hdf5Image::attribute(const std::string& object, const std::string& name, hid_t type,
                          hid_t given, const void* values, hsize_t count) {
    const Handle space(count == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, nullptr),
                       H5Sclose);
    const Handle made_attribute(
        made(H5Acreate_by_name(file_.get(), object.c_str(), name.c_str(), type, space.get(),
                               H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
             object + "@" + name),
        H5Aclose);
    H5Awrite(made_attribute.get(), given, values);
}

void Hdf5Image::attribute(const std::string& object, const std::string& name,
                          const std::string& value) {
    const Handle type = text_type(value.size());
    // The type of an empty text has one byte, which must exist.
    attribute(object, name, type.get(), type.get(), value.empty() ? "\0" : value.data());
}

void Hdf5Image::attribute(const std::string& object, const std::string& name, double value) {
    attribute(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &value);
}

void Hdf5Image::attribute(const std::string& object, const std::string& name,
                          std::span<const std::int64_t> values) {
    attribute(object, name, H5T_STD_I64LE, H5T_NATIVE_INT64, values.data(), values.size());
}

void Hdf5Image::save(const std::filesystem::path& path) && {
    // Closing flushes the last metadata into the image: only then is it a whole file.
    if (!file_.close()) throw fault::IoError(path.string() + ": no memory to write it");
    const auto* bytes = static_cast<const char*>(memory_.begin);
    publish_text(path, {bytes, end_of_file(bytes)});
}

}  // namespace breach::exchange
