#include "apps/gsv/machine/child_process.h"

#include <fcntl.h>
#include <unistd.h>

#include <string>

#include <gtest/gtest.h>

namespace gsv::app {
namespace {

// A library may open a socket that a child process would inherit. ChildProcess must close it.
TEST(ChildProcess, InheritsNoOpenFile) {
  const int file = open("/dev/null", O_RDONLY);
  ASSERT_GE(file, 0);
  auto child = ChildProcess::Start(
      {"/bin/sh", "-c", "test ! -e /proc/self/fd/" + std::to_string(file)}, false);
  ASSERT_TRUE(child) << child.error().Sentence();
  EXPECT_EQ((*child)->AwaitEnd(std::chrono::seconds(60)), "exit code 0");
  close(file);
}

}  // namespace
}  // namespace gsv::app
