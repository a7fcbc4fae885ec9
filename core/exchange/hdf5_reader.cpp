// Reads files that may be truncated, damaged or made by others. Nothing is allocated from a number
// in the file before it is compared with the file's size, and no HDF5 error ends the program:
// faults are collected, so that a user sees all of them at once.
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>

#include "core/exchange/hdf5_file.hpp"

namespace breach::exchange {
namespace {

template <typename T>
hid_t native_type();
template <>
hid_t native_type<double>() {
    return H5T_NATIVE_DOUBLE;
}
template <>
hid_t native_type<std::int32_t>() {
    return H5T_NATIVE_INT32;
}
template <>
hid_t native_type<std::int64_t>() {
    return H5T_NATIVE_INT64;
}

std::string as_text(std::span<const hsize_t> shape) {
    std::string text = "[";
    for (std::size_t i = 0; i < shape.size(); ++i)
        text += (i > 0 ? ", " : "") + std::to_string(shape[i]);
    return text + "]";
}

/// Checks the file before HDF5 opens it: a missing or unreadable file is an IoError, not bad input.
std::uintmax_t readable_bytes(const std::filesystem::path& path) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
        throw fault::IoError(path.string() + ": is not a regular file");
    errno = 0;
    const std::ifstream stream(path, std::ios::binary);
    if (!stream)
        throw fault::IoError(path.string() + ": cannot be opened: " + std::strerror(errno));
    const std::uintmax_t bytes = std::filesystem::file_size(path, error);
    if (error) throw fault::IoError(path.string() + ": cannot be read: " + error.message());
    return bytes;
}

hid_t open_file(const std::filesystem::path& path) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_file_locking(access.get(), false, true);  // network folders without locks
    return H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.get());
}

}  // namespace

Hdf5Reader::Hdf5Reader(const std::filesystem::path& path, const std::vector<Kind>& kinds,
                       std::string remedy)
    : path_(path),
      remedy_(std::move(remedy)),
      bytes_(readable_bytes(path)),
      file_(open_file(path), H5Fclose) {
    if (!file_) {
        fault("/", bytes_ == 0 ? "the file is empty"
                               : "not a whole HDF5 file: truncated, damaged or of another format");
        refuse_if_faulty();
    }
    if (!exists("/breachline")) {
        fault("/breachline", "missing: not a file of Breachline");
        refuse_if_faulty();
    }
    // The kind before all else: faults about datasets mean nothing in a file of another kind.
    const std::string name = text_attribute("/breachline", "kind");
    const std::int64_t version = integer_attribute("/breachline", "version");
    refuse_if_faulty();
    const auto kind = std::ranges::find(kinds, name, &Kind::name);
    if (kind == kinds.end())
        fault("/breachline@kind", "is '" + name + "', expected '" + kinds.front().name + "'");
    else if (version != kind->version)
        fault("/breachline@version", "is " + std::to_string(version) + ", this version reads " +
                                         std::to_string(kind->version));
    refuse_if_faulty();
}

