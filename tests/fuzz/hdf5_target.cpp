// A snapshot, a particle file and an archive, modified by another program: the input is a list of
// changes to a whole file, through HDF5 or to the file's bytes. (As the file itself, an input would
// never pass HDF5's checksums.)
#include <hdf5.h>

#include <fstream>
#include <iterator>

#include "core/exchange/archive.hpp"
#include "core/exchange/mesh_snapshot.hpp"
#include "core/exchange/particle_state.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/unit/exchange/samples.hpp"

using namespace breach;

namespace {

std::string written(const std::function<void(const std::filesystem::path&)>& write) {
    const exchange::samples::Folder folder;
    write(folder / "file.h5");
    return exchange::samples::content(folder / "file.h5");
}

/// The three files, written once.
const std::vector<std::string>& whole_files() {
    using namespace exchange;
    static const std::vector<std::string> files = {
        written([](const auto& path) {
            write_mesh_snapshot(path, samples::mesh(2), samples::provenance());
        }),
        written([](const auto& path) {
            write_particle_state(path, samples::particles(5), samples::provenance());
        }),
        written([](const auto& path) {
            write_archive(path,
                          {.kind = "fuzz",
                           .version = 1,
                           .reals = {{"x", {1.0, 2.0}}, {"none", {}}},
                           .integers = {{"n", {3}}},
                           .texts = {{"t", "text"}},
                           .units = {{"x", "m"}}},
                          samples::provenance());
        })};
    return files;
}

/// Every object of the file, by path.
std::vector<std::string> objects_of(hid_t file) {
    std::vector<std::string> paths;
    const auto collect = [](hid_t, const char* name, const H5O_info_t*, void* out) -> herr_t {
        static_cast<std::vector<std::string>*>(out)->push_back(std::string("/").append(name));
        return 0;
    };
    H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_NATIVE, collect, &paths, H5O_INFO_BASIC);
    return paths;
}

hid_t type_of(fuzz::Purse& purse) {
    const hid_t types[] = {H5T_IEEE_F64LE, H5T_IEEE_F32BE, H5T_STD_I64LE,  H5T_STD_I32LE,
                           H5T_STD_U8LE,   H5T_STD_U64LE,  H5T_STD_REF_OBJ};
    const std::size_t which = purse.below(std::size(types) + 3);
    if (which < std::size(types)) return H5Tcopy(types[which]);
    const hid_t text = H5Tcopy(H5T_C_S1);
    H5Tset_size(text, which == std::size(types)       ? H5T_VARIABLE
                      : which == std::size(types) + 1 ? 1
                                                      : 1 + purse.below(300));
    return text;
}

hid_t space_of(fuzz::Purse& purse) {
    if (purse.byte() % 8 == 0) return H5Screate(purse.byte() % 2 == 0 ? H5S_SCALAR : H5S_NULL);
    const hsize_t shape[] = {purse.below(40), purse.below(9), purse.below(3)};
    return H5Screate_simple(1 + static_cast<int>(purse.below(3)), shape, nullptr);
}

/// Bytes for a dataset of any shape and type.
std::vector<char> filling(fuzz::Purse& purse, hid_t type, hid_t space) {
    const auto count = std::max<hssize_t>(0, H5Sget_simple_extent_npoints(space));
    std::vector<char> bytes(static_cast<std::size_t>(count) * H5Tget_size(type) + 1);
    for (std::size_t i = 0; i < std::min<std::size_t>(bytes.size(), 64) && !purse.empty(); ++i)
        bytes[i] = static_cast<char>(purse.byte());
    return bytes;
}

bool can_be_filled(hid_t type) {
    return H5Tis_variable_str(type) == 0 && H5Tget_class(type) != H5T_REFERENCE;
}

