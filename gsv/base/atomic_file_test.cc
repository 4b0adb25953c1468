#include "gsv/base/atomic_file.h"

#include <unistd.h>

#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "gsv/base/temporary_folder.h"
#include "gsv/base/text_file.h"

namespace gsv::base {
namespace {

namespace fs = std::filesystem;

class AtomicFileTest : public ::testing::TestWithParam<Durability> {
 protected:
  const TemporaryFolder folder_ = *TemporaryFolder::Make("gsv-atomic-file");
  const fs::path file_ = folder_.path() / "note.json";
};
INSTANTIATE_TEST_SUITE_P(All, AtomicFileTest,
                         ::testing::Values(Durability::kProcess, Durability::kPowerLoss));

TEST_P(AtomicFileTest, ReplacesTheFileAndLeavesNoTemporaryFile) {
  const std::string large(5'000'000, 'x');
  ASSERT_TRUE(WriteAtomically(file_, large, GetParam()));
  EXPECT_EQ(ReadTextFile(file_), large);
  ASSERT_TRUE(WriteAtomically(file_, "short\n", GetParam()));
  EXPECT_EQ(ReadTextFile(file_), "short\n");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), {}), 1);
}

TEST_P(AtomicFileTest, ReportsAFailedRenameAndLeavesNoTemporaryFile) {
  fs::create_directory(file_);
  std::ofstream(file_ / "kept") << "kept";
  const Status written = WriteAtomically(file_, "text", GetParam());
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().Sentence(), file_.string() + ": cannot be written: Is a directory");
  EXPECT_FALSE(fs::exists(DraftPath(file_, getpid())));
  EXPECT_EQ(ReadTextFile(file_ / "kept"), "kept");
}

TEST_P(AtomicFileTest, KeepsThePreviousFileIfTheDiskIsFull) {
  // The device of the temporary file is full, so the second write fails.
  ASSERT_TRUE(WriteAtomically(file_, "before", GetParam()));
  fs::create_symlink("/dev/full", DraftPath(file_, getpid()));
  const Status written = WriteAtomically(file_, "after", GetParam());
  ASSERT_FALSE(written);
  EXPECT_NE(written.error().Sentence().find("No space left on device"), std::string::npos);
  EXPECT_EQ(ReadTextFile(file_), "before");
  EXPECT_FALSE(fs::is_symlink(DraftPath(file_, getpid())));
}

TEST_P(AtomicFileTest, ReportsAMissingFolder) {
  const Status written = WriteAtomically(folder_.path() / "gone/note.json", "text", GetParam());
  ASSERT_FALSE(written);
  EXPECT_NE(written.error().Sentence().find("gone/note.json: cannot be written: No such file"),
            std::string::npos);
}

}  // namespace
}  // namespace gsv::base
