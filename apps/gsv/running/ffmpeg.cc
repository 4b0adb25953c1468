#include "apps/gsv/running/ffmpeg.h"

#include <cerrno>
#include <csignal>
#include <utility>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace gsv::app {

base::Result<std::unique_ptr<Ffmpeg>> Ffmpeg::Start(const std::string& program,
                                                    const std::vector<std::string>& input,
                                                    const std::vector<std::string>& output,
                                                    const std::string& path,
                                                    const std::string& instead) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) {
    return base::Fail(base::ErrorCode::kUnavailable, "cannot make a pipe");
  }
  std::vector<std::string> arguments{program, "-hide_banner", "-loglevel", "error", "-n"};
  arguments.insert(arguments.end(), input.begin(), input.end());
  arguments.insert(arguments.end(), {"-i", "-"});
  // Most players require even sides and this pixel format.
  arguments.insert(arguments.end(),
                   {"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p"});
  arguments.insert(arguments.end(), output.begin(), output.end());
  arguments.push_back(path);
  std::vector<char*> pointers;
  pointers.reserve(arguments.size() + 1);
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
  posix_spawn_file_actions_addclosefrom_np(&actions, STDERR_FILENO + 1);
  pid_t pid = -1;
  const int failure =
      posix_spawnp(&pid, program.c_str(), &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[0]);
  if (failure != 0) {
    close(ends[1]);
    return base::Fail(base::ErrorCode::kUnavailable,
                      "cannot make a video: ffmpeg is not installed. Install it (apt-get install "
                      "ffmpeg), or " +
                          instead);
  }
  return std::unique_ptr<Ffmpeg>(new Ffmpeg(pid, ends[1]));
}

Ffmpeg::Ffmpeg(pid_t pid, int input) : pid_(pid), input_(input) {
  // Ignores SIGPIPE. If ffmpeg ends early, write() returns an error, and this process continues.
  std::signal(SIGPIPE, SIG_IGN);
}

Ffmpeg::~Ffmpeg() { (void)Finish(); }

bool Ffmpeg::Write(std::span<const std::uint8_t> bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t size = write(input_, bytes.data() + done, bytes.size() - done);
    if (size < 0 && errno == EINTR) continue;
    if (size < 0) return false;
    done += static_cast<std::size_t>(size);
  }
  return true;
}

bool Ffmpeg::Finish() {
  if (input_ >= 0) close(std::exchange(input_, -1));
  if (pid_ >= 0) waitpid(std::exchange(pid_, -1), &status_, 0);
  return WIFEXITED(status_) && WEXITSTATUS(status_) == 0;
}

}  // namespace gsv::app