bool Hdf5Reader::exists(const std::string& path) const {
    // H5Lexists needs every parent to exist.
    for (std::size_t end = path.find('/', 1); end != std::string::npos;
         end = path.find('/', end + 1))
        if (H5Lexists(file_.get(), path.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
    return H5Lexists(file_.get(), path.c_str(), H5P_DEFAULT) > 0;
}

bool Hdf5Reader::has_attribute(const std::string& object, const std::string& name) const {
    return exists(object) &&
           H5Aexists_by_name(file_.get(), object.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

/// For archives, whose names only the writing phase knows.
std::vector<std::string> Hdf5Reader::names_in(const std::string& group) {
    std::vector<std::string> names;
    const auto collect = [](hid_t, const char* name, const H5L_info_t*, void* out) -> herr_t {
        static_cast<std::vector<std::string>*>(out)->emplace_back(name);
        return 0;
    };
    const Handle id(H5Gopen2(file_.get(), group.c_str(), H5P_DEFAULT), H5Gclose);
    if (!id || H5Literate(id.get(), H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, collect, &names) < 0) {
        fault(group, exists(group) ? "damaged" : "missing");
        return {};
    }
    std::ranges::sort(names);
    return names;
}

/// A shape beyond this is damage, found before memory is reserved for it.
double Hdf5Reader::capacity(hid_t dataset) const {
    constexpr double most_that_inflates = 1032.0;  // largest ratio of zlib's deflate
    const Handle creation(H5Dget_create_plist(dataset), H5Pclose);
    unsigned flags = 0;
    size_t numbers = 0;
    const bool deflated = H5Pget_filter_by_id2(creation.get(), H5Z_FILTER_DEFLATE, &flags, &numbers,
                                               nullptr, 0, nullptr, nullptr) >= 0;
    const auto file = static_cast<double>(bytes_);
    if (!deflated) return file;
    return most_that_inflates * std::min(file, static_cast<double>(H5Dget_storage_size(dataset)));
}

/// Every reading goes through here: existence, type and plausible size are checked in one place.
std::optional<Hdf5Reader::Dataset> Hdf5Reader::open(const std::string& path,
                                                    H5T_class_t type_class) {
    // Also when it fails: check_rest() must not report the same dataset again.
    opened_.insert(path);
    if (!exists(path)) {
        fault(path, "missing");
        return std::nullopt;
    }
    Handle id(H5Dopen2(file_.get(), path.c_str(), H5P_DEFAULT), H5Dclose);
    const Handle type(id ? H5Dget_type(id.get()) : -1, H5Tclose);
    const Handle space(id ? H5Dget_space(id.get()) : -1, H5Sclose);
    if (!type || !space) {
        fault(path, "damaged, or not a dataset");
        return std::nullopt;
    }
    if (H5Tget_class(type.get()) != type_class) {
        fault(path, "holds another type of value than expected");
        return std::nullopt;
    }
    std::vector<hsize_t> shape(
        static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space.get()))));
    H5Sget_simple_extent_dims(space.get(), shape.data(), nullptr);
    auto bytes = static_cast<double>(H5Tget_size(type.get()));
    for (const hsize_t n : shape) bytes *= static_cast<double>(n);
    if (bytes > capacity(id.get())) {
        fault(path, "shape " + as_text(shape) + " is more than the file can hold");
        return std::nullopt;
    }
    return Dataset{std::move(id), std::move(shape)};
}

/// For arrays of positions, whose rows give the number of points.
std::size_t Hdf5Reader::rows(const std::string& path) {
    const auto dataset = open(path, H5T_FLOAT);
    if (!dataset) return 0;
    if (dataset->shape.empty() || dataset->shape[0] == 0) {
        fault(path, "is empty");
        return 0;
    }
    return dataset->shape[0];
}

template <typename T>
bool Hdf5Reader::read(const std::string& path, H5T_class_t type_class, std::span<T> values,
                      std::size_t width) {
    // After a fault the caller goes on, to find further faults, and must not see leftover values.
    std::ranges::fill(values, T{});
    const auto dataset = open(path, type_class);
    if (!dataset) return false;
    std::vector<hsize_t> expected{values.size() / std::max<std::size_t>(width, 1)};
    if (width > 0) expected.push_back(width);
    if (dataset->shape != expected) {
        fault(path, "shape is " + as_text(dataset->shape) + ", expected " + as_text(expected));
        return false;
    }
    if (values.empty()) return true;
    if (H5Dread(dataset->id.get(), native_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) <
        0) {
        fault(path, "cannot be read: checksum mismatch or damaged storage");
        return false;
    }
    return true;
}

void Hdf5Reader::array(const std::string& path, std::span<double> values, std::size_t width) {
    if (read(path, H5T_FLOAT, values, width)) refuse_non_finite(path, values, width);
}

void Hdf5Reader::refuse_non_finite(const std::string& path, std::span<const double> values,
                                   std::size_t width) {
    const auto bad = std::ranges::find_if_not(values, [](double x) { return std::isfinite(x); });
    if (bad != values.end())
        fault(path, "value in row " +
                        std::to_string(static_cast<std::size_t>(bad - values.begin()) /
                                       std::max<std::size_t>(width, 1)) +
                        " is not finite");
}

void Hdf5Reader::array(const std::string& path, std::span<std::int32_t> values, std::size_t width) {
    read(path, H5T_INTEGER, values, width);
}

template <typename T>
std::vector<T> Hdf5Reader::read_any(const std::string& path, H5T_class_t type_class) {
    // Opened twice: once for the length, then by read(), which checks shape and checksum.
    std::size_t rows = 0;
    {
        const auto dataset = open(path, type_class);
        if (!dataset) return {};
        if (dataset->shape.size() == 1) rows = dataset->shape[0];
    }
    std::vector<T> values(rows);
    read(path, type_class, std::span<T>(values), 0);
    return values;
}

std::vector<double> Hdf5Reader::any_reals(const std::string& path) {
    return read_any<double>(path, H5T_FLOAT);
}

std::vector<double> Hdf5Reader::finite_reals(const std::string& path) {
    std::vector<double> values = any_reals(path);
    refuse_non_finite(path, values, 0);
    return values;
}

std::vector<std::int64_t> Hdf5Reader::any_integers(const std::string& path) {
    return read_any<std::int64_t>(path, H5T_INTEGER);
}

std::vector<std::string> Hdf5Reader::strings(const std::string& path) {
    const auto dataset = open(path, H5T_STRING);
    if (!dataset) return {};
    const Handle type(H5Dget_type(dataset->id.get()), H5Tclose);
    // Variable-length texts would lie in HDF5's global heap, outside the checksummed chunks.
    if (dataset->shape.size() != 1 || H5Tis_variable_str(type.get()) != 0) {
        fault(path, "expected a list of fixed-length texts");
        return {};
    }
    const std::size_t length = H5Tget_size(type.get());
    std::vector<char> cells(length * dataset->shape[0]);
    if (!cells.empty() &&
        H5Dread(dataset->id.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, cells.data()) < 0) {
        fault(path, "cannot be read: checksum mismatch or damaged storage");
        return {};
    }
    std::vector<std::string> values;
    for (std::size_t i = 0; i < dataset->shape[0]; ++i) {
        const char* begin = cells.data() + i * length;
        values.emplace_back(begin, std::find(begin, begin + length, '\0'));
    }
    return values;
}

/// Compares the class of type only: HDF5 converts between widths and byte orders.
bool Hdf5Reader::read_attribute(const std::string& object, const std::string& name, hid_t type,
                                void* value) {
    const std::string where = object + "@" + name;
    if (!has_attribute(object, name)) {
        fault(where, "missing");
        return false;
    }
    const Handle id(
        H5Aopen_by_name(file_.get(), object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
        H5Aclose);
    const Handle space(id ? H5Aget_space(id.get()) : -1, H5Sclose);
    const Handle stored(id ? H5Aget_type(id.get()) : -1, H5Tclose);
    if (!space || !stored || H5Sget_simple_extent_npoints(space.get()) != 1 ||
        H5Tget_class(stored.get()) != H5Tget_class(type) || H5Aread(id.get(), type, value) < 0) {
        fault(where, "damaged, or of another type than expected");
        return false;
    }
    return true;
}

std::string Hdf5Reader::text_attribute(const std::string& object, const std::string& name) {
    constexpr std::size_t longest = std::size_t{1} << 16;  // limit of HDF5 attributes
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type.get(), longest);
    H5Tset_strpad(type.get(), H5T_STR_NULLPAD);
    std::string value(longest, '\0');
    if (!read_attribute(object, name, type.get(), value.data())) return {};
    value.resize(std::strlen(value.c_str()));
    return value;
}

double Hdf5Reader::real_attribute(const std::string& object, const std::string& name) {
    double value = 0.0;
    if (read_attribute(object, name, H5T_NATIVE_DOUBLE, &value) && !std::isfinite(value))
        fault(object + "@" + name, "is not finite");
    return std::isfinite(value) ? value : 0.0;
}

std::int64_t Hdf5Reader::integer_attribute(const std::string& object, const std::string& name) {
    std::int64_t value = 0;
    read_attribute(object, name, H5T_NATIVE_INT64, &value);
    return value;
}

/// Each row takes at least a byte, so the file's size bounds a count before any array is resized.
/// Not for compressed frames: there a byte may stand for many rows.
std::size_t Hdf5Reader::count_attribute(const std::string& object, const std::string& name) {
    const std::int64_t value = integer_attribute(object, name);
    if (value < 0 || static_cast<std::uintmax_t>(value) > bytes_) {
        fault(object + "@" + name, std::to_string(value) + " rows cannot lie in this file");
        return 0;
    }
    return static_cast<std::size_t>(value);
}

/// Reading is the check: the Fletcher-32 filter runs in H5Dread. Without this a damaged copy for
/// ParaView would pass as a sound file.
void Hdf5Reader::check_rest() {
    std::vector<std::string> paths;
    const auto collect = [](hid_t, const char* name, const H5O_info_t* info, void* out) -> herr_t {
        if (info->type == H5O_TYPE_DATASET)
            static_cast<std::vector<std::string>*>(out)->push_back(std::string("/").append(name));
        return 0;
    };
    if (H5Ovisit2(file_.get(), H5_INDEX_NAME, H5_ITER_NATIVE, collect, &paths, H5O_INFO_BASIC) < 0)
        fault("/", "damaged");
    for (const std::string& path : paths) {
        if (!opened_.contains(path)) check_unread(path);
    }
}

void Hdf5Reader::check_unread(const std::string& path) {
    const Handle id(H5Dopen2(file_.get(), path.c_str(), H5P_DEFAULT), H5Dclose);
    const Handle type(id ? H5Dget_type(id.get()) : -1, H5Tclose);
    const Handle space(id ? H5Dget_space(id.get()) : -1, H5Sclose);
    const auto count = space ? static_cast<double>(H5Sget_simple_extent_npoints(space.get())) : 0.0;
    const double needed = type ? static_cast<double>(H5Tget_size(type.get())) * count : 0.0;
    // Real numbers are kept, to refuse NaN; of all other types only the reading counts.
    const bool plausible = type && space && needed <= capacity(id.get());
    const bool is_real = plausible && H5Tget_class(type.get()) == H5T_FLOAT;
    std::vector<double> reals(is_real ? static_cast<std::size_t>(count) : 0);
    std::vector<char> others(plausible && !is_real ? static_cast<std::size_t>(needed) : 0);
    const hid_t read_as = is_real ? H5T_NATIVE_DOUBLE : type.get();
    void* values = is_real ? static_cast<void*>(reals.data()) : others.data();
    if (!plausible ||
        (needed > 0.0 && H5Dread(id.get(), read_as, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)) {
        fault(path, "cannot be read: checksum mismatch or damaged storage");
        return;
    }
    std::vector<hsize_t> shape(
        static_cast<std::size_t>(std::max(1, H5Sget_simple_extent_ndims(space.get()))), 1);
    H5Sget_simple_extent_dims(space.get(), shape.data(), nullptr);
    refuse_non_finite(path, reals, shape[0] > 0 ? reals.size() / shape[0] : 0);
}

void Hdf5Reader::fault(const std::string& path, const std::string& cause) {
    faults_.push_back({path, cause, remedy_});
}

void Hdf5Reader::refuse_if_faulty() const {
    if (!faults_.empty()) throw fault::BadInput(path_.string(), faults_);
}

}  // namespace breach::exchange
