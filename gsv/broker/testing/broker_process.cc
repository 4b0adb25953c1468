#include "gsv/broker/testing/broker_process.h"

#include <csignal>
#include <cstdlib>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "gsv/base/check.h"

namespace gsv::broker {
namespace {

std::string ReadUntil(int descriptor, char end) {
  std::string text;
  for (char c = 0; read(descriptor, &c, 1) == 1 && c != end;) text.push_back(c);
  return text;
}

}  // namespace

TestProcess::TestProcess(const std::string& name, std::vector<std::string> arguments) {
  const char* build = std::getenv("GSV_BUILD_DIR");
  GSV_CHECK(build != nullptr);
  std::string program = std::string(build) + "/tests/" + name;
  std::vector<char*> argv = {program.data()};
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);

  int out[2];
  int err[2];
  GSV_CHECK(pipe2(out, O_CLOEXEC) == 0 && pipe2(err, O_CLOEXEC) == 0);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, out[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err[1], STDERR_FILENO);
  GSV_CHECK(posix_spawn(&pid_, program.c_str(), &actions, nullptr, argv.data(), environ) == 0);
  posix_spawn_file_actions_destroy(&actions);
  close(out[1]);
  close(err[1]);
  stderr_ = err[0];
  first_line_ = ReadUntil(out[0], '\n');
  close(out[0]);
}

TestProcess::~TestProcess() {
  if (pid_ != 0) {
    Send(SIGKILL);
    Wait();
  }
  close(stderr_);
}

std::string BrokerProcess::port() const {
  const std::size_t colon = reference().rfind(':');
  return reference().substr(colon + 1, reference().find('/') - colon - 1);
}

void TestProcess::Send(int signal) { kill(pid_, signal); }

void TestProcess::Stop() {
  Send(SIGSTOP);
  int status = 0;
  GSV_CHECK(waitpid(pid_, &status, WUNTRACED) == pid_ && WIFSTOPPED(status));
}

int TestProcess::Wait() {
  int status = 0;
  GSV_CHECK(waitpid(pid_, &status, 0) == pid_);
  pid_ = 0;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

std::string TestProcess::Stderr() { return ReadUntil(stderr_, '\0'); }

}  // namespace gsv::broker
