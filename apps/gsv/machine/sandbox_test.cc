#include "apps/gsv/machine/sandbox.h"

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "gsv/base/sanitizer.h"

namespace gsv::app {
namespace {

// Returns the waitpid() status of a process that calls `what` in a sandbox.
int RunInSandbox(const std::function<int()>& what) {
  const pid_t child = fork();
  if (child == 0) {
    if (!EnterSandbox({std::size_t{1} << 30, std::chrono::seconds(1)})) _exit(99);
    _exit(what());
  }
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

int ExitCodeOf(const std::function<int()>& what) {
  const int status = RunInSandbox(what);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(Sandbox, AllowsReading) {
  EXPECT_EQ(ExitCodeOf([] {
              char byte = 0;
              const int file = open("/proc/self/cmdline", O_RDONLY | O_CLOEXEC);
              return read(file, &byte, 1) == 1 ? 0 : 1;
            }),
            0);
}

TEST(Sandbox, DeniesTheNetwork) {
  for (const int family : {AF_INET, AF_INET6, AF_UNIX, AF_NETLINK}) {
    EXPECT_EQ(ExitCodeOf([family] { return socket(family, SOCK_DGRAM, 0) < 0 ? errno : 0; }),
              EPERM);
  }
}

TEST(Sandbox, DeniesStartingProgramsAndSendingSignals) {
  EXPECT_EQ(ExitCodeOf([] {
              char* const arguments[] = {nullptr};
              execve("/bin/true", arguments, arguments);
              return errno;
            }),
            EPERM);
  EXPECT_EQ(ExitCodeOf([] { return kill(getppid(), 0) < 0 ? errno : 0; }), EPERM);
}

TEST(Sandbox, DeniesWritingFiles) {
  char name[] = "/tmp/gsv-sandbox-XXXXXX";
  const int file = mkostemp(name, O_CLOEXEC);
  ASSERT_GE(file, 0);
  const int code = ExitCodeOf([file] { return write(file, "x", 1) < 0 ? errno : 0; });
  close(file);
  unlink(name);
  EXPECT_EQ(code, EFBIG);
}

TEST(Sandbox, LimitsMemoryAndTime) {
  if (!base::kReservesAddressSpace) {
    EXPECT_EQ(ExitCodeOf([] {
                const std::vector<char> large(std::size_t{2} << 30);
                return large.empty() ? 1 : 0;
              }),
              kWantsMoreMemory);
  }
  const int status = RunInSandbox([] {
    volatile unsigned i = 0;
    for (;;) i = i + 1;
    return 0;
  });
  ASSERT_TRUE(WIFSIGNALED(status)) << status;
  EXPECT_TRUE(WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL) << status;
}

}  // namespace
}  // namespace gsv::app
