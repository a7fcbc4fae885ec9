#include "core/exchange/archive.hpp"

#include <gtest/gtest.h>

#include "core/fault/fault.hpp"
#include "tests/unit/exchange/samples.hpp"

namespace breach::exchange {
namespace {

using samples::Folder;

Archive sample() {
    return {.kind = "mpm_checkpoint",
            .version = 3,
            .reals = {{"x", {1.0, -0.0, 1.0 / 3.0}}, {"nothing", {}}},
            .integers = {{"step", {std::int64_t{1} << 60, -1}}},
            .texts = {{"generator", "state of it"}, {"empty", ""}},
            .units = {{"x", "m"}}};
}

TEST(Archive, ComesBackBitForBit) {
    const Folder folder;
    write_archive(folder / "c.h5", sample(), samples::provenance());
    const Archive r = read_archive(folder / "c.h5", "mpm_checkpoint", 3);
    EXPECT_EQ(r.reals, sample().reals);
    EXPECT_TRUE(std::signbit(r.reals.at("x")[1]));
    EXPECT_EQ(r.integers, sample().integers);
    EXPECT_EQ(r.texts, sample().texts);
    EXPECT_EQ(r.units, sample().units);
    EXPECT_EQ(r.spent.cpu, samples::provenance().spent.cpu);
}

TEST(Archive, AStateToGoOnFromHasFiniteNumbersOnly) {
    const Folder folder;
    Archive archive = sample();
    archive.reals["x"][1] = std::nan("");
    write_archive(folder / "c.h5", archive, {});
    EXPECT_TRUE(std::isnan(read_archive(folder / "c.h5", "mpm_checkpoint", 3).reals.at("x")[1]));
    try {
        read_archive(folder / "c.h5", "mpm_checkpoint", 3, Reals::finite);
        FAIL();
    } catch (const fault::BadInput& refusal) {
        ASSERT_EQ(refusal.faults().size(), 1u);
        EXPECT_EQ(refusal.faults()[0].pointer, "/breachline/reals/x");
        EXPECT_EQ(refusal.faults()[0].cause, "value in row 1 is not finite");
    }
}

TEST(Archive, AnotherKindOrVersionIsRefused) {
    const Folder folder;
    write_archive(folder / "c.h5", sample(), {});
    EXPECT_THROW(read_archive(folder / "c.h5", "fem_checkpoint", 3), fault::BadInput);
    EXPECT_THROW(read_archive(folder / "c.h5", "mpm_checkpoint", 2), fault::BadInput);
}

TEST(Archive, AMissingFileIsAnIoErrorAndAnyOtherFileBadInput) {
    const Folder folder;
    EXPECT_THROW(read_archive(folder / "none.h5", "mpm_checkpoint", 3), fault::IoError);
    EXPECT_THROW(read_archive(folder.path(), "mpm_checkpoint", 3), fault::IoError);
    samples::overwrite(folder / "note.h5", "not at all HDF5");
    EXPECT_THROW(read_archive(folder / "note.h5", "mpm_checkpoint", 3), fault::BadInput);
    samples::overwrite(folder / "empty.h5", "");
    EXPECT_THROW(read_archive(folder / "empty.h5", "mpm_checkpoint", 3), fault::BadInput);
}

}  // namespace
}  // namespace breach::exchange
