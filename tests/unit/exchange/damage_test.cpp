// Files damaged by a disk, a transfer or another program: the reader reports the damage or reads
// the same data.
#include <gtest/gtest.h>
#include <hdf5.h>

#include "core/exchange/mesh_snapshot.hpp"
#include "core/fault/fault.hpp"
#include "tests/unit/exchange/samples.hpp"

namespace breach::exchange {
namespace {

using samples::Folder;

/// Unclosed identifiers of files, groups, datasets, types and attributes.
ssize_t open_identifiers() { return H5Fget_obj_count(H5F_OBJ_ALL, H5F_OBJ_ALL); }

std::string whole_file(const Folder& folder) {
    write_mesh_snapshot(folder / "whole.vtkhdf", samples::mesh(3), samples::provenance());
    return samples::content(folder / "whole.vtkhdf");
}

TEST(DamagedFile, TruncatedAnywhereIsBadInputThatNamesTheFile) {
    const Folder folder;
    const std::string whole = whole_file(folder);
    std::size_t refused = 0;
    std::size_t tried = 0;
    for (std::size_t length = 0; length < whole.size(); length += 1 + length / 40, ++tried) {
        samples::overwrite(folder / "cut.vtkhdf", whole.substr(0, length));
        try {
            read_mesh_snapshot(folder / "cut.vtkhdf");
            ADD_FAILURE() << "read a file cut to " << length << " of " << whole.size();
        } catch (const fault::BadInput& refusal) {
            if (refusal.file().find("cut.vtkhdf") != std::string::npos) ++refused;
        }
    }
    EXPECT_EQ(refused, tried);
    EXPECT_EQ(open_identifiers(), 0);
}

TEST(DamagedFile, AnyFlippedByteIsRefusedOrHarmless) {
    const Folder folder;
    const std::string whole = whole_file(folder);
    const MeshSnapshot s = samples::mesh(3);
    std::size_t refused = 0;
    std::size_t harmless = 0;
    for (std::size_t at = 0; at < whole.size(); at += at < 300 ? 1 : 29) {
        std::string flipped = whole;
        flipped[at] = static_cast<char>(flipped[at] ^ 0x55);
        samples::overwrite(folder / "flipped.vtkhdf", flipped);
        try {
            const MeshSnapshot r = read_mesh_snapshot(folder / "flipped.vtkhdf").snapshot;
            ++harmless;
            EXPECT_TRUE(r.stress == s.stress && r.strain == s.strain && r.velocity == s.velocity &&
                        r.displacement == s.displacement && r.quads == s.quads &&
                        r.density == s.density && r.regions == s.regions && r.time == s.time &&
                        r.position_0 == s.position_0 && r.epsilon_q == s.epsilon_q)
                << "byte " << at << " changed a value without being noticed";
        } catch (const fault::BadInput&) {
            ++refused;
        }
    }
    std::cout << "  refused " << refused << ", harmless (space that nothing uses) " << harmless
              << " of " << whole.size() << " bytes\n";
    EXPECT_GT(refused, harmless / 2);
    EXPECT_EQ(open_identifiers(), 0);
}

/// Modifies the file with HDF5, as another program would.
template <typename Change>
void tamper(const std::filesystem::path& path, Change change) {
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    ASSERT_GE(file, 0);
    change(file);
    EXPECT_GE(H5Fclose(file), 0);
}

TEST(DamagedFile, AnyFlippedByteOfACompressedFrameIsRefusedOrHarmless) {
    const Folder folder;
    const std::string_view fields[] = {"velocity", "epsilon_q"};
    write_particle_frame(folder / "whole.vtkhdf", samples::particles(40), fields, {});
    const ParticleState s = read_particle_frame(folder / "whole.vtkhdf");
    const std::string whole = samples::content(folder / "whole.vtkhdf");
    std::size_t refused = 0;
    for (std::size_t at = 0; at < whole.size(); at += 41) {
        std::string flipped = whole;
        flipped[at] = static_cast<char>(flipped[at] ^ 0x55);
        samples::overwrite(folder / "flipped.vtkhdf", flipped);
        try {
            const ParticleState r = read_particle_frame(folder / "flipped.vtkhdf");
            EXPECT_TRUE(r.position == s.position && r.velocity == s.velocity &&
                        r.epsilon_q == s.epsilon_q && r.region == s.region && r.time == s.time)
                << "byte " << at << " changed a value without being noticed";
        } catch (const fault::BadInput&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 20U);
    EXPECT_EQ(open_identifiers(), 0);
}

TEST(DamagedFile, EveryMissingOrMisshapenDatasetIsNamed) {
    const Folder folder;
    whole_file(folder);
    tamper(folder / "whole.vtkhdf", [](hid_t file) {
        H5Ldelete(file, "/VTKHDF/PointData/velocity", H5P_DEFAULT);
        H5Ldelete(file, "/breachline/gauss/stress", H5P_DEFAULT);
        const hsize_t shape[2] = {7, 4};
        const hid_t space = H5Screate_simple(2, shape, nullptr);
        H5Dclose(H5Dcreate2(file, "/breachline/gauss/stress", H5T_IEEE_F64LE, space, H5P_DEFAULT,
                            H5P_DEFAULT, H5P_DEFAULT));
        H5Sclose(space);
    });
    try {
        read_mesh_snapshot(folder / "whole.vtkhdf");
        FAIL();
    } catch (const fault::BadInput& refusal) {
        ASSERT_EQ(refusal.faults().size(), 2u) << refusal.what();
        EXPECT_EQ(refusal.faults()[0].pointer, "/VTKHDF/PointData/velocity");
        EXPECT_EQ(refusal.faults()[0].cause, "missing");
        EXPECT_EQ(refusal.faults()[1].cause, "shape is [7, 4], expected [12, 4]");
    }
}

TEST(DamagedFile, ANewerVersionIsRefusedWithBothNumbers) {
    const Folder folder;
    whole_file(folder);
    tamper(folder / "whole.vtkhdf", [](hid_t file) {
        const hid_t group = H5Gopen2(file, "/breachline", H5P_DEFAULT);
        const hid_t version = H5Aopen(group, "version", H5P_DEFAULT);
        const std::int64_t newer = 2;
        EXPECT_GE(H5Awrite(version, H5T_NATIVE_INT64, &newer), 0);
        H5Aclose(version);
        H5Gclose(group);
    });
    try {
        read_mesh_snapshot(folder / "whole.vtkhdf");
        FAIL();
    } catch (const fault::BadInput& refusal) {
        EXPECT_EQ(refusal.faults().at(0).cause, "is 2, this version reads 1");
    }
}

}  // namespace
}  // namespace breach::exchange
