#include "core/exchange/publish.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <stdexcept>

#include "core/exchange/provenance.hpp"
#include "core/fault/fault.hpp"
#include "tests/unit/exchange/samples.hpp"

namespace breach::exchange {
namespace {

using samples::content;
using samples::Folder;
using samples::overwrite;

/// Limits the size of this process's files to `bytes`, to simulate a full disk.
class SmallDisk {
  public:
    explicit SmallDisk(rlim_t bytes) : old_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        ::getrlimit(RLIMIT_FSIZE, &old_);
        const rlimit small{bytes, old_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &small);
    }
    SmallDisk(const SmallDisk&) = delete;
    SmallDisk& operator=(const SmallDisk&) = delete;
    ~SmallDisk() {
        ::setrlimit(RLIMIT_FSIZE, &old_);
        std::signal(SIGXFSZ, old_handler_);
    }

  private:
    rlimit old_{};
    void (*old_handler_)(int);
};

TEST(Publish, ReplacesTheOldFileAndLeavesNothingElse) {
    const Folder folder;
    overwrite(folder / "a.txt", "old");
    publish_text(folder / "a.txt", "new");
    EXPECT_EQ(content(folder / "a.txt"), "new");
    EXPECT_EQ(folder.entries(), 1u);
}

TEST(Publish, AFailedWriterLeavesTheOldFileAndNothingElse) {
    const Folder folder;
    overwrite(folder / "a.txt", "old");
    const auto failing = [](const std::filesystem::path& temporary) {
        overwrite(temporary, "half");
        throw std::runtime_error("gave up");
    };
    EXPECT_THROW(publish(folder / "a.txt", failing), std::runtime_error);
    EXPECT_EQ(content(folder / "a.txt"), "old");
    EXPECT_EQ(folder.entries(), 1u);
}

TEST(Publish, AFullDiskIsAnIoErrorThatNamesTheFileAndLeavesNothing) {
    const Folder folder;
    const SmallDisk disk(1000);
    try {
        publish_text(folder / "big.txt", std::string(5000, 'x'));
        FAIL() << "published 5000 bytes on a disk of 1000";
    } catch (const fault::IoError& error) {
        EXPECT_NE(std::string(error.what()).find("big.txt"), std::string::npos) << error.what();
    }
    EXPECT_EQ(folder.entries(), 0u);
}

TEST(Publish, AMissingFolderIsAnIoErrorWithARemedy) {
    const Folder folder;
    try {
        publish_text(folder / "nowhere/a.txt", "x");
        FAIL();
    } catch (const fault::IoError& error) {
        EXPECT_NE(std::string(error.what()).find("does the folder exist"), std::string::npos);
    }
}

TEST(Publish, ALeftoverOfAKilledAttemptIsReplaced) {
    const Folder folder;
    overwrite(folder / ".a.txt.partial", "half of an earlier attempt, longer than the new text");
    publish_text(folder / "a.txt", "new");
    EXPECT_EQ(content(folder / "a.txt"), "new");
    EXPECT_EQ(folder.entries(), 1u);
}

// FIPS 180-2, appendix B: the digest of "abc".
constexpr auto sha256_of_abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";

TEST(Sha256, OfTextAndOfFileAgreeWithTheStandard) {
    const Folder folder;
    overwrite(folder / "abc", "abc");
    EXPECT_EQ(sha256_of_text("abc"), sha256_of_abc);
    EXPECT_EQ(sha256_of_file(folder / "abc"), sha256_of_abc);
}

TEST(Sha256, OfAFileLargerThanTheReadingBlock) {
    const Folder folder;
    const std::string text(200000, 'q');
    overwrite(folder / "long", text);
    EXPECT_EQ(sha256_of_file(folder / "long"), sha256_of_text(text));
}

TEST(Sha256, OfAMissingFileIsAnIoError) {
    EXPECT_THROW(sha256_of_file("/nowhere/at/all"), fault::IoError);
    EXPECT_THROW(sha256_of_file("/tmp"), fault::IoError);
}

}  // namespace
}  // namespace breach::exchange
