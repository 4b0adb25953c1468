#include "gsv/exchange/shared_file.h"

#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "gsv/exchange/cycle_memory.h"

namespace gsv::exchange {
namespace {

// The child process starts before the file exists. It receives the file's address through a pipe,
// opens and maps the file, and rings the bell in it. This process sleeps until the bell rings.
TEST(SharedFile, AnotherProcessOpensAndMapsIt) {
  int pipe_ends[2];
  ASSERT_EQ(pipe(pipe_ends), 0);
  const pid_t other = fork();
  ASSERT_GE(other, 0);
  if (other == 0) {
    FileAddress address;
    if (read(pipe_ends[0], &address, sizeof address) != sizeof address) _exit(1);
    const auto file = SharedFile::Open(address);
    if (!file) _exit(2);
    const auto memory = (*file)->Map(0, kSlotSize);
    if (!memory) _exit(3);
    Ring(*static_cast<Bell*>((*memory)->data()));
    _exit(0);
  }
  const auto file = SharedFile::Make();
  ASSERT_TRUE(file);
  ASSERT_TRUE((*file)->Grow(kSlotSize));
  const auto memory = (*file)->Map(0, kSlotSize);
  ASSERT_TRUE(memory);
  Bell& bell = *static_cast<Bell*>((*memory)->data());
  bell.sleepers = 1;
  const FileAddress address = (*file)->address();
  ASSERT_EQ(write(pipe_ends[1], &address, sizeof address), static_cast<ssize_t>(sizeof address));
  while (bell.rings == 0) FutexWait(bell.rings, 0);
  int status = -1;
  ASSERT_EQ(waitpid(other, &status, 0), other);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(bell.rings, 1u);
  close(pipe_ends[0]), close(pipe_ends[1]);
}

TEST(SharedFile, OpenRefusesOtherFiles) {
  int pipe_ends[2];
  ASSERT_EQ(pipe(pipe_ends), 0);
  const auto own = static_cast<std::uint32_t>(getpid());
  EXPECT_FALSE(SharedFile::Open({own, static_cast<std::uint32_t>(pipe_ends[0])}));
  EXPECT_FALSE(SharedFile::Open({own, 1'000'000}));
  close(pipe_ends[0]), close(pipe_ends[1]);
}

TEST(SharedFile, NoProcessMakesItSmaller) {
  const auto file = SharedFile::Make();
  ASSERT_TRUE(file);
  ASSERT_TRUE((*file)->Grow(2 * kSlotSize));
  EXPECT_NE(ftruncate(static_cast<int>((*file)->address().descriptor), 0), 0);
  EXPECT_EQ((*file)->size().value(), 2 * kSlotSize);
}

TEST(Bell, CountersWrapAround) {
  EXPECT_TRUE(HasReached(5, 5));
  EXPECT_FALSE(HasReached(4, 5));
  EXPECT_TRUE(HasReached(2, 0xFFFFFFFEU));
  EXPECT_FALSE(HasReached(0xFFFFFFFEU, 2));
}

}  // namespace
}  // namespace gsv::exchange