void put_dataset(hid_t file, const std::string& path, fuzz::Purse& purse) {
    H5Ldelete(file, path.c_str(), H5P_DEFAULT);
    const hid_t type = type_of(purse), space = space_of(purse);
    const hid_t data =
        H5Dcreate2(file, path.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    if (data >= 0 && can_be_filled(type))
        H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, filling(purse, type, space).data());
    if (data >= 0) H5Dclose(data);
    H5Sclose(space);
    H5Tclose(type);
}

/// Writes other values to a dataset.
void put_values(hid_t file, const std::string& path, fuzz::Purse& purse) {
    const hid_t data = H5Dopen2(file, path.c_str(), H5P_DEFAULT);
    if (data < 0) return;
    const hid_t type = H5Dget_type(data), space = H5Dget_space(data);
    if (can_be_filled(type))
        H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, filling(purse, type, space).data());
    H5Sclose(space);
    H5Tclose(type);
    H5Dclose(data);
}

void put_attribute(hid_t file, const std::string& path, fuzz::Purse& purse) {
    const hid_t object = H5Oopen(file, path.c_str(), H5P_DEFAULT);
    const int count = object < 0 ? 0 : H5Aget_num_attrs(object);
    if (count > 0) {
        char name[64] = "";
        const auto which = purse.below(static_cast<std::size_t>(count));
        H5Aget_name_by_idx(object, ".", H5_INDEX_NAME, H5_ITER_INC, which, name, sizeof name,
                           H5P_DEFAULT);
        H5Adelete(object, name);
        const hid_t type = type_of(purse), space = space_of(purse);
        const hid_t made = H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
        if (made >= 0 && can_be_filled(type))
            H5Awrite(made, type, filling(purse, type, space).data());
        if (made >= 0) H5Aclose(made);
        H5Sclose(space);
        H5Tclose(type);
    }
    if (object >= 0) H5Oclose(object);
}

void put_group(hid_t file, const std::string& path) {
    H5Ldelete(file, path.c_str(), H5P_DEFAULT);
    const hid_t group = H5Gcreate2(file, path.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    if (group >= 0) H5Gclose(group);
}

void change_objects(const std::filesystem::path& path, fuzz::Purse& purse) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    H5Pset_file_locking(access, false, true);
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, access);
    H5Pclose(access);
    fuzz::require(file >= 0, "a whole file can be changed");
    const auto objects = objects_of(file);
    for (std::size_t changes = 1 + purse.below(4); changes > 0; --changes) {
        const std::string& object = objects[purse.below(objects.size())];
        switch (purse.byte() % 5) {
            case 0:
                put_dataset(file, object, purse);
                break;
            case 1:
                put_values(file, object, purse);
                break;
            case 2:
                put_attribute(file, object, purse);
                break;
            case 3:
                put_group(file, object);
                break;
            default:
                H5Ldelete(file, object.c_str(), H5P_DEFAULT);
        }
    }
    H5Fclose(file);
}

/// Changes some bytes, and perhaps truncates.
std::string with_other_bytes(std::string bytes, fuzz::Purse& purse) {
    while (!purse.empty()) {
        const std::size_t at = purse.number(3) % bytes.size();
        bytes[at] = static_cast<char>(purse.byte());
    }
    return bytes;
}

void read(std::size_t kind, const std::filesystem::path& path) {
    if (kind == 0) exchange::read_mesh_snapshot(path);
    if (kind == 1) exchange::read_particle_state(path);
    if (kind == 2) exchange::read_archive(path, "fuzz", 1);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::Purse purse(data, size);
    const std::size_t kind = purse.byte() % whole_files().size();
    const bool bytes_only = purse.byte() % 4 == 0;
    const std::string& whole = whole_files()[kind];
    const fuzz::File file(bytes_only ? with_other_bytes(whole, purse) : whole);
    if (!bytes_only) change_objects(file.path(), purse);
    fuzz::taken([&] { read(kind, file.path()); });
    if (kind == 1) fuzz::taken([&] { exchange::read_particle_frame(file.path()); });
    return 0;
}
