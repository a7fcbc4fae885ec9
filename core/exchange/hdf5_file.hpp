// HDF5 for core/exchange only: a file built in memory and published whole, and a reader that
// reports every fault. No other code includes hdf5.h. Not thread-safe: a caller with several
// threads takes a lock, as the service does (files/frames.hpp).
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/fault/fault.hpp"

namespace breach::exchange {

/// An HDF5 identifier that closes itself. Negative: HDF5 refused the call that was to make it.
class Handle {
  public:
    using Close = herr_t (*)(hid_t);
    Handle(hid_t id, Close closer) : id_(id), close_(closer) {}
    Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    Handle& operator=(Handle&&) = delete;
    ~Handle() {
        if (id_ >= 0) close_(id_);
    }
    hid_t get() const { return id_; }
    explicit operator bool() const { return id_ >= 0; }
    /// False if closing failed.
    bool close() { return close_(std::exchange(id_, -1)) >= 0; }

  private:
    hid_t id_;
    Close close_;
};

/// Kind of a file, stored as attributes of /breachline.
struct Kind {
    std::string name;  ///< "mesh_snapshot"
    int version;
};

/// Receives the bytes of a file that HDF5 builds in memory.
struct MemoryFile {
    MemoryFile() = default;
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    ~MemoryFile();
    void* begin = nullptr;
};

/// Storage of the arrays; compressed: shuffled and deflated.
enum class Storage { plain, compressed };

/// An HDF5 file under construction, in memory until save(): publish() reports a full disk, not
/// HDF5. The same calls give the same bytes, because no creation times are stored.
class Hdf5Image {
  public:
    explicit Hdf5Image(const Kind& kind, Storage storage = Storage::plain);

    void group(const std::string& path);

    /// [rows] when width is 0, otherwise [rows, width]; chunked with Fletcher-32 checksums.
    void array(const std::string& path, std::span<const double> values, std::size_t width,
               const std::string& unit = "");
    void array(const std::string& path, std::span<const float> values, std::size_t width,
               const std::string& unit = "");
    void array(const std::string& path, std::span<const std::int64_t> values,
               std::size_t width = 0);
    void array(const std::string& path, std::span<const std::int32_t> values,
               std::size_t width = 0);
    void array(const std::string& path, std::span<const std::uint8_t> values,
               std::size_t width = 0);
    void strings(const std::string& path, const std::vector<std::string>& values);

    void attribute(const std::string& object, const std::string& name, const std::string& value);
    void attribute(const std::string& object, const std::string& name, double value);
    void attribute(const std::string& object, const std::string& name,
                   std::span<const std::int64_t> values);

    /// Closes the file and publishes it under its final name. Throws IoError.
    void save(const std::filesystem::path& path) &&;

  private:
    void dataset(const std::string& path, const void* values, std::size_t count, std::size_t width,
                 hid_t type, const std::string& unit);
    /// A scalar where `count` is 1. type: in the file; given: of the values.
    void attribute(const std::string& object, const std::string& name, hid_t type, hid_t given,
                   const void* values, hsize_t count = 1);

    Storage storage_;
    // Before file_: closing HDF5's file still writes to the image.
    MemoryFile memory_;
    Handle file_;
};

/// Reader that trusts nothing in a file. A call that finds an error adds a fault with the dataset's
/// path and returns zeros or empty text; refuse_if_faulty() throws all faults. A caller must call
/// it before it uses what it read.
class Hdf5Reader {
  public:
    /// Throws IoError if the file cannot be opened, BadInput if it is incomplete or of none of
    /// these kinds. `remedy`: which file to give instead ("give a FEM snapshot written by
    /// fem_solver").
    Hdf5Reader(const std::filesystem::path& path, const std::vector<Kind>& kinds,
               std::string remedy);

    bool exists(const std::string& path) const;
    bool has_attribute(const std::string& object, const std::string& name) const;
    /// Names of the entries of a group, ascending.
    std::vector<std::string> names_in(const std::string& group);

    /// Adds a fault if the dataset has no rows, or more than the file can contain.
    std::size_t rows(const std::string& path);
    /// Reads exactly [rows] or [rows, width] values; a non-finite value is a fault.
    void array(const std::string& path, std::span<double> values, std::size_t width);
    void array(const std::string& path, std::span<std::int32_t> values, std::size_t width = 0);
    /// One-dimensional arrays of any length. finite_reals: a non-finite value is a fault.
    std::vector<double> any_reals(const std::string& path);
    std::vector<double> finite_reals(const std::string& path);
    std::vector<std::int64_t> any_integers(const std::string& path);
    std::vector<std::string> strings(const std::string& path);

    std::string text_attribute(const std::string& object, const std::string& name);
    double real_attribute(const std::string& object, const std::string& name);
    std::int64_t integer_attribute(const std::string& object, const std::string& name);
    /// A number of rows; a fault if it is negative, or more than the file can contain.
    std::size_t count_attribute(const std::string& object, const std::string& name);

    /// Reads the remaining datasets to verify their checksums, and checks that the copies for
    /// ParaView are finite.
    void check_rest();

    void fault(const std::string& path, const std::string& cause);
    void refuse_if_faulty() const;

  private:
    struct Dataset {
        Handle id;
        std::vector<hsize_t> shape;
    };
    /// Upper bound of the dataset's size, from its storage in the file [bytes].
    double capacity(hid_t dataset) const;
    std::optional<Dataset> open(const std::string& path, H5T_class_t type_class);
    template <typename T>
    bool read(const std::string& path, H5T_class_t type_class, std::span<T> values,
              std::size_t width);
    template <typename T>
    std::vector<T> read_any(const std::string& path, H5T_class_t type_class);
    bool read_attribute(const std::string& object, const std::string& name, hid_t type,
                        void* value);
    void refuse_non_finite(const std::string& path, std::span<const double> values,
                           std::size_t width);
    void check_unread(const std::string& path);

    std::filesystem::path path_;
    std::string remedy_;
    std::uintmax_t bytes_;
    Handle file_;
    std::set<std::string> opened_;
    std::vector<fault::Fault> faults_;
};

}  // namespace breach::exchange
