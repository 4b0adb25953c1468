#include "apps/gsv/doctor/machine_checks.h"

#include <arpa/inet.h>
#include <dlfcn.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>

#include "apps/gsv/machine/child_process.h"
#include "apps/gsv/machine/installation.h"
#include "apps/gsv/machine/running_instances.h"
#include "gsv/base/user_folder.h"
#include "gsv/broker/client/broker_client.h"
#include "gsv/broker/client/corbaloc.h"
#include "gsv/orb/orb.h"

namespace gsv::app {
namespace {

// This limit suffices for a hundred behaviours, a hundred viewers, and the program's own files.
constexpr rlim_t kEnoughDescriptors = 512;
constexpr double kEnoughRoom = 1;  // space for recordings, GB

bool CheckDescriptors() {
  rlimit limit{};
  getrlimit(RLIMIT_NOFILE, &limit);
  const auto may = static_cast<unsigned long long>(limit.rlim_cur);
  if (limit.rlim_cur >= kEnoughDescriptors) {
    std::printf("file descriptors: ok, at most %llu\n", may);
    return true;
  }
  std::printf(
      "file descriptors: low limit, at most %llu; each behaviour and viewer needs one. Use `ulimit "
      "-n 4096`\n",
      may);
  return false;
}

// Checks whether the system allows real-time runs to give their steps priority over behaviours.
void CheckPriority() {
  rlimit limit{};
  getrlimit(RLIMIT_NICE, &limit);
  if (geteuid() == 0 || limit.rlim_cur >= 30) {
    std::printf("priority: ok, simulation steps get a higher CPU priority than behaviours\n");
  } else {
    std::printf(
        "priority: default; with many robots, real-time steps may be late. Use `ulimit -e 30`\n");
  }
}

void CheckPort(std::uint16_t port, const char* whose, const char* otherwise) {
  const int descriptor = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const int reuse = 1;
  setsockopt(descriptor, SOL_SOCKET, SO_REUSEADDR, &reuse, sizeof reuse);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const bool is_free = bind(descriptor, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
  const int why = errno;
  close(descriptor);
  if (is_free) {
    std::printf("port %d (%s): free\n", port, whose);
  } else {
    std::printf("port %d (%s): in use: %s; %s\n", port, whose, std::strerror(why), otherwise);
  }
}

void CheckLibrary(const char* name, const char* what, const char* package) {
  void* const library = dlopen(name, RTLD_LAZY | RTLD_LOCAL);
  if (library != nullptr) {
    std::printf("%s: ok\n", what);
    dlclose(library);
  } else {
    std::printf("%s: not installed; needed for graphics cards: apt-get install %s\n", what,
                package);
  }
}

// Returns the program's path, or an empty text if it is not on PATH.
std::string FindOnPath(const char* program) {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const auto file = std::filesystem::path(folder) / program;
    if (access(file.c_str(), X_OK) == 0) return file;
  }
  return {};
}

// Returns the folder of the Python module that belongs to this program, or an empty text.
std::string OwnPythonFolder() {
  const auto root = ProgramFolder().parent_path();
  for (const char* folder : {"lib/python3/dist-packages", "python", "sdk/python"}) {
    std::error_code ignored;
    if (std::filesystem::is_directory(root / folder / "gsv", ignored)) return root / folder;
  }
  return {};
}

// Only behaviours in Python need the module gsv, so this check never fails.
void CheckPython() {
  const std::string python = FindOnPath("python3");
  if (python.empty()) {
    std::printf("python: not installed; behaviours in Python need it: apt-get install python3\n");
    return;
  }
  const auto child = ChildProcess::Start(
      {python, "-c",
       "import platform, sys; print(platform.python_version(), flush=True)\n"
       "sys.path = [folder for folder in sys.path if folder]  # not the current one\n"
       "import gsv; gsv.__file__ and print(gsv.__file__)"},
      true);
  const auto version =
      child ? (*child)->ReadLine(std::chrono::seconds(20)) : std::optional<std::string>();
  if (!version) {
    std::printf("python: %s does not run\n", python.c_str());
    return;
  }
  if (const auto module = (*child)->ReadLine(std::chrono::seconds(20))) {
    std::printf("python: ok, %s with the module %s\n", version->c_str(), module->c_str());
    return;
  }
  const std::string own = OwnPythonFolder();
  std::printf("python: %s, without the module gsv, which behaviours in Python need; %s%s\n",
              version->c_str(),
              own.empty() ? "install the package python3-gsv" : "use PYTHONPATH=", own.c_str());
}

bool CheckRoom() {
  struct statvfs room {};
  if (statvfs(".", &room) != 0) return true;
  const double gigabytes =
      static_cast<double>(room.f_bavail) * static_cast<double>(room.f_frsize) / 1e9;
  const bool is_enough = gigabytes >= kEnoughRoom;
  std::printf("free space for recordings: %s, %.1f GB%s\n", is_enough ? "ok" : "little", gigabytes,
              is_enough ? "" : "; choose another folder with --recordings");
  return is_enough;
}

bool CheckUserFolder() {
  const auto folder = base::UserFolder();
  if (folder) {
    std::printf("folder for this user's programs: ok, %s\n", folder->c_str());
    return true;
  }
  std::printf("folder for this user's programs: none: %s\n", folder.error().Sentence().c_str());
  return false;
}

}  // namespace

bool CheckMachine() {
  const bool descriptors = CheckDescriptors();
  CheckPriority();
  CheckPort(8080, "default port of the viewer", "gsv uses another free port, or the one of --port");
  CheckLibrary("libEGL.so.1", "EGL", "libegl1 libgl1-mesa-dri");
  std::printf("video: %s\n", !FindOnPath("ffmpeg").empty()
                                 ? "ok, ffmpeg is installed"
                                 : "ffmpeg is not installed; `gsv film` (.mp4, .webm) and `gsv rec "
                                   "export --video` need it: apt-get install ffmpeg");
  CheckPython();
  const bool folder = CheckUserFolder();
  const bool room = CheckRoom();
  return descriptors && folder && room;
}

bool CheckBroker(const std::string& broker) {
  std::string reference = broker;
  if (reference.empty()) {
    const std::vector<Instance> instances = RunningInstances();
    if (instances.empty()) {
      std::printf("broker: no address given; `gsv run` starts its own broker\n");
      return true;
    }
    reference = instances.front().broker;
  }
  const auto normalised = broker::NormaliseReference(reference);
  base::Status reached = normalised ? base::Status() : base::Fail(normalised.error());
  if (reached) {
    auto orb = orb::StartOrb({});
    if (!orb) {
      reached = base::Fail(orb.error());
    } else {
      const auto client = broker::BrokerClient::Connect(*orb, *normalised);
      if (!client) reached = base::Fail(client.error());
      (*orb)->destroy();
    }
  }
  if (reached) {
    std::printf("broker: ok, responds at %s\n", normalised->c_str());
    return true;
  }
  std::printf("broker: does not respond: %s; start one with `gsv broker --port N`\n",
              reached.error().Sentence().c_str());
  // Without an address from the user, this is no failure, because the instance may just have ended.
  return broker.empty();
}

}  // namespace gsv::app
