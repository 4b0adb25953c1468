#include "apps/gsv/process/standard_output.h"

#include <unistd.h>

#include <csignal>
#include <memory>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/gsv/process/exit_code.h"

namespace gsv::app {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

File OpenToWrite(const char* path) { return {std::fopen(path, "w"), &std::fclose}; }

struct Ending {
  int exit_code = 0;
  std::string errors;
};

// Writes `text` after the capture of standard error has begun. The begin of a capture flushes every
// stream, so that EndOutput() would have no text to flush.
Ending EndOf(std::FILE* output, const char* text, int exit_code) {
  testing::internal::CaptureStderr();
  std::fputs(text, output);
  Ending ending;
  ending.exit_code = EndOutput(output, exit_code);
  ending.errors = testing::internal::GetCapturedStderr();
  return ending;
}

TEST(StandardOutput, KeepsTheExitCodeIfAllOutputWasWritten) {
  const File output = OpenToWrite("/dev/null");
  const Ending ending = EndOf(output.get(), "text\n", kOk);
  EXPECT_EQ(ending.exit_code, kOk);
  EXPECT_THAT(ending.errors, IsEmpty());
}

TEST(StandardOutput, FailsOnAFullDisk) {
  const File output = OpenToWrite("/dev/full");
  const Ending ending = EndOf(output.get(), "text", kOk);
  EXPECT_EQ(ending.exit_code, kInfrastructure);
  EXPECT_THAT(ending.errors, HasSubstr("No space left on device"));
}

TEST(StandardOutput, FailsAfterAnEarlierWriteError) {
  const File output = OpenToWrite("/dev/full");
  std::fputs("text\n", output.get());
  EXPECT_NE(std::fflush(output.get()), 0);
  const Ending ending = EndOf(output.get(), "", kOk);
  EXPECT_EQ(ending.exit_code, kInfrastructure);
  EXPECT_THAT(ending.errors, HasSubstr("cannot write all output"));
}

TEST(StandardOutput, KeepsTheExitCodeOfAnEarlierFailure) {
  const File output = OpenToWrite("/dev/full");
  EXPECT_EQ(EndOf(output.get(), "text\n", kAssertionFailed).exit_code, kAssertionFailed);
}

TEST(StandardOutput, FailsSilentlyWithoutAReader) {
  std::signal(SIGPIPE, SIG_IGN);
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  close(ends[0]);
  const File output(fdopen(ends[1], "w"), &std::fclose);
  const Ending ending = EndOf(output.get(), "text\n", kOk);
  EXPECT_EQ(ending.exit_code, kInfrastructure);
  EXPECT_THAT(ending.errors, IsEmpty());
}

}  // namespace
}  // namespace gsv::app
